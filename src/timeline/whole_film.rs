//! The components of a film as one state.

use bevy::ecs::{entity::Entity, query::QueryData, world::World};

use crate::{
    api::film_pace::FilmPace,
    deform::FilmConstraints,
    film::{FilmChanges, FilmMesh},
    fracture::FilmForces,
    sim::{FilmClock, FilmState, StepScratch},
    stain::StainFields,
};

/// All components that make up the state of a film.
#[derive(QueryData)]
#[query_data(mutable)]
pub(crate) struct WholeFilm {
    pub mesh: &'static mut FilmMesh,
    pub forces: &'static mut FilmForces,
    pub constraints: &'static mut FilmConstraints,
    pub stains: &'static mut StainFields,
    pub clock: &'static mut FilmClock,
    pub changes: &'static mut FilmChanges,
    pub scratch: &'static mut StepScratch,
    pub pace: &'static mut FilmPace,
}

/// Returns a copy of the film on `entity`, without buffers.
pub(super) fn copy_of(world: &World, entity: Entity) -> Option<FilmState> {
    let parts = world.get_entity(entity).ok()?.get_components::<Parts>().ok()?;
    let (mesh, forces, constraints, stains, clock, pace) = parts;
    Some(FilmState {
        mesh: mesh.clone(),
        forces: forces.clone(),
        constraints: constraints.clone(),
        stains: stains.clone(),
        clock: *clock,
        quality: pace.quality,
        ..FilmState::default()
    })
}

/// Components that decide what becomes of a film.
type Parts<'a> = (&'a FilmMesh, &'a FilmForces, &'a FilmConstraints, &'a StainFields, &'a FilmClock, &'a FilmPace);

impl WholeFilmItem<'_, '_> {
    /// Returns a copy of the state, without buffers.
    pub fn state(&self) -> FilmState {
        FilmState {
            mesh: self.mesh.clone(),
            forces: self.forces.clone(),
            constraints: self.constraints.clone(),
            stains: self.stains.clone(),
            clock: *self.clock,
            quality: self.pace.quality,
            ..FilmState::default()
        }
    }

    /// Lends the state to `change`, without copying it.
    pub fn lend<R>(&mut self, change: impl FnOnce(&mut FilmState) -> R) -> R {
        let mut state = FilmState {
            mesh: std::mem::take(&mut self.mesh),
            forces: std::mem::take(&mut self.forces),
            constraints: std::mem::take(&mut self.constraints),
            stains: std::mem::take(&mut self.stains),
            clock: *self.clock,
            quality: self.pace.quality,
            changes: std::mem::take(&mut self.changes),
            scratch: std::mem::take(&mut self.scratch),
        };
        let result = change(&mut state);
        let FilmState { mesh, forces, constraints, stains, clock, changes, scratch, .. } = state;
        (*self.mesh, *self.forces, *self.constraints, *self.stains) = (mesh, forces, constraints, stains);
        (*self.clock, *self.changes, *self.scratch) = (clock, changes, scratch);
        result
    }

    /// Puts `state` in the place of this one. Buffers, the goal of the clock, and what the coating says stay.
    pub fn replace(&mut self, state: FilmState) {
        let FilmState { mesh, forces, constraints, stains, clock, changes, .. } = state;
        let goal = self.clock.goal;
        self.pace.know(&forces);
        (*self.mesh, *self.forces, *self.constraints, *self.stains) = (mesh, forces, constraints, stains);
        (*self.clock, *self.changes) = (FilmClock { goal, ..clock }, changes);
    }
}
