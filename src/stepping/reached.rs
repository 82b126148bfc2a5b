//! Measures the pace that ageing reaches.

use bevy::ecs::resource::Resource;

/// Seconds over which the pace is averaged.
const WINDOW: f64 = 0.5;

/// Age gained in successive windows of time.
#[derive(Resource, Debug, Default)]
pub(crate) struct ReachedPace {
    /// Age gained in the window that is under way.
    age: f64,
    /// Seconds of the window that is under way.
    seconds: f64,
    /// Age gained per second in the last whole window.
    last: f64,
}

impl ReachedPace {
    /// Adds a frame of `seconds` in which `age` was gained, and returns the age gained per second in the last window.
    pub fn add(&mut self, age: f64, seconds: f64) -> f64 {
        self.age += age;
        self.seconds += seconds;
        if self.seconds >= WINDOW {
            self.last = self.age / self.seconds;
            (self.age, self.seconds) = (0.0, 0.0);
        }
        self.last
    }
}
