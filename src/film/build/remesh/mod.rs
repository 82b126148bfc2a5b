//! Isotropic remeshing of any clean surface to a film of even, irregular triangles.
//!
//! Botsch and Kobbelt, "A Remeshing Approach to Multiresolution Modeling" (2004): split long edges, collapse short
//! ones, flip towards Delaunay, relax tangentially, project back; a few rounds. Feature lines are kept
//! ([`features`]), topology is kept ([`collapse`]), and seeded jitter keeps flat regions free of grid patterns,
//! which cracks would follow.

mod attributes;
mod chains;
mod collapse;
mod features;
mod flip;
mod mesh;
mod noise;
mod polish;
mod project;
mod reference;
mod relax;
mod sites;
mod split;
mod topology;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use self::collapse::CollapseLimits;
use self::mesh::WorkMesh;
use self::reference::Reference;
use self::relax::Relaxation;
use self::split::SplitLimits;
use super::{BuildError, BuildWarning, BuiltFilm, CleanSurface, MAX_FILM_TRIANGLES, Surface};

pub(super) use self::sites::keep;

/// Split and collapse thresholds over the target edge length (Botsch and Kobbelt: 4/3 and 4/5).
const SPLIT: f32 = 4.0 / 3.0;
const COLLAPSE: f32 = 4.0 / 5.0;
/// How far a film edge may stray from its feature line, in target edges.
const DEVIATION: f32 = 0.08;
/// How far the middle of an edge may be from the surface, in target edges, before it is split, and after a
/// collapse; and the shortest edge that is split for it.
const STRAY_SPLIT: f32 = 0.2;
const STRAY_COLLAPSE: f32 = 0.12;
const STRAY_SHORTEST: f32 = 0.5;
/// Rounds of split, collapse, flip and relax.
const ROUNDS: usize = 12;
/// Rounds of repairs of thin faces.
const POLISH_ROUNDS: usize = 3;
/// The first rounds shake the vertices.
const SHAKEN_ROUNDS: usize = 4;
/// Faces of this quality and better may be traded for evenness.
const FAIR: f32 = 0.75;
/// The most the target edge may grow or shrink to meet the count.
const ADJUSTMENT: f32 = 2.0;
/// Counts within this share of the target are met.
const TOLERANCE: f32 = 0.05;

/// What to remesh to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Target {
    /// This many triangles.
    Count(u32),
    /// This edge length.
    Length(f32),
}

/// Side of the equilateral triangle of this area.
pub(super) fn edge_of_area(area: f64) -> f32 {
    (area * 4.0 / 3.0_f64.sqrt()).sqrt() as f32
}

/// Number of equilateral triangles of this side that cover the area.
pub(super) fn count_of_edge(area: f64, edge: f32) -> f64 {
    area * 4.0 / (3.0_f64.sqrt() * f64::from(edge) * f64::from(edge))
}

/// Remeshes the surface. Where features or topology do not let the film be as coarse as wanted it is finer, with a
/// warning.
///
/// # Errors
/// [`BuildError::TooLarge`] only.
pub(super) fn remesh(
    surface: &Surface,
    clean: &CleanSurface,
    target: Target,
    seed: u64,
) -> Result<BuiltFilm, BuildError> {
    let area = area_of(clean);
    let (count, length) = match target {
        Target::Count(n) => (f64::from(n), edge_of_area(area / f64::from(n))),
        Target::Length(l) => (count_of_edge(area, l), l),
    };
    if count > MAX_FILM_TRIANGLES as f64 {
        return Err(BuildError::TooLarge { found: count as usize, limit: MAX_FILM_TRIANGLES });
    }
    let reference = Reference::new(surface, clean, length, count as f32);
    let mut mesh = WorkMesh::new(&reference);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    run(&mut mesh, target, length, count, &mut rng);

    let mut film = sites::finish(&mesh, surface, clean);
    let found = film.triangles.len();
    if found as f64 > count * f64::from(1.0 + TOLERANCE) {
        film.warnings.push(BuildWarning::FeaturesDenserThanTarget { target: count as u32, triangles: found as u32 });
    }
    Ok(film)
}

fn run(mesh: &mut WorkMesh, target: Target, length: f32, count: f64, rng: &mut ChaCha8Rng) {
    let mut edge = length;
    for round in 0..ROUNDS {
        let shaken = round < SHAKEN_ROUNDS;
        let spread = if shaken { 0.4 } else { 0.0 };
        split::split_edges(mesh, cuts(edge, spread), rng);
        flip::flip_edges(mesh);
        collapse::collapse_short_edges(mesh, limits(edge));
        flip::flip_edges(mesh);
        let jitter = if shaken { 0.25 * edge } else { 0.0 };
        relax_rounds(mesh, edge, jitter, 2, rng);
        if let Target::Count(_) = target {
            let ratio = (mesh.topology.live_faces() as f64 / count).sqrt() as f32;
            edge = (edge * ratio).clamp(length / ADJUSTMENT, length * ADJUSTMENT);
        }
    }
    relax_rounds(mesh, edge, 0.0, 2, rng);
    split::split_edges(mesh, cuts(edge, 0.0), rng);
    flip::flip_edges(mesh);
    for _ in 0..POLISH_ROUNDS {
        let limits = CollapseLimits { shortest: edge, longest: 1.5 * edge, quality: 1.0, ..limits(edge) };
        polish::polish(mesh, limits, edge);
    }
}

fn cuts(edge: f32, spread: f32) -> SplitLimits {
    SplitLimits { longest: SPLIT * edge, stray: STRAY_SPLIT * edge, shortest: STRAY_SHORTEST * edge, spread }
}

fn limits(edge: f32) -> CollapseLimits {
    CollapseLimits {
        shortest: COLLAPSE * edge,
        longest: SPLIT * edge,
        deviation: DEVIATION * edge,
        stray: STRAY_COLLAPSE * edge,
        quality: 0.3,
        fewest_faces: 4,
    }
}

fn relax_rounds(mesh: &mut WorkMesh, edge: f32, jitter: f32, rounds: usize, rng: &mut ChaCha8Rng) {
    for round in 0..rounds {
        let jitter = if round == 0 { jitter } else { 0.0 };
        let quality = if jitter > 0.0 { 0.3 } else { FAIR };
        let settings =
            Relaxation { step: 0.7, jitter, deviation: DEVIATION * edge, stray: STRAY_COLLAPSE * edge, quality };
        relax::relax(mesh, settings, rng);
        flip::flip_edges(mesh);
    }
}

fn area_of(clean: &CleanSurface) -> f64 {
    clean
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| clean.positions[v as usize]);
            0.5 * f64::from((b - a).cross(c - a).length())
        })
        .sum()
}
