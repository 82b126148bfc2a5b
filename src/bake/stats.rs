//! Measures a run and writes its figures as JSON.

use bevy_math::ops;
use serde::{Deserialize, Serialize};

use super::{model::ModelMesh, stopwatch::Seconds};
use crate::{
    film::{FaceId, HalfEdgeId},
    sim::{FilmMeasures, FilmState},
};

/// Version of the layout of [`Stats`].
pub const STATS_SCHEMA: u32 = 1;

/// All figures of a run.
///
/// ```
/// use bevy_coating::bake::{BakeOptions, Images, Input, STATS_SCHEMA, Stopwatch, bake};
///
/// let model = Input::parse("plate:50".as_ref())?.read(0, Images::Skip)?;
/// let options = BakeOptions { age: 0.0, ..BakeOptions::default() };
/// let stats = bake(model, &options, Stopwatch::start(), &())?.stats();
/// assert_eq!((stats.schema, stats.input.triangles, stats.film.components), (STATS_SCHEMA, 50, 1));
/// assert!(stats.to_json().contains(&stats.digest));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stats {
    /// Version of the layout: [`STATS_SCHEMA`].
    pub schema: u32,
    /// Size of the model that was read.
    pub input: InputStats,
    /// Figures of the films at rest.
    pub film: FilmStats,
    /// Options of the run.
    pub run: RunStats,
    /// Seconds spent, by what they were spent on.
    pub seconds: Seconds,
    /// Figures of all films together at every twentieth of age, and at the last one.
    pub timeline: Vec<FilmMeasures>,
    /// Digest of all films in order, in hexadecimal: [`DIGEST_ALGORITHM`](crate::sim::DIGEST_ALGORITHM) over the fields
    /// documented at [`FilmState::digest_into`]. Holds no timings.
    pub digest: String,
}

/// Size of the model that was read, as stored: nothing welded, meshes under several nodes counted for each.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct InputStats {
    /// Number of triangles.
    pub triangles: u64,
    /// Number of vertices.
    pub vertices: u64,
}

/// Figures of all films together, at rest.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FilmStats {
    /// Number of faces.
    pub triangles: u64,
    /// Number of vertices.
    pub vertices: u64,
    /// Mean length of the edges, each once, in metres; `None` without any.
    pub mean_edge: Option<f64>,
    /// Standard deviation of the edges' lengths (of the population) over their mean; `None` without any.
    pub edge_cv: Option<f64>,
    /// Smallest angle of any face, in degrees; `None` without any.
    pub min_angle_deg: Option<f64>,
    /// Grain of each film, in metres: longer than the one that was asked for where the film is too coarse for it.
    /// Empty by the paper's rules, which have no grain.
    pub grain: Vec<f32>,
    /// Number of connected components.
    pub components: u64,
    /// Number of loops of border edges.
    pub border_loops: u64,
    /// Euler characteristic: vertices less edges plus faces.
    pub euler: i64,
}

/// Options of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RunStats {
    /// Age that was asked for.
    pub age: f64,
    /// Steps per unit age.
    pub steps: u32,
    /// Seed of films and forces.
    pub seed: u64,
    /// Name or file of the preset.
    pub preset: String,
    /// Sweeps of the solver per unit age that the settings ask for.
    pub sweeps_per_age: f32,
    /// Name of the solver's quality.
    pub quality: String,
}

impl Stats {
    /// Returns the figures as JSON text, with a line end. Numbers that are not finite become null.
    pub fn to_json(&self) -> String {
        // Plain structs cannot fail to serialise.
        let mut text = serde_json::to_string_pretty(self).unwrap_or_default();
        text.push('\n');
        text
    }
}

impl InputStats {
    /// Counts triangles and vertices.
    pub(super) fn of(meshes: &[ModelMesh]) -> Self {
        Self {
            triangles: meshes.iter().map(|mesh| mesh.surface.triangles.len() as u64).sum(),
            vertices: meshes.iter().map(|mesh| mesh.surface.positions.len() as u64).sum(),
        }
    }
}

impl FilmStats {
    /// Measures films, as they were at rest whatever their age.
    pub(super) fn of(films: &[FilmState]) -> Self {
        let grains = films.iter().filter_map(|film| film.forces.grain());
        let mut stats = Self { grain: grains.map(|grain| grain.length).collect(), ..Self::default() };
        let (mut sum, mut squares, mut edges) = (0.0f64, 0.0f64, 0u64);
        let mut least_angle = f64::INFINITY;
        for film in films {
            let (topology, geometry) = (&film.mesh.topology, &film.mesh.geometry);
            for h in topology.all_edges() {
                let length = f64::from(geometry.rest_lengths[h.index()]);
                sum += length;
                squares += length * length;
                edges += 1;
            }
            for f in topology.all_faces() {
                least_angle = least_angle.min(least_angle_of(film, f));
            }
            stats.triangles += topology.face_count() as u64;
            stats.vertices += topology.original_vertex_count() as u64;
            stats.components += components(film);
            stats.border_loops += border_loops(film);
        }
        stats.euler = stats.vertices as i64 - edges as i64 + stats.triangles as i64;
        if edges > 0 && sum > 0.0 {
            let mean = sum / edges as f64;
            let variance = (squares / edges as f64 - mean * mean).max(0.0);
            stats.mean_edge = Some(mean);
            stats.edge_cv = Some(variance.sqrt() / mean);
            stats.min_angle_deg = Some(least_angle.to_degrees());
        }
        stats
    }
}

/// Smallest angle of a face at rest, in radians.
fn least_angle_of(film: &FilmState, f: FaceId) -> f64 {
    let p = film.mesh.topology.corners(f).map(|v| film.mesh.geometry.rest_positions[v.index()]);
    let angle = |i: usize| {
        let (a, b) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
        f64::from(ops::atan2(a.cross(b).length(), a.dot(b)))
    };
    angle(0).min(angle(1)).min(angle(2))
}

/// Components of the film at rest: faces joined across edges.
fn components(film: &FilmState) -> u64 {
    let topology = &film.mesh.topology;
    let mut seen = vec![false; topology.face_count()];
    let (mut count, mut stack) = (0, Vec::new());
    for seed in topology.all_faces() {
        if seen[seed.index()] {
            continue;
        }
        count += 1;
        seen[seed.index()] = true;
        stack.push(seed);
        while let Some(f) = stack.pop() {
            for next in f.half_edges().iter().filter_map(|&h| topology.rest_twin(h)).map(HalfEdgeId::face) {
                if !std::mem::replace(&mut seen[next.index()], true) {
                    stack.push(next);
                }
            }
        }
    }
    count
}

/// Loops of border edges at rest. At every border vertex one border edge ends and one begins, so they form
/// closed loops.
fn border_loops(film: &FilmState) -> u64 {
    let topology = &film.mesh.topology;
    let ends = |h: HalfEdgeId| [topology.original(topology.origin(h)), topology.original(topology.target(h))];
    let mut next = vec![HalfEdgeId::NONE; topology.original_vertex_count()];
    let border = || topology.all_half_edges().filter(|&h| topology.rest_twin(h).is_none());
    for h in border() {
        next[ends(h)[0].index()] = h;
    }
    let mut seen = vec![false; topology.half_edge_count()];
    let mut loops = 0;
    for first in border() {
        if seen[first.index()] {
            continue;
        }
        loops += 1;
        let mut at = Some(first);
        while let Some(h) = at.filter(|h| !std::mem::replace(&mut seen[h.index()], true)) {
            at = next[ends(h)[1].index()].get();
        }
    }
    loops
}
