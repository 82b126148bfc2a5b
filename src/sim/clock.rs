//! The step counter of one film.

use crate::stain::TICKS_PER_AGE;

/// Steps per unit age when nothing else is set, as in the paper's reference run.
pub const DEFAULT_STEPS_PER_AGE: u32 = 1000;

/// Counts the steps of one film. Age is counted in whole steps, so that it never drifts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component))]
pub struct FilmClock {
    /// Steps taken.
    pub steps: u64,
    /// Steps that make one unit of age. At least 1.
    pub steps_per_age: u32,
}

impl Default for FilmClock {
    fn default() -> Self {
        Self { steps: 0, steps_per_age: DEFAULT_STEPS_PER_AGE }
    }
}

impl FilmClock {
    /// A clock at age 0 with steps of `1 / steps_per_age`; 0 counts as 1.
    pub fn new(steps_per_age: u32) -> Self {
        Self { steps: 0, steps_per_age: steps_per_age.max(1) }
    }

    /// Age at the end of the last step: 0 is fresh, 1 the end of the reference run.
    pub fn age(&self) -> f64 {
        self.steps as f64 / f64::from(self.steps_per_age.max(1))
    }

    /// Age per step.
    pub fn dt(&self) -> f32 {
        1.0 / self.steps_per_age.max(1) as f32
    }

    /// Age since the last [tick](TICKS_PER_AGE) of the stains, if the last step completed one.
    pub fn tick(&self) -> Option<f32> {
        let (per_age, ticks_per_age) = (u128::from(self.steps_per_age.max(1)), u128::from(TICKS_PER_AGE));
        let ticks = |steps: u64| u128::from(steps) * ticks_per_age / per_age;
        let before = ticks(self.steps.checked_sub(1)?);
        if ticks(self.steps) == before {
            return None;
        }
        // The step that completed the tick before.
        let last = (before * per_age).div_ceil(ticks_per_age);
        Some((u128::from(self.steps) - last) as f32 * self.dt())
    }

    /// The first step at which the film is at least `age` old; 0 for negative ages and NaN.
    pub fn step_at(&self, age: f64) -> u64 {
        // Steps are counted, so an age that is a whole number of steps is met exactly, but for the rounding
        // of the age itself.
        let steps = (age * f64::from(self.steps_per_age.max(1)) - 1e-6).ceil();
        if steps > 0.0 { steps as u64 } else { 0 }
    }
}
