//! Saves the films of a coating.

use bevy::ecs::{entity::Entity, hierarchy::Children, world::World};

use super::{path::written_path, whole_film::copy_of};
use crate::{
    api::{
        calendar::CoatingCalendar,
        coating::Coating,
        links::{AwaitingFilm, CoatedBy},
        seed::CoatingSeed,
        snapshot::{CoatingSnapshot, SaveError, SavedFilm},
    },
    snapshot::Snapshot,
};

impl CoatingSnapshot {
    /// Saves the films of the coating on `root`, as they are now. Meshes that could not be coated are left out.
    ///
    /// A film of 10,000 triangles takes some milliseconds, and at most 40 bytes a triangle at age 1.
    ///
    /// # Errors
    /// [`SaveError`], if there is no coating or one of its films is not ready.
    pub fn of(world: &World, root: Entity) -> Result<Self, SaveError> {
        let Some(coating) = world.get::<Coating>(root) else { return Err(SaveError::NoCoating { entity: root }) };
        let mut films = Vec::new();
        for entity in below(world, root) {
            let is_awaiting = world.get::<AwaitingFilm>(entity).is_some_and(|awaiting| awaiting.root == root);
            let is_film = world.get::<CoatedBy>(entity).is_some_and(|coated_by| coated_by.0 == root);
            let film = if is_film { copy_of(world, entity) } else { None };
            if is_awaiting || (is_film && film.is_none()) {
                return Err(SaveError::NotReady { entity: root });
            }
            let Some(film) = film else { continue };
            let state = Snapshot::of(&film).map_err(|source| SaveError::Film { entity, source })?;
            films.push(SavedFilm { path: written_path(world, root, entity), state });
        }
        films.sort_by(|a, b| a.path.cmp(&b.path));
        let drawn = world.get::<CoatingSeed>(root).map(|seed| seed.0);
        let date = world.get_resource::<CoatingCalendar>().map_or(0.0, CoatingCalendar::date);
        Ok(Self { seed: coating.seed.or(drawn).unwrap_or_default(), date, films })
    }
}

/// Returns `root` and everything below it.
pub(super) fn below(world: &World, root: Entity) -> Vec<Entity> {
    let mut found = vec![root];
    let mut next = 0;
    while let Some(&entity) = found.get(next) {
        found.extend(world.get::<Children>(entity).into_iter().flatten());
        next += 1;
    }
    found
}
