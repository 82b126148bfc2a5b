//! Components of a film. The parts of the simulation's state are the components themselves; what the plugin adds
//! is its pace and where it came from.

use std::sync::Arc;

use bevy::{
    asset::Handle,
    ecs::{
        component::{Component, Mutable, StorageType},
        entity::Entity,
        reflect::ReflectComponent,
    },
    math::Vec3,
    mesh::Mesh,
    reflect::prelude::*,
};

use super::coating::FilmKey;
use crate::{
    deform::{FilmConstraints, SolverQuality},
    film::{FilmChanges, FilmMesh},
    fracture::FilmForces,
    settings::CoatingSettings,
    sim::{FilmClock, StepScratch},
    stain::{Environment, StainFields},
};

/// Written out, so that the simulation knows no engine.
macro_rules! components {
    ($($Part:ty),+) => {$(
        impl Component for $Part {
            const STORAGE_TYPE: StorageType = StorageType::Table;
            type Mutability = Mutable;
        }
    )+};
}

components!(FilmMesh, FilmForces, FilmConstraints, StainFields, FilmClock, FilmChanges, StepScratch);

/// On the entity of every film that is being built or ready: the entity whose [`Coating`](super::Coating) it is.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Reflect)]
#[reflect(Component, Debug, Clone, PartialEq)]
pub struct CoatedBy(pub Entity);

/// How a film steps: what its coating and its place in the world ask for, and the steps it is due.
#[derive(Component, Clone, Debug)]
pub struct FilmPace {
    /// Settings in force.
    pub settings: Arc<CoatingSettings>,
    /// How bending is solved.
    pub quality: SolverQuality,
    /// Age gained per age that the clock gives out.
    pub rate: f64,
    /// Whether this film stands still.
    pub paused: bool,
    /// Gravity and weather in the film's space.
    pub environment: Environment,
    /// Steps owed by the clock.
    pub(super) owed: f64,
    /// Steps asked for one by one.
    pub(super) requested: u64,
    /// Steps planned in this frame.
    pub(super) planned: u64,
    /// Steps taken in this frame.
    pub(super) taken: u64,
    /// Whether the film waits until it is known what shelters it.
    pub(super) held: bool,
    /// Whether the film takes the step that is under way.
    pub(super) due: bool,
    /// Whether the first crack has been reported.
    pub(super) cracked: bool,
    /// Middle and radius of the film at rest, in its own space.
    pub(super) bounds: (Vec3, f32),
    /// Gained while it waits for its turn.
    pub(super) credit: f32,
    /// Whether the frame has no time for it.
    pub(super) waits: bool,
    /// What a step is taken to cost, in moving vertices.
    pub(super) cost: u64,
}

impl FilmPace {
    pub(super) fn new(settings: Arc<CoatingSettings>, cracked: bool) -> Self {
        Self {
            settings,
            quality: SolverQuality::default(),
            rate: 1.0,
            paused: false,
            environment: Environment::default(),
            owed: 0.0,
            requested: 0,
            planned: 0,
            taken: 0,
            held: false,
            due: false,
            cracked,
            bounds: (Vec3::ZERO, 0.0),
            credit: 0.0,
            waits: false,
            cost: 0,
        }
    }

    /// Whether the film takes the step that is under way. For systems in
    /// [`CoatingStep`](super::CoatingStep).
    pub fn is_due(&self) -> bool {
        self.due
    }
}

/// Counts what changed, so that display follows only when something did. A system that edits a film counts up.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct FilmRevision {
    /// Vertices may have moved.
    pub positions: u32,
    /// Vertices separated or faces were removed: other parts of the metal show.
    pub exposure: u32,
    /// Edges tore or faces were removed.
    pub topology: u32,
    /// [`StainFields::revision`]: stains look different.
    pub stains: u32,
}

/// What a film was made of and how.
#[derive(Component, Clone, Debug)]
pub(crate) struct FilmSource {
    pub key: FilmKey,
    /// Entities whose meshes make up the film, by slot.
    pub slots: Vec<Entity>,
    /// World scale at which the film was built: film position = scale * mesh position.
    pub scale: Vec3,
}

/// On a mesh entity that waits for its film.
#[derive(Component, Clone, Copy, Debug)]
pub(crate) struct AwaitingFilm {
    pub root: Entity,
}

/// On a mesh entity that could not be coated. Kept until its mesh or coating changes.
#[derive(Component, Clone, Copy, Debug)]
pub(crate) struct FilmRefused {
    pub root: Entity,
}

/// On a mesh entity whose film is being built or ready.
#[derive(Component, Clone, Debug)]
pub(crate) struct FilmSlot {
    /// Entity of the film.
    pub film: Entity,
    /// The prop's own mesh.
    pub original: Handle<Mesh>,
    /// The mesh that shows the film; `None` while it is being built.
    pub shown: Option<Handle<Mesh>>,
}

/// On the entities that the plugin spawns to show the paint's back and the bare metal.
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Default, Debug, Clone)]
pub struct CoatingPart;
