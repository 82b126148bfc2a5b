//! Runs the stages as systems: each calls one function of [`stage`] for the due films, in parallel, and marks only the
//! components as changed that did change.

use bevy::ecs::{
    change_detection::{DetectChangesMut, Mut},
    system::{Query, ResMut},
};

use crate::{
    api::{diagnostics::CoatingTimings, film_pace::FilmPace},
    deform::FilmConstraints,
    film::{FilmChanges, FilmMesh},
    fracture::FilmForces,
    settings::CoatingSettings,
    sim::{FilmClock, Stage, StepScratch, stage},
    stain::{Environment, StainFields},
};

/// Runs [`stage::begin`]: counts the step and clears the changes of the last one.
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

/// Runs [`stage::forces`]: ages adhesion, contraction and binding.
pub(super) fn age_forces(
    mut films: Query<(&FilmPace, &FilmMesh, &mut FilmForces, &StainFields, &FilmClock)>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Fracture, || {
        films.par_iter_mut().for_each(|(pace, mesh, mut forces, stains, clock)| {
            if pace.due {
                stage::forces(mesh, &mut forces, stains, clock, &pace.settings);
            }
        });
    });
}

/// Runs [`stage::separate`]: separates vertices from the metal.
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

/// Query of the stages that edit the film.
type Edited<'w, 's> = Query<
    'w,
    's,
    (
        &'static FilmPace,
        &'static FilmClock,
        &'static mut FilmMesh,
        &'static mut FilmForces,
        &'static mut FilmChanges,
        &'static mut StepScratch,
    ),
>;

/// Runs [`stage::tear`]: tears edges.
pub(super) fn tear(films: Edited, timings: ResMut<CoatingTimings>) {
    edit(films, timings, |pace, _, mesh, forces, changes, scratch| {
        stage::tear(mesh, forces, changes, &pace.settings, pace.environment.gravity, &mut scratch.fracture);
        !changes.torn.is_empty()
    });
}

/// Runs [`stage::strip`]: removes faces and small pieces.
pub(super) fn strip(films: Edited, timings: ResMut<CoatingTimings>) {
    edit(films, timings, |pace, clock, mesh, forces, changes, scratch| {
        stage::strip(mesh, forces, clock, changes, &pace.settings, &mut scratch.fracture);
        !changes.removed.is_empty()
    });
}

/// Runs a stage that edits the due films. `stage` returns whether it changed the film.
fn edit<F>(mut films: Edited, mut timings: ResMut<CoatingTimings>, stage: F)
where
    F: Fn(&FilmPace, &FilmClock, &mut FilmMesh, &mut FilmForces, &mut FilmChanges, &mut StepScratch) -> bool + Sync,
{
    timings.measure(Stage::Fracture, || {
        films.par_iter_mut().for_each(|(pace, clock, mut mesh, mut forces, mut changes, mut scratch)| {
            if pace.due
                && stage(
                    pace,
                    clock,
                    mesh.bypass_change_detection(),
                    forces.bypass_change_detection(),
                    changes.bypass_change_detection(),
                    scratch.bypass_change_detection(),
                )
            {
                mesh.set_changed();
                changes.set_changed();
            }
        });
    });
}

/// Runs [`stage::link`]: updates the constraints.
pub(super) fn link(
    mut films: Query<(&FilmPace, &FilmMesh, &mut FilmConstraints, &FilmChanges)>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Fracture, || {
        films.par_iter_mut().for_each(|(pace, mesh, mut constraints, changes)| {
            if pace.due && changes.fractured() {
                stage::link(mesh, &mut constraints, changes, &pace.settings);
            }
        });
    });
}

/// Runs [`stage::bend`]: bends the separated film.
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
                    pace.quality,
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

/// Runs [`stage::rust`]: rusts and stains.
pub(super) fn rust(films: Stained, timings: ResMut<CoatingTimings>) {
    stain(films, timings, stage::rust);
}

/// Runs [`stage::dust`]: lets dust settle.
pub(super) fn dust(films: Stained, timings: ResMut<CoatingTimings>) {
    stain(films, timings, |mesh, stains, clock, _, settings, environment| {
        stage::dust(mesh, stains, clock, settings, environment);
    });
}

/// Runs [`stage::moisture`]: wets and dries.
pub(super) fn moisture(films: Stained, timings: ResMut<CoatingTimings>) {
    stain(films, timings, |mesh, stains, clock, _, settings, environment| {
        stage::moisture(mesh, stains, clock, settings, environment);
    });
}

/// Query of the stages that stain the film.
type Stained<'w, 's> = Query<
    'w,
    's,
    (&'static FilmPace, &'static FilmMesh, &'static mut StainFields, &'static FilmClock, &'static FilmChanges),
>;

/// Runs a stage that stains the due films. Their stains count as changed when the change can be seen.
fn stain(
    mut films: Stained,
    mut timings: ResMut<CoatingTimings>,
    stage: impl Fn(&FilmMesh, &mut StainFields, &FilmClock, &FilmChanges, &CoatingSettings, &Environment) + Sync,
) {
    timings.measure(Stage::Stains, || {
        films.par_iter_mut().for_each(|(pace, mesh, mut stains, clock, changes)| {
            if pace.due {
                let inner = stains.bypass_change_detection();
                let before = inner.revision;
                stage(mesh, inner, clock, changes, &pace.settings, &pace.environment);
                changed_if(&mut stains, |stains| stains.revision != before);
            }
        });
    });
}

/// Marks `part` as changed if `changed` says so.
fn changed_if<T>(part: &mut Mut<T>, changed: impl FnOnce(&T) -> bool) {
    if changed(part) {
        part.set_changed();
    }
}
