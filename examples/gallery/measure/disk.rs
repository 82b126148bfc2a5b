//! A disk in free space, all of whose edges are to bend at once (VC fig. 6).

use core::f32::consts::PI;

use bevy_coating::{film::VertexId, settings::CoatingSettings, sim::FilmState, stain::Environment};
use bevy_math::Vec3;

use super::exhibit::{Beginning, Exhibit, NoFilm, Shape, held};

/// Angle by which edges are to bend, in radians: the paper's 10 degrees, which are off flat.
const BEND: f32 = PI / 18.0;
/// Plain sweeps in one unit of age, and the ages at which the disk is looked at.
pub const SWEEPS: f32 = 100_000.0;
pub const AGES: [f64; 3] = [0.01, 0.1, 1.0];

/// Returns settings under which everything lets go at once, and all targets are narrow at once.
pub fn settings() -> CoatingSettings {
    let mut settings = held();
    (settings.deform.narrowing_rate, settings.deform.bend_limit) = (100.0, BEND);
    settings.deform.sweeps_per_age = SWEEPS;
    settings.dust.rate = 0.0;
    settings
}

/// Returns the disk.
pub fn disk() -> Exhibit {
    Exhibit { beginning: Beginning::Free, ..Exhibit::new("disk", "", Shape::Disk(4_047), settings()) }
}

/// Shape of the disk at an age.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bent {
    /// Mean height of the rim above the middle, in radii.
    pub rim: f64,
    /// Height of the highest point of the rim, in radii.
    pub highest: f64,
    /// Mean angle by which edges are bent, in degrees.
    pub bend: f64,
    /// Root mean square of the strain of edges.
    pub strain: f64,
}

/// Bends the disk and measures it at each of [`AGES`].
///
/// # Errors
/// [`NoFilm`] if there is no disk.
pub fn bent() -> Result<[Bent; 3], NoFilm> {
    let disk = disk();
    let mut film = disk.film(1000)?;
    Ok(AGES.map(|age| {
        film.age_to(age, &disk.settings, &Environment::default());
        measured(&film)
    }))
}

fn measured(film: &FilmState) -> Bent {
    let (topology, geometry) = (&film.mesh.topology, &film.mesh.geometry);
    let distance = |v: &VertexId| geometry.rest_positions[v.index()].length();
    let middle = topology.all_vertices().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    let middle = middle.map_or(Vec3::ZERO, |v| geometry.positions[v.index()]);
    let rim: Vec<f64> = (topology.all_vertices().filter(|&v| topology.is_border(v)))
        .map(|v| f64::from(geometry.positions[v.index()].z - middle.z))
        .collect();
    let bends: Vec<f64> = (topology.all_edges())
        .filter_map(|h| geometry.dihedral(topology, h))
        .map(|angle| f64::from(PI - angle).to_degrees())
        .collect();
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
    Bent {
        rim: mean(&rim),
        highest: rim.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        bend: mean(&bends),
        strain: film.measure().strain_rms.unwrap_or_default(),
    }
}
