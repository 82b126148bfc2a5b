//! The paper's Table 1: how long ageing takes on this machine, and what the time goes to.

use std::time::Instant;

use bevy_coating::{
    appearance::{DisplayChanges, FilmAppearance},
    remesh::build_film,
    settings::{CoatingSettings, Preset},
    sim::{FilmState, Stage, StageTimes},
    stain::Environment,
};

use super::exhibit::{NoFilm, Shape};

const STEPS: u32 = 1000;

/// A row: the paper's model and ours, and the paper's seconds for 1,000 steps on an Intel Core i9-10980XE.
pub const ROWS: [(&str, &str, Shape, f64); 3] = [
    ("flat plate", "flat plate", Shape::Plate(3_012), 15.4),
    ("curved plate", "curved plate", Shape::CurvedPlate(3_005), 16.7),
    ("Stanford bunny", "fire hydrant", Shape::Hydrant(10_000), 65.8),
];

/// Time that a model took.
pub struct Time {
    pub triangles: usize,
    pub seconds: f64,
    /// Shares of fracture, deformation, meshes for display and stains.
    pub shares: [f64; 4],
}

/// Ages a model from fresh to age 1 on one thread, with its meshes for display brought up to date after every step.
///
/// # Errors
/// [`NoFilm`] if there is none.
pub fn time(shape: Shape) -> Result<Time, NoFilm> {
    let (settings, environment) = (CoatingSettings::from(Preset::Paper), Environment::default());
    let surface = shape.surface(7)?;
    let built = build_film(&surface, shape.target(), 7)?;
    let mut film = FilmState::new(&built, &settings, 7, STEPS).ok_or(NoFilm::NoManifold)?;
    let mut shown = FilmAppearance::new(&built, &surface, &film.mesh, &film.forces, &film.stains);
    let (mut changes, mut times) = (DisplayChanges::default(), StageTimes::default());
    let start = Instant::now();
    for _ in 0..STEPS {
        film.step_timed(&settings, &environment, &mut times);
        times.measure(Stage::MeshGeneration, || {
            changes.record(&film.changes, &film.stains);
            shown.update(&film.mesh, &film.forces, &film.stains, changes.take());
        });
    }
    let seconds = start.elapsed().as_secs_f64();
    let stages = [Stage::Fracture, Stage::Deformation, Stage::MeshGeneration, Stage::Stains];
    let shares = stages.map(|stage| times.of(stage).as_secs_f64() / seconds.max(f64::MIN_POSITIVE));
    Ok(Time { triangles: film.mesh.topology.face_count(), seconds, shares })
}
