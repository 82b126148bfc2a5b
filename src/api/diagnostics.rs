//! Publishes Bevy diagnostics: wall time of each stage in a frame, grouped as in VC table 1, and the number of films.
//!
//! ```
//! use bevy::{diagnostic::DiagnosticsStore, prelude::*};
//! use bevy_coating::{diagnostics, prelude::*};
//!
//! /// Prints the time that bending took, as a mean over some frames.
//! fn print_bending(store: Res<DiagnosticsStore>) {
//!     if let Some(milliseconds) = store.get(&diagnostics::DEFORMATION).and_then(|stage| stage.smoothed()) {
//!         println!("bending: {milliseconds:.2} ms");
//!     }
//! }
//!
//! # let mut app = App::new();
//! # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
//! # app.add_plugins(CoatingWeatheringPlugin::default());
//! app.add_systems(Update, print_bending);
//! app.update();
//! # let store = app.world().resource::<DiagnosticsStore>();
//! # assert_eq!(store.get(&diagnostics::FILMS).and_then(|films| films.value()), Some(0.0));
//! ```

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

/// Milliseconds of a frame spent on fracture: forces, separation, tearing, stripping and updates of the constraints.
pub const FRACTURE: DiagnosticPath = DiagnosticPath::const_new("coating/fracture");
/// Milliseconds of a frame spent on bending the film (PBD-2, VC 4).
pub const DEFORMATION: DiagnosticPath = DiagnosticPath::const_new("coating/deformation");
/// Milliseconds of a frame spent on generating the meshes that are drawn.
pub const MESH_GENERATION: DiagnosticPath = DiagnosticPath::const_new("coating/mesh_generation");
/// Milliseconds of a frame spent on stains.
pub const STAINS: DiagnosticPath = DiagnosticPath::const_new("coating/stains");
/// Milliseconds of a frame spent on everything else: clocks, messages, bookkeeping.
pub const OTHER: DiagnosticPath = DiagnosticPath::const_new("coating/other");
/// Number of films that are ready.
pub const FILMS: DiagnosticPath = DiagnosticPath::const_new("coating/films");
/// Number of films that took a step in the frame.
pub const STEPPED: DiagnosticPath = DiagnosticPath::const_new("coating/stepped");

const STAGES: [(Stage, DiagnosticPath); 5] = [
    (Stage::Fracture, FRACTURE),
    (Stage::Deformation, DEFORMATION),
    (Stage::MeshGeneration, MESH_GENERATION),
    (Stage::Stains, STAINS),
    (Stage::Other, OTHER),
];

/// Time that each stage has taken in this frame.
#[derive(Resource, Debug, Default)]
pub(crate) struct CoatingTimings(StageTimes);

impl CoatingTimings {
    /// Runs `work` and adds its time to `stage`.
    pub fn measure<T>(&mut self, stage: Stage, work: impl FnOnce() -> T) -> T {
        self.0.measure(stage, work)
    }
}

/// Registers the diagnostics and publishes them in [`Last`].
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
