//! Keeps the time of a run in the groups of VC, table 1, by one clock on the wall.

use std::time::Duration;

use serde::{Deserialize, Serialize};
use web_time::Instant;

use crate::sim::{Stage, StageTimes};

/// Seconds spent, by what they were spent on. The parts sum to the total.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// Time from start to end, with reading and writing.
    pub total: f64,
    /// Making of films, and casting of the shadows that shelter them.
    pub build: f64,
    /// Forces, separation, tearing, stripping, and updates of constraints.
    pub fracture: f64,
    /// Bending (PBD-2).
    pub deform: f64,
    /// Making of the aged model's meshes and textures.
    pub mesh: f64,
    /// Rust, dust and moisture.
    pub stain: f64,
    /// Everything else: reading, measuring, writing.
    pub other: f64,
}

/// Clock that keeps [`Seconds`]. Start it before the model is read.
///
/// ```
/// use bevy_coating::bake::Stopwatch;
///
/// let seconds = Stopwatch::start().seconds();
/// assert!(seconds.total < 60.0 && seconds.build == 0.0);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch {
    start: Instant,
    build: Duration,
    stages: StageTimes,
}

impl Stopwatch {
    /// Starts a clock now.
    pub fn start() -> Self {
        Self { start: Instant::now(), build: Duration::ZERO, stages: StageTimes::default() }
    }

    /// Runs `work`, which is building.
    pub(super) fn build<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.build += start.elapsed();
        result
    }

    /// Runs `work`, which is making meshes.
    pub(super) fn mesh<T>(&mut self, work: impl FnOnce() -> T) -> T {
        self.stages.measure(Stage::MeshGeneration, work)
    }

    /// Adds stages that films went through side by side within `wall` time: if they took longer together, each
    /// gets its share of it.
    pub(super) fn add_stages(&mut self, stages: &StageTimes, wall: Duration) {
        let all = [Stage::Fracture, Stage::Deformation, Stage::MeshGeneration, Stage::Stains];
        let sum: Duration = all.iter().map(|&stage| stages.of(stage)).sum();
        let scale = if sum > wall { wall.as_secs_f64() / sum.as_secs_f64() } else { 1.0 };
        for stage in all {
            self.stages.add(stage, stages.of(stage).mul_f64(scale));
        }
    }

    /// Returns the seconds spent up to now.
    pub fn seconds(&self) -> Seconds {
        let of = |stage| self.stages.of(stage).as_secs_f64();
        let (fracture, deform) = (of(Stage::Fracture), of(Stage::Deformation));
        let (build, mesh, stain) = (self.build.as_secs_f64(), of(Stage::MeshGeneration), of(Stage::Stains));
        let total = self.start.elapsed().as_secs_f64();
        let other = (total - (build + fracture + deform + mesh + stain)).max(0.0);
        Seconds { total, build, fracture, deform, mesh, stain, other }
    }
}
