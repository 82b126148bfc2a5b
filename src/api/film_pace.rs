//! How a film steps.

use std::sync::Arc;

use bevy::{ecs::component::Component, math::Vec3};

use crate::{deform::SolverQuality, settings::CoatingSettings, stain::Environment};

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
    pub(crate) owed: f64,
    /// Steps asked for one by one.
    pub(crate) requested: u64,
    /// Steps planned in this frame.
    pub(crate) planned: u64,
    /// Steps taken in this frame.
    pub(crate) taken: u64,
    /// Whether the film waits until it is known what shelters it.
    pub(crate) held: bool,
    /// Whether the film takes the step that is under way.
    pub(crate) due: bool,
    /// Whether the first crack has been reported.
    pub(crate) cracked: bool,
    /// Middle and radius of the film at rest, in its own space.
    pub(crate) bounds: (Vec3, f32),
    /// Gained while it waits for its turn.
    pub(crate) credit: f32,
    /// Whether the frame has no time for it.
    pub(crate) waits: bool,
    /// What a step is taken to cost, in moving vertices.
    pub(crate) cost: u64,
}

impl FilmPace {
    pub(crate) fn new(settings: Arc<CoatingSettings>, cracked: bool) -> Self {
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
    /// [`CoatingStep`](super::system_sets::CoatingStep).
    pub fn is_due(&self) -> bool {
        self.due
    }
}
