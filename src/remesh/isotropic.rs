//! Isotropic remeshing of any clean surface to a film of even, irregular triangles.
//!
//! The method is that of Botsch and Kobbelt, "A Remeshing Approach to Multiresolution Modeling" (2004): a few rounds in
//! which long edges are split, short ones are collapsed, edges are flipped towards Delaunay, and vertices are relaxed
//! tangentially and projected back. Feature lines (`features.rs`) and topology (`collapse.rs`) are kept. Seeded jitter
//! keeps flat regions free of grid patterns, which cracks would follow.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::{
    collapse::{self, CollapseLimits},
    features::{Fidelity, Scale},
    film::{BuiltFilm, MAX_FILM_TRIANGLES},
    flip,
    loss::ShapeLoss,
    order, polish,
    reference::Reference,
    relax::{self, Relaxation},
    sites,
    sizing::LEAST_PART,
    split::{self, SplitLimits},
    target::{FilmTarget, count_of_edge, edge_of_area},
    work_mesh::{WorkMesh, quality},
};
use crate::{
    rest::Rest,
    surface::{BuildError, BuildWarning, CleanSurface, Surface},
};

/// Split and collapse thresholds over the target edge length (Botsch and Kobbelt: 4/3 and 4/5).
const SPLIT: f32 = 4.0 / 3.0;
const COLLAPSE: f32 = 4.0 / 5.0;
/// Largest distance of a film edge from its feature line, in target edges.
const DEVIATION: f32 = 0.08;
/// Distance of the middle of an edge from the surface above which the edge is split, in target edges.
const STRAY_SPLIT: f32 = 0.15;
/// Largest such distance after a collapse.
const STRAY_COLLAPSE: f32 = 0.1;
/// Length of the shortest edge that is split because of its distance, in target edges.
const STRAY_SHORTEST: f32 = 0.5;
/// Rounds of split, collapse, flip and relax.
const ROUNDS: usize = 10;
/// Number of first rounds that do not split edges at bends of the surface.
const SETTLING_ROUNDS: usize = 4;
/// Largest random displacement of a vertex in each round, in target edges. Relaxation alone ends in straight rows of
/// equilateral triangles; with the displacement a flat quad looks like the Delaunay triangulation of blue noise.
const JITTER: f32 = 0.4;
/// Number of last rounds, which relax without random displacement.
const CALM_ROUNDS: usize = 2;
/// Number of rounds that repair thin faces.
const POLISH_ROUNDS: usize = 3;
/// Relaxation accepts a move that leaves no face below this quality, even if it makes the worst face worse.
const FAIR: f32 = 0.75;
/// The same quality while vertices are displaced at random.
const FAIR_SHAKEN: f32 = 0.3;
/// Ratio of the mean edge at the end to the edge length from which the thresholds are made.
const SETTLED: f32 = 0.925;
/// Largest factor by which the target edge may grow or shrink to meet the count.
const ADJUSTMENT: f32 = 2.0;
/// Share by which the count may be above its target without a warning.
const COUNT_TOLERANCE: f64 = 0.05;
/// The same share if the target is an edge length, which fixes the count less sharply.
const LENGTH_TOLERANCE: f64 = 0.25;

/// Factor of the distances from the surface that are allowed where the film would lose too much of a round shape.
const CLOSER: f32 = 0.4;
/// Largest number of triangles of a film that follows its features, over the number asked for.
const MOST: f64 = 1.5;
/// Number of faces at which splitting stops, over the number asked for.
const MOST_WHILE_SPLITTING: f64 = 4.0;
/// Quality below which a triangle is a needle, about seventeen times as long as wide.
const NEEDLE: f32 = 0.1;
/// Largest share of needles in the film's area that facets may force on it.
const MOST_NEEDLES: f64 = 0.25;

