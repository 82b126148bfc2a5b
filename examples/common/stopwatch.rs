//! Where the time of a run goes: the groups of the paper's Table 1, of one clock on the wall.

use std::time::{Duration, Instant};

use bevy_coating::sim::{Stage, StageTimes};
use serde::{Deserialize, Serialize};

/// Seconds spent, by what they were spent on. The parts sum to the total.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Seconds {
    /// From start to end, with reading and writing.
    pub total: f64,
    /// Making films of meshes, and casting what shelters them.
    pub build: f64,
    /// Forces, separation, tearing, stripping, and setting of constraints.
    pub fracture: f64,
    /// PBD-2.
    pub deform: f64,
    /// Making the meshes and textures of the aged model.
    pub mesh: f64,
    /// Rust, dust and moisture.
    pub stain: f64,
    /// All else: reading, measuring, writing.
    pub other: f64,
}

/// Keeps [`Seconds`].
#[derive(Clone, Copy, Debug)]
pub struct Stopwatch {
    start: Instant,
    build: Duration,
    stages: StageTimes,
}

impl Stopwatch {
    /// Starts now.
    pub fn start() -> Self {
        Self { start: Instant::now(), build: Duration::ZERO, stages: StageTimes::default() }
    }

    /// Runs `work`, which is building.
    pub fn build<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.build += start.elapsed();
        result
    }

    /// Runs `work`, which is making meshes.
    pub fn mesh<T>(&mut self, work: impl FnOnce() -> T) -> T {
        self.stages.measure(Stage::MeshGeneration, work)
    }

    /// Adds stages that films went through side by side within `wall` time: if they took longer together, each
    /// gets its share of it.
    pub fn add_stages(&mut self, stages: &StageTimes, wall: Duration) {
        let all = [Stage::Fracture, Stage::Deformation, Stage::MeshGeneration, Stage::Stains];
        let sum: Duration = all.iter().map(|&stage| stages.of(stage)).sum();
        let scale = if sum > wall { wall.as_secs_f64() / sum.as_secs_f64() } else { 1.0 };
        for stage in all {
            self.stages.add(stage, stages.of(stage).mul_f64(scale));
        }
    }

    /// Seconds up to now.
    pub fn seconds(&self) -> Seconds {
        let of = |stage| self.stages.of(stage).as_secs_f64();
        let (fracture, deform) = (of(Stage::Fracture), of(Stage::Deformation));
        let (build, mesh, stain) = (self.build.as_secs_f64(), of(Stage::MeshGeneration), of(Stage::Stains));
        let total = self.start.elapsed().as_secs_f64();
        let other = (total - (build + fracture + deform + mesh + stain)).max(0.0);
        Seconds { total, build, fracture, deform, mesh, stain, other }
    }
}
