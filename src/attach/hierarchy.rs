//! Walks the hierarchy between coatings and meshes.

use bevy::{
    ecs::{
        entity::Entity,
        hierarchy::{ChildOf, Children},
        query::With,
        system::{Query, SystemParam},
    },
    transform::components::Transform,
};

use crate::api::{coating::Coating, exclude::CoatingExclude};

/// Coatings, and the hierarchy of entities.
#[derive(SystemParam)]
pub(super) struct Coatings<'w, 's> {
    pub coatings: Query<'w, 's, &'static Coating>,
    excluded: Query<'w, 's, (), With<CoatingExclude>>,
    parents: Query<'w, 's, &'static ChildOf>,
    children: Query<'w, 's, &'static Children>,
    transforms: Query<'w, 's, &'static Transform>,
}

impl Coatings<'_, '_> {
    /// Returns the nearest entity with a coating, from `entity` upwards; `None` if something on the way is excluded.
    pub fn root_of(&self, entity: Entity) -> Option<Entity> {
        for e in std::iter::once(entity).chain(self.parents.iter_ancestors(entity)) {
            if self.coatings.contains(e) {
                return Some(e);
            }
            if self.excluded.contains(e) {
                return None;
            }
        }
        None
    }

    /// Adds `entity` and all its descendants to `found`.
    pub fn below(&self, entity: Entity, found: &mut Vec<Entity>) {
        found.push(entity);
        found.extend(self.children.iter_descendants(entity));
    }

    /// Returns whether the mesh of `slot` lies where the film on `film` has it: there, or right below in the same
    /// place.
    pub fn is_in_place(&self, slot: Entity, film: Entity) -> bool {
        let below = self.parents.get(slot).is_ok_and(|&ChildOf(parent)| parent == film);
        slot == film || (below && self.transforms.get(slot).is_ok_and(|t| *t == Transform::IDENTITY))
    }
}