/// Remeshes the surface, or keeps its triangles if the target says so. Where features or topology do not allow a film
/// as coarse as asked for, it is finer and has a warning. It rests between the pieces of its work.
///
/// # Errors
/// [`BuildError::TooLarge`] only.
pub(super) async fn remesh(
    surface: &Surface,
    clean: &CleanSurface,
    target: FilmTarget,
    seed: u64,
    rest: &mut impl Rest,
) -> Result<BuiltFilm, BuildError> {
    let area = area_of(clean);
    let (count, length) = match target {
        FilmTarget::Triangles(n) => (f64::from(n), edge_of_area(area / f64::from(n))),
        FilmTarget::EdgeLength(l) => (count_of_edge(area, l), l),
        FilmTarget::Keep => return sites::keep(surface, clean),
    };
    if count > MAX_FILM_TRIANGLES as f64 {
        return Err(BuildError::TooLarge { found: count as usize, limit: MAX_FILM_TRIANGLES });
    }
    let mut fidelity = Fidelity::Facets;
    let (mut film, starved) = loop {
        let scale = Scale { target: length, triangles: count as f32, fidelity };
        let mut reference = Reference::new(surface, clean, scale, rest).await;
        let less = fidelity.next();
        // Every fixed vertex takes a triangle or two.
        if let Some(less) = less
            && reference.fixed.iter().filter(|&&fixed| fixed).count() as f64 > count
        {
            fidelity = less;
            continue;
        }
        let goal = Goal { target, length, count, fidelity, seed };
        let (mut film, asks_too_much) = build(surface, clean, &reference, goal, rest).await;
        if let Some(less) = less
            && asks_too_much
        {
            fidelity = less;
            continue;
        }
        // Bars thinner than the triangles lose their roundness, unless the film is held closer to them.
        let loss = ShapeLoss::of(clean, &film, rest).await;
        if loss.excess() > 1.0 {
            reference.closeness = CLOSER;
            let (closer, asks_too_much) = build(surface, clean, &reference, goal, rest).await;
            if !asks_too_much && ShapeLoss::of(clean, &closer, rest).await.excess() < loss.excess() {
                film = closer;
            }
        }
        break (film, reference.sizing.starved);
    };
    let tolerance = if is_count(target) { COUNT_TOLERANCE } else { LENGTH_TOLERANCE };
    let found = film.triangles.len();
    let target = count as u32;
    if found as f64 > count * (1.0 + tolerance) {
        film.warnings.push(BuildWarning::FeaturesDenserThanTarget { target, triangles: found as u32 });
    }
    if fidelity != Fidelity::Facets {
        film.warnings.push(BuildWarning::FeaturesSimplified { target });
    }
    if starved > 0 {
        let triangles = (f64::from(starved) * 2.0 * LEAST_PART).ceil() as u32;
        film.warnings.push(BuildWarning::SmallPartsCoarse { parts: starved, triangles });
    }
    film.warnings.extend(ShapeLoss::of(clean, &film, rest).await.warning(target));
    rest.rest().await;
    Ok(order::along_curve(film))
}

/// Goal of one try.
#[derive(Clone, Copy)]
struct Goal {
    target: FilmTarget,
    /// Length of the edges.
    length: f32,
    /// Number of the triangles.
    count: f64,
    fidelity: Fidelity,
    seed: u64,
}

/// Remeshes the surface once. Returns whether that asks for too many triangles, too.
async fn build(
    surface: &Surface,
    clean: &CleanSurface,
    reference: &Reference<'_>,
    goal: Goal,
    rest: &mut impl Rest,
) -> (BuiltFilm, bool) {
    let mut mesh = WorkMesh::new(reference);
    rest.rest().await;
    run(&mut mesh, goal, rest).await;
    let asks_too_much = asks_too_much(&mesh, goal.count, goal.fidelity);
    let film = sites::finish(&mesh, surface, clean, rest).await;
    (film, asks_too_much)
}

