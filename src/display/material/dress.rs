//! Replaces the materials of coated props by stained ones, and puts the props' own materials back.
//!
//! This is the only place that changes the type of an entity's material. It runs in `PostUpdate`, before Bevy collects
//! changed materials, so that an entity gets the pipeline of its new material in the same frame. If it ran later in the
//! frame, an entity would be drawn with the pipeline of one material and the bindings of another (compare
//! bevyengine/bevy#21410, which was about off-screen entities).

use bevy::{
    asset::{Assets, Handle},
    ecs::{
        component::Component,
        entity::Entity,
        query::{Or, With},
        reflect::ReflectComponent,
        system::{Commands, Query, Res, ResMut},
        world::EntityWorldMut,
    },
    pbr::{MeshMaterial3d, StandardMaterial},
    reflect::prelude::*,
};

use super::{
    extension::{StainExtension, StainedMaterial},
    view::StainView,
};
use crate::{
    api::{links::FilmSlot, stain_display::StainDisplay},
    appearance::shading::StainPart,
    display::film_display::FilmDisplay,
};

/// Handle of the prop's own material, on a mesh entity that has a [`StainedMaterial`] while it is coated.
///
/// When the coating is removed the entity gets this material back. The stained material follows changes of the asset.
/// To give a coated prop another material, change the handle here or insert a `MeshMaterial3d<StandardMaterial>`.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{CoatedMaterial, prelude::*};
///
/// /// Gives all coated meshes another paint under the stains.
/// fn repaint(mut coated: Query<&mut CoatedMaterial>, mut materials: ResMut<Assets<StandardMaterial>>) {
///     let green = materials.add(Color::srgb(0.1, 0.3, 0.15));
///     for mut material in &mut coated {
///         material.0 = green.clone();
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default())).init_asset::<StandardMaterial>();
/// # app.add_systems(Update, repaint);
/// # app.update();
/// ```
#[derive(Component, Clone, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct CoatedMaterial(pub Handle<StandardMaterial>);

/// Replaces the materials of props whose stains are drawn by a material. Materials that are still loading are replaced
/// later.
pub(in crate::display) fn dress_props(
    mut commands: Commands,
    slots: Query<(Entity, &FilmSlot, &MeshMaterial3d<StandardMaterial>, Option<&MeshMaterial3d<StainedMaterial>>)>,
    films: Query<&FilmDisplay>,
    own: Res<Assets<StandardMaterial>>,
    mut stained: ResMut<Assets<StainedMaterial>>,
) {
    for (entity, slot, MeshMaterial3d(handle), worn) in &slots {
        let Some(display) = films.get(slot.film).ok().filter(|_| slot.display_mesh.is_some()) else { continue };
        if display.paint.display != StainDisplay::Material {
            continue;
        }
        let Some(base) = own.get(handle).cloned() else { continue };
        let worn = worn.map_or_else(
            || {
                let (shading, pattern) = (display.paint.shading.clone(), display.paint.pattern);
                let extension =
                    StainExtension { part: StainPart::Film, shading, pattern, view: StainView::Lit, alpha_only: false };
                stained.add(StainedMaterial { base: base.clone(), extension })
            },
            |worn| worn.0.clone(),
        );
        if let Some(mut material) = stained.get_mut(&worn) {
            material.base = base;
        }
        commands
            .entity(entity)
            .try_remove::<MeshMaterial3d<StandardMaterial>>()
            .try_insert((MeshMaterial3d(worn), CoatedMaterial(handle.clone())));
    }
}

/// Gives a clone of a dressed entity its own material back, as the stained one is the original's.
pub(crate) fn undress(entity: &mut EntityWorldMut) {
    entity.remove::<MeshMaterial3d<StainedMaterial>>();
    if let Some(CoatedMaterial(own)) = entity.take::<CoatedMaterial>()
        && !entity.contains::<MeshMaterial3d<StandardMaterial>>()
    {
        entity.insert(MeshMaterial3d(own));
    }
}

/// Puts back the materials of props that have no film any more, or whose stains are drawn in another way.
pub(in crate::display) fn undress_props(
    mut commands: Commands,
    props: Query<
        (Entity, Option<&FilmSlot>, &CoatedMaterial, Option<&MeshMaterial3d<StandardMaterial>>),
        Or<(With<MeshMaterial3d<StainedMaterial>>, With<CoatedMaterial>)>,
    >,
    films: Query<&FilmDisplay>,
) {
    for (entity, slot, CoatedMaterial(own), other) in &props {
        let display = slot.filter(|slot| slot.display_mesh.is_some()).and_then(|slot| films.get(slot.film).ok());
        if display.is_some_and(|display| display.paint.display == StainDisplay::Material) {
            continue;
        }
        let mut entity = commands.entity(entity);
        entity.try_remove::<(MeshMaterial3d<StainedMaterial>, CoatedMaterial)>();
        if other.is_none() {
            entity.try_insert(MeshMaterial3d(own.clone()));
        }
    }
}
