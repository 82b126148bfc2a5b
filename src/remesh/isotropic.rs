//! Isotropic remeshing of any clean surface to a film of even, irregular triangles.
//!
//! Botsch and Kobbelt, "A Remeshing Approach to Multiresolution Modeling" (2004): split long edges, collapse short
//! ones, flip towards Delaunay, relax tangentially, project back; a few rounds. Feature lines are kept
//! ([`features`]), topology is kept ([`collapse`]), and seeded jitter keeps flat regions free of grid patterns,
//! which cracks would follow.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::{
    collapse::{self, CollapseLimits},
    film::{BuiltFilm, MAX_FILM_TRIANGLES},
    flip, polish,
    reference::Reference,
    relax::{self, Relaxation},
    resolution::Target,
    sites,
    split::{self, SplitLimits},
    work_mesh::WorkMesh,
};
use crate::surface::{BuildError, BuildWarning, CleanSurface, Surface};

/// Split and collapse thresholds over the target edge length (Botsch and Kobbelt: 4/3 and 4/5).
const SPLIT: f32 = 4.0 / 3.0;
const COLLAPSE: f32 = 4.0 / 5.0;
/// How far a film edge may stray from its feature line, in target edges.
const DEVIATION: f32 = 0.08;
/// How far the middle of an edge may be from the surface, in target edges, before it is split, and after a
/// collapse; and the shortest edge that is split for it.
const STRAY_SPLIT: f32 = 0.15;
const STRAY_COLLAPSE: f32 = 0.1;
const STRAY_SHORTEST: f32 = 0.5;
/// Rounds of split, collapse, flip and relax.
const ROUNDS: usize = 10;
/// The first of them do not look at bends of the surface.
const SETTLING_ROUNDS: usize = 4;
/// Every round shakes the vertices by up to so many target edges: relaxation alone ends in crystals, with straight
/// rows of equilateral triangles. With it a flat quad looks like blue noise with its Delaunay triangles.
const JITTER: f32 = 0.4;
/// Rounds of relaxing without shaking in the end.
const CALM_ROUNDS: usize = 2;
/// Rounds of repairs of thin faces.
const POLISH_ROUNDS: usize = 3;
/// Faces of this quality and better may be traded for evenness; while shaking, of this.
const FAIR: f32 = 0.75;
const FAIR_SHAKEN: f32 = 0.3;
/// Mean edge that the rounds settle at, over the edge that their thresholds are made of.
const SETTLED: f32 = 0.925;
/// The most the target edge may grow or shrink to meet the count.
const ADJUSTMENT: f32 = 2.0;
/// Counts up to this share above the target are met; a target edge length fixes the count less sharply.
const COUNT_TOLERANCE: f64 = 0.05;
const LENGTH_TOLERANCE: f64 = 0.25;

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
    let tolerance = match target {
        Target::Count(_) => COUNT_TOLERANCE,
        Target::Length(_) => LENGTH_TOLERANCE,
    };
    if found as f64 > count * (1.0 + tolerance) {
        film.warnings.push(BuildWarning::FeaturesDenserThanTarget { target: count as u32, triangles: found as u32 });
    }
    Ok(film)
}

fn run(mesh: &mut WorkMesh, target: Target, length: f32, count: f64, rng: &mut ChaCha8Rng) {
    // A count is approached from the fine side: what the first collapses lose of a scan never comes back.
    let mut edge = match target {
        Target::Count(_) => length,
        Target::Length(_) => length / SETTLED,
    };
    for round in 0..ROUNDS {
        // Early on the mesh is still too coarse or too fine for its edges to tell bends.
        let stray = if round < SETTLING_ROUNDS { f32::MAX } else { STRAY_SPLIT * edge };
        split::split_edges(mesh, SplitLimits { stray, ..cuts(edge) }, rng);
        flip::flip_edges(mesh);
        collapse::collapse_short_edges(mesh, limits(edge));
        flip::flip_edges(mesh);
        relax(mesh, edge, JITTER * edge, rng);
        if let Target::Count(_) = target {
            let ratio = (mesh.topology.live_faces() as f64 / count).sqrt() as f32;
            edge = (edge * ratio).clamp(length / ADJUSTMENT, length * ADJUSTMENT);
        }
    }
    for _ in 0..CALM_ROUNDS {
        relax(mesh, edge, 0.0, rng);
        split::split_edges(mesh, cuts(edge), rng);
        flip::flip_edges(mesh);
    }
    let mut fewest_faces = 4;
    if let Target::Count(count) = target {
        meet_count(mesh, edge, count as usize, rng);
        fewest_faces = (count as usize).saturating_sub(count as usize / 100).max(4);
    }
    for _ in 0..POLISH_ROUNDS {
        let limits = CollapseLimits { shortest: edge, longest: 1.5 * edge, quality: 1.0, fewest_faces, ..limits(edge) };
        polish::polish(mesh, limits, edge);
    }
}

/// Collapses the shortest or splits the longest edges until the count is met.
fn meet_count(mesh: &mut WorkMesh, edge: f32, count: usize, rng: &mut ChaCha8Rng) {
    let reserve = CollapseLimits { shortest: edge, longest: 1.5 * edge, fewest_faces: count, ..limits(edge) };
    collapse::collapse_short_edges(mesh, reserve);
    split::split_longest_edges(mesh, edge, count, rng);
    flip::flip_edges(mesh);
}

fn cuts(edge: f32) -> SplitLimits {
    SplitLimits { longest: SPLIT * edge, stray: STRAY_SPLIT * edge, shortest: STRAY_SHORTEST * edge }
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

fn relax(mesh: &mut WorkMesh, edge: f32, jitter: f32, rng: &mut ChaCha8Rng) {
    let quality = if jitter > 0.0 { FAIR_SHAKEN } else { FAIR };
    let settings = Relaxation { step: 0.7, jitter, deviation: DEVIATION * edge, stray: STRAY_COLLAPSE * edge, quality };
    relax::relax(mesh, settings, rng);
    flip::flip_edges(mesh);
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
