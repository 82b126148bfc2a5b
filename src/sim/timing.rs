//! Measures the time that is spent in each stage, grouped as in VC Table 1.

use std::time::Duration;

use web_time::Instant;

/// Group of stages whose time is measured together: a row of VC Table 1, or a part that the paper lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Forces, separation, tearing, stripping and updating of constraints.
    Fracture,
    /// Bending by position-based dynamics (PBD-2).
    Deformation,
    /// Generation of the mesh that is displayed.
    MeshGeneration,
    /// Rust, dust and moisture.
    Stains,
    /// Everything else: clocks and messages.
    Other,
}

/// Time that was spent in each [`Stage`].
///
/// ```
/// use std::time::Duration;
///
/// use bevy_coating::sim::{Stage, StageTimes};
///
/// let mut times = StageTimes::default();
/// let sum = times.measure(Stage::Other, || (1..=10).sum::<u32>());
/// assert_eq!(sum, 55);
/// times.add(Stage::Stains, Duration::from_millis(2));
///
/// let mut all = StageTimes::default();
/// all.merge(&times);
/// all.merge(&times);
/// assert_eq!(all.of(Stage::Stains), Duration::from_millis(4));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageTimes([Duration; 5]);

impl StageTimes {
    /// Runs `work`, adds the time that it takes to `stage`, and returns its result.
    pub fn measure<T>(&mut self, stage: Stage, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.add(stage, start.elapsed());
        result
    }

    /// Adds `time` to `stage`.
    pub fn add(&mut self, stage: Stage, time: Duration) {
        self.0[stage as usize] += time;
    }

    /// Returns the time that was spent in `stage`.
    pub fn of(&self, stage: Stage) -> Duration {
        self.0[stage as usize]
    }

    /// Adds all times of `other`.
    pub fn merge(&mut self, other: &Self) {
        for (mine, theirs) in self.0.iter_mut().zip(other.0) {
            *mine += theirs;
        }
    }
}
