//! The budget that keeps frames short.

use std::time::Duration;

use bevy::{
    ecs::{reflect::ReflectResource, resource::Resource},
    reflect::prelude::*,
};

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
