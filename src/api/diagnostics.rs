//! Diagnostics: wall time of each stage a frame, grouped as in the paper's Table 1, and the number of films.

use bevy::{
    app::{App, Last},
    diagnostic::{Diagnostic, DiagnosticPath, Diagnostics, RegisterDiagnostic},
    ecs::{
        resource::Resource,
        system::{Res, ResMut},
    },
};

use super::status::CoatingStatus;
use crate::sim::{Stage, StageTimes};
/// Milliseconds a frame spent on forces, separation, tearing, stripping and setting of constraints.
pub const FRACTURE: DiagnosticPath = DiagnosticPath::const_new("coating/fracture");
/// Milliseconds a frame spent on PBD-2.
pub const DEFORMATION: DiagnosticPath = DiagnosticPath::const_new("coating/deformation");
/// Milliseconds a frame spent on generating meshes for display.
pub const MESH_GENERATION: DiagnosticPath = DiagnosticPath::const_new("coating/mesh_generation");
/// Milliseconds a frame spent on stains.
pub const STAINS: DiagnosticPath = DiagnosticPath::const_new("coating/stains");
/// Milliseconds a frame spent on all else: clocks, messages, bookkeeping.
pub const OTHER: DiagnosticPath = DiagnosticPath::const_new("coating/other");
/// Films that are ready.
pub const FILMS: DiagnosticPath = DiagnosticPath::const_new("coating/films");
/// Films that took a step in the frame.
pub const STEPPED: DiagnosticPath = DiagnosticPath::const_new("coating/stepped");

const STAGES: [(Stage, DiagnosticPath); 5] = [
    (Stage::Fracture, FRACTURE),
    (Stage::Deformation, DEFORMATION),
    (Stage::MeshGeneration, MESH_GENERATION),
    (Stage::Stains, STAINS),
    (Stage::Other, OTHER),
];

/// Time spent in this frame.
#[derive(Resource, Debug, Default)]
pub(crate) struct CoatingTimings(StageTimes);

impl CoatingTimings {
    /// Runs `work` and adds its time to `stage`.
    pub fn measure<T>(&mut self, stage: Stage, work: impl FnOnce() -> T) -> T {
        self.0.measure(stage, work)
    }
}

pub(crate) fn add_diagnostics(app: &mut App) {
    app.init_resource::<CoatingTimings>();
    for (_, path) in STAGES {
        app.register_diagnostic(Diagnostic::new(path).with_suffix(" ms"));
    }
    app.register_diagnostic(Diagnostic::new(FILMS)).register_diagnostic(Diagnostic::new(STEPPED));
    app.add_systems(Last, publish);
}

fn publish(mut diagnostics: Diagnostics, mut timings: ResMut<CoatingTimings>, status: Res<CoatingStatus>) {
    for (stage, path) in &STAGES {
        diagnostics.add_measurement(path, || timings.0.of(*stage).as_secs_f64() * 1e3);
    }
    diagnostics.add_measurement(&FILMS, || status.films as f64);
    diagnostics.add_measurement(&STEPPED, || status.stepped as f64);
    timings.0 = StageTimes::default();
}