/// Returns whether the features are too close together for the count. Facets that force needles on the film are given
/// up too.
fn asks_too_much(mesh: &WorkMesh, count: f64, fidelity: Fidelity) -> bool {
    if mesh.topology.live_faces() as f64 > MOST * count {
        return true;
    }
    if fidelity != Fidelity::Facets {
        return false;
    }
    let (mut all, mut thin) = (0.0, 0.0);
    for f in mesh.topology.faces() {
        let [a, b, c] = mesh.topology.corners(f).map(|v| mesh.position(v));
        let area = f64::from(mesh.area_vector(f).length());
        all += area;
        thin += if quality(a, b, c) < NEEDLE { area } else { 0.0 };
    }
    thin > MOST_NEEDLES * all
}

fn is_count(target: FilmTarget) -> bool {
    matches!(target, FilmTarget::Triangles(_))
}

async fn run(mesh: &mut WorkMesh<'_>, goal: Goal, rest: &mut impl Rest) {
    let Goal { target, length, count, seed, .. } = goal;
    let rng = &mut ChaCha8Rng::seed_from_u64(seed);
    // A count is approached from the fine side, since detail of a scan that early collapses lose never comes back.
    let mut edge = if is_count(target) { length } else { length / SETTLED };
    let most = (MOST_WHILE_SPLITTING * count) as usize + mesh.topology.live_faces();
    for round in 0..ROUNDS {
        // In the first rounds the edges are still too long or too short to judge bends by them.
        let stray = if round < SETTLING_ROUNDS { f32::MAX } else { STRAY_SPLIT * edge };
        split::split_edges(mesh, SplitLimits { stray, ..cuts(edge, most) }, rng, rest).await;
        flip::flip_edges(mesh, rest).await;
        collapse::collapse_short_edges(mesh, limits(edge), rest).await;
        flip::flip_edges(mesh, rest).await;
        relax(mesh, edge, JITTER * edge, rng, rest).await;
        if is_count(target) {
            let ratio = (mesh.topology.live_faces() as f64 / count).sqrt() as f32;
            edge = (edge * ratio).clamp(length / ADJUSTMENT, length * ADJUSTMENT);
        }
    }
    for _ in 0..CALM_ROUNDS {
        relax(mesh, edge, 0.0, rng, rest).await;
        split::split_edges(mesh, cuts(edge, most), rng, rest).await;
        flip::flip_edges(mesh, rest).await;
    }
    let mut fewest_faces = 4;
    if let FilmTarget::Triangles(count) = target {
        let limits = CollapseLimits { fewest_faces: count as usize, ..limits(edge) };
        meet_count(mesh, edge, limits, rng, rest).await;
        fewest_faces = (count as usize).saturating_sub(count as usize / 100).max(4);
    }
    for _ in 0..POLISH_ROUNDS {
        let limits = CollapseLimits { shortest: edge, longest: 1.5 * edge, quality: 1.0, fewest_faces, ..limits(edge) };
        polish::polish(mesh, limits, edge, rest).await;
    }
}

/// Collapses the shortest or splits the longest edges until the count is met.
async fn meet_count(
    mesh: &mut WorkMesh<'_>,
    edge: f32,
    limits: CollapseLimits,
    rng: &mut ChaCha8Rng,
    rest: &mut impl Rest,
) {
    let reserve = CollapseLimits { shortest: edge, longest: 1.5 * edge, ..limits };
    collapse::collapse_short_edges(mesh, reserve, rest).await;
    split::split_longest_edges(mesh, edge, limits.fewest_faces, rng, rest).await;
    flip::flip_edges(mesh, rest).await;
}

fn cuts(edge: f32, most_faces: usize) -> SplitLimits {
    SplitLimits { longest: SPLIT * edge, stray: STRAY_SPLIT * edge, shortest: STRAY_SHORTEST * edge, most_faces }
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

async fn relax(mesh: &mut WorkMesh<'_>, edge: f32, jitter: f32, rng: &mut ChaCha8Rng, rest: &mut impl Rest) {
    let quality = if jitter > 0.0 { FAIR_SHAKEN } else { FAIR };
    let settings = Relaxation { step: 0.7, jitter, deviation: DEVIATION * edge, stray: STRAY_COLLAPSE * edge, quality };
    relax::relax(mesh, settings, rng, rest).await;
    flip::flip_edges(mesh, rest).await;
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
