//! The state of one film and its step.

use bevy_math::Vec3;

use super::{FilmClock, Stage, StageTimes};
use crate::{
    deform::{self, BendScratch, FilmConstraints, SolvePace, SolverQuality},
    film::{FilmChanges, FilmMesh, InvariantError, VertexId},
    fracture::{self, FilmForces, FractureScratch},
    remesh::BuiltFilm,
    settings::CoatingSettings,
    stain::{self, Environment, StainFields},
};

/// How far below its plane a vertex may lie, in mean edges.
const PLANE_TOLERANCE: f32 = 1e-5;
/// And in units of the last place of its coordinates, which count where a film is far from its origin.
const PLANE_ROUNDING: f32 = 8.0 * f32::EPSILON;

/// Buffers of a step, kept between steps. Holds nothing that matters from one step to the next.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component))]
pub struct StepScratch {
    /// Of tearing and stripping.
    pub fracture: FractureScratch,
    /// Of bending.
    pub bend: BendScratch,
}

/// Everything one film needs to step.
#[derive(Clone, Debug, Default)]
pub struct FilmState {
    /// The film mesh.
    pub mesh: FilmMesh,
    /// Forces and fracture state.
    pub forces: FilmForces,
    /// Constraints of bending.
    pub constraints: FilmConstraints,
    /// Stain fields.
    pub stains: StainFields,
    /// Step counter.
    pub clock: FilmClock,
    /// How bending is solved.
    pub quality: SolverQuality,
    /// What the last step changed.
    pub changes: FilmChanges,
    /// Buffers.
    pub scratch: StepScratch,
}

/// The stages of one step, each on the parts that it needs: the only place where their order is written down
/// outside the plugin's schedule.
pub mod stage {
    use super::{
        BendScratch, CoatingSettings, Environment, FilmChanges, FilmClock, FilmConstraints, FilmForces, FilmMesh,
        FractureScratch, SolvePace, SolverQuality, StainFields, Vec3, deform, fracture, stain,
    };

    /// Begins a step: forgets the last one's changes and counts.
    pub fn begin(clock: &mut FilmClock, changes: &mut FilmChanges) {
        changes.clear();
        clock.steps += 1;
    }

    /// Forces age (VC 5.1, 5.2); wet paint loses its hold faster.
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

    /// Separation (VC 5.1).
    pub fn separate(
        mesh: &FilmMesh,
        forces: &mut FilmForces,
        clock: &FilmClock,
        changes: &mut FilmChanges,
        settings: &CoatingSettings,
    ) {
        fracture::separate(mesh, forces, settings, clock.age() as f32, changes);
    }

    /// Tearing (VC 5.2). `gravity` is a unit vector in the film's space.
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

    /// Stripping (VC 5.3).
    pub fn strip(
        mesh: &mut FilmMesh,
        forces: &mut FilmForces,
        changes: &mut FilmChanges,
        settings: &CoatingSettings,
        scratch: &mut FractureScratch,
    ) {
        fracture::strip(mesh, forces, &settings.stripping, changes, scratch);
    }

    /// Constraints follow fracture (VC 5, fig. 7).
    pub fn link(mesh: &FilmMesh, constraints: &mut FilmConstraints, changes: &FilmChanges) {
        deform::update_constraints(mesh, constraints, changes);
    }

    /// PBD-2 (VC 4).
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
        let pace = SolvePace::of_step(settings.deform.sweeps_per_age, quality, step, clock.tick().is_some());
        deform::bend_film(mesh, constraints, &forces.loose, &settings.deform, pace, changes, scratch);
    }

    /// Stains follow fracture; rust comes out of cracks, runs off and stains; bare metal rusts (VC 6.1).
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

    /// Dust and soot settle (VC 6.2).
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

    /// Rain wets, air and sun dry, and water washes.
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
}

impl FilmState {
    /// A fresh film of `built`. `None` if it is no oriented manifold, which [`crate::remesh::build_film`] never
    /// gives.
    pub fn new(built: &BuiltFilm, settings: &CoatingSettings, seed: u64, steps_per_age: u32) -> Option<Self> {
        let mesh = FilmMesh::new(built.positions.clone(), &built.triangles).ok()?;
        Some(Self::from_mesh(mesh, settings, seed, steps_per_age))
    }

