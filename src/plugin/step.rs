//! The stages as systems: each runs one function of [`stage`] on the due films, in parallel, and marks as changed
//! only what did change.

use bevy::ecs::{
    change_detection::{DetectChangesMut, Mut},
    system::{Query, ResMut},
};

use super::{FilmPace, diagnostics::CoatingTimings};
use crate::{
    deform::FilmConstraints,
    film::{FilmChanges, FilmMesh},
    fracture::FilmForces,
    sim::{FilmClock, Stage, StepScratch, stage},
};

/// Counts the step and forgets the last one's changes.
pub(super) fn begin(
    mut films: Query<(&FilmPace, &mut FilmClock, &mut FilmChanges)>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Other, || {
        for (pace, mut clock, mut changes) in &mut films {
            if pace.due {
                stage::begin(&mut clock, changes.bypass_change_detection());
            }
        }
    });
}

/// [`stage::forces`].
pub(super) fn age_forces(
    mut films: Query<(&FilmPace, &FilmMesh, &mut FilmForces, &FilmClock)>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Fracture, || {
        films.par_iter_mut().for_each(|(pace, mesh, mut forces, clock)| {
            if pace.due {
                stage::forces(mesh, &mut forces, clock, &pace.settings);
            }
        });
    });
}

/// [`stage::separate`].
pub(super) fn separate(
    mut films: Query<(&FilmPace, &FilmMesh, &mut FilmForces, &FilmClock, &mut FilmChanges)>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Fracture, || {
        films.par_iter_mut().for_each(|(pace, mesh, mut forces, clock, mut changes)| {
            if pace.due {
                let forces = forces.bypass_change_detection();
                stage::separate(mesh, forces, clock, changes.bypass_change_detection(), &pace.settings);
                changed_if(&mut changes, |changes| !changes.separated.is_empty());
            }
        });
    });
}

/// [`stage::tear`].
pub(super) fn tear(
    mut films: Query<(&FilmPace, &mut FilmMesh, &mut FilmForces, &mut FilmChanges, &mut StepScratch)>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Fracture, || {
        films.par_iter_mut().for_each(|(pace, mut mesh, mut forces, mut changes, mut scratch)| {
            if pace.due {
                let inner = changes.bypass_change_detection();
                stage::tear(
                    mesh.bypass_change_detection(),
                    forces.bypass_change_detection(),
                    inner,
                    &pace.settings,
                    pace.gravity,
                    &mut scratch.bypass_change_detection().tear,
                );
                if !inner.torn.is_empty() {
                    mesh.set_changed();
                    changes.set_changed();
                }
            }
        });
    });
}

/// [`stage::strip`].
pub(super) fn strip(
    mut films: Query<(&FilmPace, &mut FilmMesh, &mut FilmForces, &mut FilmChanges, &mut StepScratch)>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Fracture, || {
        films.par_iter_mut().for_each(|(pace, mut mesh, mut forces, mut changes, mut scratch)| {
            if pace.due {
                let inner = changes.bypass_change_detection();
                stage::strip(
                    mesh.bypass_change_detection(),
                    forces.bypass_change_detection(),
                    inner,
                    &pace.settings,
                    &mut scratch.bypass_change_detection().pieces,
                );
                if !inner.removed.is_empty() {
                    mesh.set_changed();
                    changes.set_changed();
                }
            }
        });
    });
}

/// [`stage::link`].
pub(super) fn link(
    mut films: Query<(&FilmPace, &FilmMesh, &mut FilmConstraints, &FilmChanges)>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Fracture, || {
        films.par_iter_mut().for_each(|(pace, mesh, mut constraints, changes)| {
            if pace.due && changes.fractured() {
                stage::link(mesh, &mut constraints, changes);
            }
        });
    });
}

/// [`stage::bend`].
pub(super) fn bend(
    mut films: Query<(
        &FilmPace,
        &mut FilmMesh,
        &mut FilmConstraints,
        &FilmForces,
        &FilmClock,
        &mut FilmChanges,
        &mut StepScratch,
    )>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Deformation, || {
        films.par_iter_mut().for_each(|(pace, mut mesh, mut constraints, forces, clock, mut changes, mut scratch)| {
            if pace.due {
                let inner = changes.bypass_change_detection();
                stage::bend(
                    mesh.bypass_change_detection(),
                    constraints.bypass_change_detection(),
                    forces,
                    clock,
                    inner,
                    &pace.settings,
                    &mut scratch.bypass_change_detection().bend,
                );
                if inner.moved {
                    mesh.set_changed();
                    constraints.set_changed();
                    changes.set_changed();
                }
            }
        });
    });
}

fn changed_if<T>(part: &mut Mut<T>, changed: impl FnOnce(&T) -> bool) {
    if changed(part) {
        part.set_changed();
    }
}
