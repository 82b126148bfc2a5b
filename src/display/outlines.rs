//! Keeps the outlines of all primitives up to date with the prop's materials.

use bevy::{
    asset::{AssetEvent, AssetId, Assets},
    ecs::{
        archetype::Archetype,
        change_detection::{DetectChanges, DetectChangesMut, Ref},
        entity::Entity,
        lifecycle::RemovedComponents,
        message::MessageReader,
        query::{Changed, Or, With},
        system::{Query, Res, SystemParam},
    },
    pbr::{MeshMaterial3d, StandardMaterial},
    platform::collections::HashSet,
};

use super::{
    custom_materials::CustomMaterials, film_display::FilmDisplay, material::dress::CoatedMaterial, outline::Outline,
};
use crate::api::{
    coating::Coating,
    links::{CoatedBy, FilmSlot, FilmSource},
};

/// Signals that the material of some primitive may be another.
#[derive(SystemParam)]
pub(super) struct MaterialChanges<'w, 's> {
    events: MessageReader<'w, 's, AssetEvent<StandardMaterial>>,
    swapped:
        Query<'w, 's, (), (With<FilmSlot>, Or<(Changed<MeshMaterial3d<StandardMaterial>>, Changed<CoatedMaterial>)>)>,
    removed: RemovedComponents<'w, 's, MeshMaterial3d<StandardMaterial>>,
}

/// Materials of the primitives.
#[derive(SystemParam)]
pub(super) struct OwnMaterials<'w, 's> {
    slots: Query<
        'w,
        's,
        (&'static Archetype, Option<&'static MeshMaterial3d<StandardMaterial>>, Option<&'static CoatedMaterial>),
    >,
    assets: Res<'w, Assets<StandardMaterial>>,
    custom: CustomMaterials<'w, 's>,
}

impl OwnMaterials<'_, '_> {
    /// Returns the outline of the primitive on `slot`. `None` if it has no material, or one that is not loaded: then it
    /// is not drawn, either.
    fn outline(&self, slot: Entity, coating: &Coating) -> Option<Outline> {
        let (archetype, plain, coated) = self.slots.get(slot).ok()?;
        match plain.map(|own| &own.0).or(coated.map(|own| &own.0)) {
            Some(own) => Some(Outline::from(self.assets.get(own)?)),
            None => self.custom.has_material(archetype).then(|| Outline::from(&coating.outline)),
        }
    }
}

/// Brings the outlines up to date of films that are new, whose coating has changed, or whose materials may have.
pub(super) fn follow_outlines(
    mut films: Query<(&CoatedBy, &FilmSource, &mut FilmDisplay)>,
    coatings: Query<Ref<Coating>>,
    mut changes: MaterialChanges,
    mut own: OwnMaterials,
) {
    let edited: HashSet<AssetId<StandardMaterial>> = changes
        .events
        .read()
        .filter_map(|event| match event {
            AssetEvent::Added { id } | AssetEvent::Modified { id } | AssetEvent::Removed { id } => Some(*id),
            _ => None,
        })
        .collect();
    let removed = changes.removed.read().count() > 0;
    let all = !edited.is_empty() || !changes.swapped.is_empty() || removed;
    own.custom.update();
    for (coated_by, source, mut display) in &mut films {
        let new = display.is_added();
        let parts = &mut display.bypass_change_detection().parts;
        parts.slots.resize_with(source.slots.len(), Default::default);
        let Ok(coating) = coatings.get(coated_by.0) else { continue };
        let unknown = parts.slots.iter().any(|slot| slot.outline.is_none());
        if !(all || new || unknown || coating.is_changed()) {
            continue;
        }
        for (parts, &slot) in parts.slots.iter_mut().zip(&source.slots) {
            let outline = own.outline(slot, &coating);
            if parts.outline != outline {
                (parts.outline, parts.outdated) = (outline, true);
            }
        }
    }
}
