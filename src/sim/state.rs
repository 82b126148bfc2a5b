//! Holds the state of one film and takes its steps.

use super::{
    clock::FilmClock,
    scratch::StepScratch,
    stage,
    timing::{Stage, StageTimes},
};
use crate::{
    deform::{FilmConstraints, SolverQuality},
    film::{FilmChanges, FilmMesh},
    fracture::FilmForces,
    remesh::BuiltFilm,
    rest::{NoRest, Rest, at_once},
    settings::CoatingSettings,
    stain::{Environment, StainFields},
};

/// Complete state of one film, with everything that a step needs but settings and environment.
///
/// The plugin keeps the same parts as components of an entity.
#[derive(Clone, Debug, Default)]
pub struct FilmState {
    /// Mesh of the film.
    pub mesh: FilmMesh,
    /// Forces and fracture state.
    pub forces: FilmForces,
    /// Constraints of bending.
    pub constraints: FilmConstraints,
    /// Stains of the film and the metal.
    pub stains: StainFields,
    /// Step counter.
    pub clock: FilmClock,
    /// Quality with which bending is solved.
    pub quality: SolverQuality,
    /// Changes of the last step.
    pub changes: FilmChanges,
    /// Buffers of a step.
    pub scratch: StepScratch,
}

impl FilmState {
    /// Creates a fresh film of `built`, with steps of 1 / `steps_per_age` (0 counts as 1). `seed` draws adhesion and
    /// weak edges.
    ///
    /// Returns `None` if the triangles are not an oriented manifold; those of [`build_film`](crate::remesh::build_film)
    /// always are.
    ///
    /// ```
    /// use bevy_coating::{
    ///     remesh::sample,
    ///     settings::{CoatingSettings, Preset},
    ///     sim::FilmState,
    ///     stain::Environment,
    /// };
    ///
    /// let settings = CoatingSettings::from(Preset::Heavy);
    /// let piece = sample::plate(200, 7)?;
    /// let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
    /// film.age_to(1.0, &settings, &Environment::default());
    /// assert!(film.measure().separated > Some(0.5));
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn new(built: &BuiltFilm, settings: &CoatingSettings, seed: u64, steps_per_age: u32) -> Option<Self> {
        at_once(Self::new_in_pieces(built, settings, seed, steps_per_age, &mut NoRest))
    }

    /// Does what [`new`](Self::new) does, with rests between its pieces.
    pub(crate) async fn new_in_pieces(
        built: &BuiltFilm,
        settings: &CoatingSettings,
        seed: u64,
        steps_per_age: u32,
        rest: &mut impl Rest,
    ) -> Option<Self> {
        let mesh = FilmMesh::new_in_pieces(built.positions.clone(), &built.triangles, rest).await.ok()?;
        Some(Self::from_mesh_in_pieces(mesh, settings, seed, steps_per_age, rest).await)
    }

    /// Creates a fresh film on `mesh`, with steps of 1 / `steps_per_age` (0 counts as 1). `seed` draws adhesion and
    /// weak edges. Nothing may have torn or moved in `mesh` yet.
    ///
    /// ```
    /// use bevy_coating::{film::FilmMesh, settings::CoatingSettings, sim::FilmState};
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let film = FilmState::from_mesh(mesh, &CoatingSettings::default(), 7, 1000);
    /// assert_eq!((film.clock.age(), film.clock.dt()), (0.0, 0.001));
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn from_mesh(mesh: FilmMesh, settings: &CoatingSettings, seed: u64, steps_per_age: u32) -> Self {
        at_once(Self::from_mesh_in_pieces(mesh, settings, seed, steps_per_age, &mut NoRest))
    }

    async fn from_mesh_in_pieces(
        mesh: FilmMesh,
        settings: &CoatingSettings,
        seed: u64,
        steps_per_age: u32,
        rest: &mut impl Rest,
    ) -> Self {
        let stains = StainFields::new(&mesh);
        rest.rest().await;
        let forces = FilmForces::new(&mesh, settings, seed);
        rest.rest().await;
        let constraints = FilmConstraints::new(&mesh);
        rest.rest().await;
        let clock = FilmClock::new(steps_per_age);
        Self { mesh, forces, constraints, stains, clock, ..Self::default() }
    }

    /// Takes one step: runs every [stage](super::stage) once, in order.
    ///
    /// ```
    /// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState, stain::Environment};
    ///
    /// let settings = CoatingSettings::default();
    /// let piece = sample::plate(100, 7)?;
    /// let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
    /// film.step(&settings, &Environment::default());
    /// assert_eq!((film.clock.steps, film.clock.age()), (1, 0.01));
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn step(&mut self, settings: &CoatingSettings, environment: &Environment) {
        self.step_timed(settings, environment, &mut StageTimes::default());
    }

    /// Takes one step, as [`FilmState::step`] does, and adds the time spent in each stage to `times`.
    pub fn step_timed(&mut self, settings: &CoatingSettings, environment: &Environment, times: &mut StageTimes) {
        let Self { mesh, forces, constraints, stains, clock, quality, changes, scratch } = self;
        stage::begin(clock, changes);
        times.measure(Stage::Fracture, || {
            stage::forces(mesh, forces, stains, clock, settings);
            stage::separate(mesh, forces, clock, changes, settings);
            stage::tear(mesh, forces, changes, settings, environment.gravity, &mut scratch.fracture);
            stage::strip(mesh, forces, clock, changes, settings, &mut scratch.fracture);
            stage::link(mesh, constraints, changes, settings);
        });
        times.measure(Stage::Deformation, || {
            stage::bend(mesh, constraints, forces, clock, changes, settings, *quality, &mut scratch.bend);
        });
        times.measure(Stage::Stains, || {
            stage::rust(mesh, stains, clock, changes, settings, environment);
            stage::dust(mesh, stains, clock, settings, environment);
            stage::moisture(mesh, stains, clock, settings, environment);
        });
    }

    /// Takes steps until the film is at least `age` old. Does nothing if it already is.
    ///
    /// ```
    /// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState, stain::Environment};
    ///
    /// let settings = CoatingSettings::default();
    /// let piece = sample::plate(100, 7)?;
    /// let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
    /// film.age_to(0.25, &settings, &Environment::default());
    /// assert_eq!(film.clock.steps, 25);
    /// film.age_to(0.1, &settings, &Environment::default());
    /// assert_eq!(film.clock.steps, 25, "a film never grows younger");
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn age_to(&mut self, age: f64, settings: &CoatingSettings, environment: &Environment) {
        while self.clock.steps < self.clock.step_at(age) {
            self.step(settings, environment);
        }
    }
}
