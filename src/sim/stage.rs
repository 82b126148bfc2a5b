//! Runs the stages of one step, each on the parts of a film that it needs.
//!
//! [`FilmState::step`](super::FilmState::step) calls them in their order: [`begin`], [`forces`], [`separate`],
//! [`tear`], [`strip`], [`link`], [`bend`], [`rust`], [`dust`], [`moisture`]. The plugin runs the same functions as
//! systems of its schedule, where this order is written down a second time.
//!
//! ```
//! use bevy_coating::{
//!     remesh::sample,
//!     settings::CoatingSettings,
//!     sim::{FilmState, stage},
//!     stain::Environment,
//! };
//!
//! let (settings, environment) = (CoatingSettings::default(), Environment::default());
//! let piece = sample::plate(100, 7)?;
//! let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
//! let mut same = film.clone();
//!
//! let FilmState { mesh, forces, constraints, stains, clock, quality, changes, scratch } = &mut film;
//! stage::begin(clock, changes);
//! stage::forces(mesh, forces, stains, clock, &settings);
//! stage::separate(mesh, forces, clock, changes, &settings);
//! stage::tear(mesh, forces, changes, &settings, environment.gravity, &mut scratch.fracture);
//! stage::strip(mesh, forces, clock, changes, &settings, &mut scratch.fracture);
//! stage::link(mesh, constraints, changes, &settings);
//! stage::bend(mesh, constraints, forces, clock, changes, &settings, *quality, &mut scratch.bend);
//! stage::rust(mesh, stains, clock, changes, &settings, &environment);
//! stage::dust(mesh, stains, clock, &settings, &environment);
//! stage::moisture(mesh, stains, clock, &settings, &environment);
//!
//! same.step(&settings, &environment);
//! assert_eq!(film.digest(), same.digest());
//! # Ok::<(), bevy_coating::surface::BuildError>(())
//! ```

use bevy_math::Vec3;

use super::clock::FilmClock;
use crate::{
    deform::{self, BendScratch, FilmConstraints, SolvePace, SolverQuality},
    film::{FilmChanges, FilmMesh},
    fracture::{self, FilmForces, FractureScratch},
    settings::CoatingSettings,
    stain::{self, Environment, StainFields},
};

/// Begins a step: counts it on `clock` and clears the `changes` of the step before.
pub fn begin(clock: &mut FilmClock, changes: &mut FilmChanges) {
    changes.clear();
    clock.steps += 1;
}

/// Ages the forces by one step (VC 5.1, 5.2); wet film loses adhesion faster. See [`fracture::age_forces`].
pub fn forces(
    mesh: &FilmMesh,
    forces: &mut FilmForces,
    stains: &StainFields,
    clock: &FilmClock,
    settings: &CoatingSettings,
) {
    let moisture: &[f32] = if stains.is_damp() { &stains.film.moisture } else { &[] };
    fracture::age_forces(mesh, forces, settings, moisture, clock.dt());
}

/// Separates vertices whose bending force exceeds their adhesion (VC 5.1, eq. 4). See [`fracture::separate`].
pub fn separate(
    mesh: &FilmMesh,
    forces: &mut FilmForces,
    clock: &FilmClock,
    changes: &mut FilmChanges,
    settings: &CoatingSettings,
) {
    fracture::separate(mesh, forces, settings, clock.age() as f32, changes);
}

/// Tears edges whose contraction exceeds their binding (VC 5.2). `gravity` is a unit vector in the film's space. See
/// [`fracture::tear`].
pub fn tear(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    changes: &mut FilmChanges,
    settings: &CoatingSettings,
    gravity: Vec3,
    scratch: &mut FractureScratch,
) {
    fracture::tear(mesh, forces, &settings.tearing, gravity, changes, scratch);
}

/// Removes faces that are torn off all around (VC 5.3) and loose pieces that are small enough to fall. See
/// [`fracture::strip`].
pub fn strip(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    clock: &FilmClock,
    changes: &mut FilmChanges,
    settings: &CoatingSettings,
    scratch: &mut FractureScratch,
) {
    fracture::strip(mesh, forces, &settings.stripping, clock.age() as f32, changes, scratch);
}

/// Brings the constraints up to date with the fracture of this step (VC 5, fig. 7). See [`deform::update_constraints`]
/// and [`deform::follow_free_edges`].
pub fn link(mesh: &FilmMesh, constraints: &mut FilmConstraints, changes: &FilmChanges, settings: &CoatingSettings) {
    deform::update_constraints(mesh, constraints, changes);
    deform::follow_free_edges(mesh, constraints, settings, changes);
}

/// Bends the separated film by position-based dynamics without inertia, PBD-2 (VC 4). `quality` decides how many sweeps
/// are done. See [`deform::bend_film`].
pub fn bend(
    mesh: &mut FilmMesh,
    constraints: &mut FilmConstraints,
    forces: &FilmForces,
    clock: &FilmClock,
    changes: &mut FilmChanges,
    settings: &CoatingSettings,
    quality: SolverQuality,
    scratch: &mut BendScratch,
) {
    let step = (clock.steps, clock.steps_per_age);
    let (sweeps, tick) = (settings.deform.sweeps_per_age, clock.tick().is_some());
    let pace = match settings.scale.grain_of(&mesh.geometry) {
        Some(grain) => SolvePace::of_grain_step(sweeps, grain.in_edges(&mesh.geometry), quality, step, tick),
        None => SolvePace::of_step(sweeps, quality, step, tick),
    };
    deform::bend_film(mesh, constraints, &forces.loose, &settings.deform, pace, changes, scratch);
}

/// Brings the stains up to date with the fracture of this step (see [`stain::update_stains`]). In a step that completes
/// a [tick](FilmClock::tick), lets rust run off and bare metal rust (VC 6.1; see [`stain::run_off`]).
pub fn rust(
    mesh: &FilmMesh,
    stains: &mut StainFields,
    clock: &FilmClock,
    changes: &FilmChanges,
    settings: &CoatingSettings,
    environment: &Environment,
) {
    stain::update_stains(mesh, stains, changes, environment.gravity);
    if let Some(dt) = clock.tick() {
        stain::run_off(mesh, stains, settings, environment, dt);
    }
}

/// Lets dust and soot settle in a step that completes a [tick](FilmClock::tick) (VC 6.2). See [`stain::settle_dust`].
pub fn dust(
    mesh: &FilmMesh,
    stains: &mut StainFields,
    clock: &FilmClock,
    settings: &CoatingSettings,
    environment: &Environment,
) {
    if let Some(dt) = clock.tick() {
        stain::settle_dust(mesh, stains, &settings.dust, environment, dt);
    }
}

/// Wets, dries and washes the film and the metal in a step that completes a [tick](FilmClock::tick). See
/// [`stain::moisten`].
pub fn moisture(
    mesh: &FilmMesh,
    stains: &mut StainFields,
    clock: &FilmClock,
    settings: &CoatingSettings,
    environment: &Environment,
) {
    if let Some(dt) = clock.tick() {
        stain::moisten(mesh, stains, &settings.moisture, environment, dt);
    }
}
