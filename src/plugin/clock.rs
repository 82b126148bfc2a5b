//! The clock that all films share, and the budget that keeps frames short.

use std::time::Duration;

use bevy::{
    ecs::{reflect::ReflectResource, resource::Resource},
    math::Vec3,
    reflect::prelude::*,
};

/// Age per second when nothing else is set: 50 seconds from fresh to the end of the reference run.
pub const DEFAULT_AGE_PER_SECOND: f64 = 0.02;

/// How fast paint ages.
///
/// Seconds become whole steps, film by film; a film's state depends on the number of its steps alone, never on
/// frames or on time.
#[derive(Resource, Clone, Debug, PartialEq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingClock {
    /// Age given out per second of [`Time`](bevy::time::Time). 0 or more, default [`DEFAULT_AGE_PER_SECOND`].
    pub age_per_second: f64,
    /// Whether ageing stands still, but for [requested steps](Self::request_steps). Default false.
    pub paused: bool,
    /// Age at which films stop, also for requested steps; films that are older stay as they are. `None` (the
    /// default): they go on, beyond age 1 too.
    pub target_age: Option<f64>,
    /// Steps [requested](Self::request_steps) since the last frame, which hands them to the films. Default 0.
    pub requested_steps: u64,
}

impl Default for CoatingClock {
    fn default() -> Self {
        Self { age_per_second: DEFAULT_AGE_PER_SECOND, paused: false, target_age: None, requested_steps: 0 }
    }
}

impl CoatingClock {
    /// Has every film that is ready take `steps` steps more, paused or not, spread over as many frames as the
    /// budget takes.
    pub fn request_steps(&mut self, steps: u64) {
        self.requested_steps = self.requested_steps.saturating_add(steps);
    }
}

/// How much ageing may be done in one frame. Where the steps of all films do not fit, near and large ones (radius over
/// distance to the nearest active camera) come first and the others wait, up to 16 times longer; they take what they owe
/// together when it is their turn, up to four frames' worth of [`max_steps`](Self::max_steps). What a film whose turn it
/// is cannot take is dropped: a slow machine ages slower, at even pace, rather than stutters. At least one step is
/// always taken. Requested steps are never dropped, but wait.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingBudget {
    /// Wall time a frame after which no further step is begun. Default 4 ms.
    pub max_time: Duration,
    /// Steps a frame of the fastest film. Default 16.
    pub max_steps: u32,
    /// What a step of a thousand moving vertices is taken to cost. `None` (the default): measured as the game runs. With
    /// it, which steps fit into a frame does not depend on the machine: for replays and tests.
    pub fixed_cost: Option<Duration>,
}

impl CoatingBudget {
    /// No limit: for tools and tests.
    pub const UNLIMITED: Self = Self { max_time: Duration::MAX, max_steps: u32::MAX, fixed_cost: None };
}

impl Default for CoatingBudget {
    fn default() -> Self {
        Self { max_time: Duration::from_millis(4), max_steps: 16, fixed_cost: None }
    }
}

/// Direction of gravity in the world; need not be of unit length. It decides where rust comes out of a crack and runs
/// off, where dust settles, and which side of a crack's end keeps its vertex. Default: down, -y. Zero is weightlessness.
#[derive(Resource, Clone, Copy, Debug, PartialEq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingGravity(pub Vec3);

impl Default for CoatingGravity {
    fn default() -> Self {
        Self(Vec3::NEG_Y)
    }
}

/// Where all films stand, counted once a frame.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingStatus {
    /// Mesh entities that wait for their film, or for assets to be loaded.
    pub waiting: usize,
    /// Mesh entities that could not be coated.
    pub refused: usize,
    /// Films that are ready.
    pub films: usize,
    /// Films that took a step in the last frame.
    pub stepped: usize,
    /// Films that had no turn in the last frame, as there was no time for all.
    pub postponed: usize,
    /// Films that owe steps, but wait until it is known what [shelters](super::Shelter) them.
    pub casting: usize,
    /// Age of the youngest film; 0 without films.
    pub youngest: f64,
    /// Age of the oldest film; 0 without films.
    pub oldest: f64,
}