    /// A fresh film on `mesh`.
    pub fn from_mesh(mesh: FilmMesh, settings: &CoatingSettings, seed: u64, steps_per_age: u32) -> Self {
        Self {
            stains: StainFields::new(&mesh),
            forces: FilmForces::new(&mesh, settings, seed),
            constraints: FilmConstraints::new(&mesh),
            clock: FilmClock::new(steps_per_age),
            mesh,
            ..Self::default()
        }
    }

    /// Takes one step.
    pub fn step(&mut self, settings: &CoatingSettings, environment: &Environment) {
        self.step_timed(settings, environment, &mut StageTimes::default());
    }

    /// Takes one step and adds the time spent in each stage to `times`.
    pub fn step_timed(&mut self, settings: &CoatingSettings, environment: &Environment, times: &mut StageTimes) {
        let Self { mesh, forces, constraints, stains, clock, quality, changes, scratch } = self;
        stage::begin(clock, changes);
        times.measure(Stage::Fracture, || {
            stage::forces(mesh, forces, stains, clock, settings);
            stage::separate(mesh, forces, clock, changes, settings);
            stage::tear(mesh, forces, changes, settings, environment.gravity, &mut scratch.fracture);
            stage::strip(mesh, forces, changes, settings, &mut scratch.fracture);
            stage::link(mesh, constraints, changes);
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

    /// Steps until the film is `age` old; does nothing if it is already.
    pub fn age_to(&mut self, age: f64, settings: &CoatingSettings, environment: &Environment) {
        while self.clock.steps < self.clock.step_at(age) {
            self.step(settings, environment);
        }
    }

    /// Checks every invariant of the film, its forces, constraints and stains (the list at the end of the method:
    /// one fan a vertex, twins share their ends, torn implies separated, attached vertices have not moved,
    /// none below its plane, stripped faces are cut out, tips have one torn edge), and what is known of the film beyond its
    /// state. For tests and debugging.
    ///
    /// # Errors
    /// The first [`InvariantError`] found.
    pub fn validate(&self) -> Result<(), InvariantError> {
        self.mesh.validate()?;
        let (topology, geometry, forces) = (&self.mesh.topology, &self.mesh.geometry, &self.forces);
        forces.validate(topology)?;
        for v in topology.all_vertices() {
            let moved = geometry.positions[v.index()] != geometry.rest_positions[v.index()];
            if forces.is_attached(v) && moved {
                return Err(InvariantError::AttachedMoved(v));
            }
            let rounding = PLANE_ROUNDING * geometry.rest_positions[v.index()].abs().max_element();
            if geometry.height(v) < -PLANE_TOLERANCE * geometry.mean_edge - rounding {
                return Err(InvariantError::BelowPlane(v));
            }
            if forces.tip(v).is_some() && !self.is_tip(v) {
                return Err(InvariantError::Tip(v));
            }
        }
        for h in topology.all_half_edges().filter(|&h| topology.is_torn(h)) {
            if forces.is_attached(topology.origin(h)) || forces.is_attached(topology.target(h)) {
                return Err(InvariantError::TornAttached(h));
            }
        }
        self.constraints.validate(&self.mesh, |v| forces.is_attached(v))?;
        self.stains.validate(&self.mesh)
    }

    /// Whether `v` lies inside and has exactly one torn edge: its open fan begins and ends at that edge.
    fn is_tip(&self, v: VertexId) -> bool {
        let topology = &self.mesh.topology;
        let torn = topology
            .fan(v)
            .map(|h| u32::from(topology.is_torn(h)) + u32::from(topology.is_torn(h.previous())))
            .sum::<u32>();
        let ends_meet = topology
            .fan(v)
            .last()
            .zip(topology.fan(v).next())
            .is_some_and(|(last, first)| topology.rest_twin(first) == Some(last.previous()));
        !topology.is_border(v) && torn == 2 && ends_meet
    }
}
