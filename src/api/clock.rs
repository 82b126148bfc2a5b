//! The clock that all films share, and the gravity they feel.

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
