//! Time spent in each stage, grouped as in the paper's Table 1.

use std::time::Duration;

use web_time::Instant;

/// What time is spent on: the rows of VC Table 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Forces, separation, tearing, stripping, and setting of constraints.
    Fracture,
    /// PBD-2.
    Deformation,
    /// Generation of the mesh for display.
    MeshGeneration,
    /// Stains.
    Stains,
    /// All else: clocks, messages, bookkeeping.
    Other,
}

/// Time spent in each [`Stage`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StageTimes([Duration; 5]);

impl StageTimes {
    /// Runs `work` and adds its time to `stage`.
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

    /// Time spent in `stage`.
    pub fn of(&self, stage: Stage) -> Duration {
        self.0[stage as usize]
    }

    /// Adds the times of another run.
    pub fn merge(&mut self, other: &Self) {
        for (mine, theirs) in self.0.iter_mut().zip(other.0) {
            *mine += theirs;
        }
    }
}
