//! Hands components that decide where and how a primitive is drawn to its backs and metal, and takes them off again.

use bevy::{
    app::{App, PostUpdate},
    camera::visibility::{NoFrustumCulling, RenderLayers, VisibilityRange},
    ecs::{
        component::Component,
        entity::Entity,
        hierarchy::{ChildOf, Children},
        lifecycle::RemovedComponents,
        query::{Added, Changed, With, Without},
        schedule::IntoScheduleConfigs,
        system::{Commands, Query},
    },
    light::{NotShadowCaster, NotShadowReceiver, TransmittedShadowReceiver},
};

use super::parts;
use crate::api::{
    links::{CoatingPart, FilmSlot},
    system_sets::CoatingDisplay,
};

/// Adds the systems. `Visibility` needs none: parts are children of their primitive and inherit it.
pub(super) fn add_mirrors(app: &mut App) {
    app.add_systems(
        PostUpdate,
        (
            mirror::<RenderLayers>,
            mirror::<VisibilityRange>,
            mirror::<NoFrustumCulling>,
            mirror::<NotShadowCaster>,
            mirror::<NotShadowReceiver>,
            mirror::<TransmittedShadowReceiver>,
        )
            .after(parts::write_parts)
            .in_set(CoatingDisplay),
    );
}

/// Copies `C` from the primitives to their parts where it changed or a part is new, and removes it from them where it
/// was removed.
fn mirror<C: Component + Clone>(
    mut commands: Commands,
    changed: Query<(&C, &Children), (Changed<C>, With<FilmSlot>)>,
    mut removed: RemovedComponents<C>,
    without: Query<&Children, (With<FilmSlot>, Without<C>)>,
    new: Query<(Entity, &ChildOf), Added<CoatingPart>>,
    primitives: Query<&C, With<FilmSlot>>,
    parts: Query<(), With<CoatingPart>>,
) {
    for (part, primitive) in &new {
        if let Ok(value) = primitives.get(primitive.parent()) {
            commands.entity(part).try_insert(value.clone());
        }
    }
    for (value, children) in &changed {
        for part in children.iter().copied().filter(|&child| parts.contains(child)) {
            commands.entity(part).try_insert(value.clone());
        }
    }
    for children in removed.read().filter_map(|primitive| without.get(primitive).ok()) {
        for part in children.iter().copied().filter(|&child| parts.contains(child)) {
            commands.entity(part).try_remove::<C>();
        }
    }
}
