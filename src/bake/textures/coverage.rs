//! Finds the triangle that each texel of a texture belongs to.

use bevy_math::{Vec2, Vec3};

use super::boxes::bounds;
use crate::bake::parallel;

/// A texel that belongs to no triangle.
pub const NOBODY: u32 = u32::MAX;
/// Rows that are done in one go.
pub const BAND: usize = 32;
/// How far beyond its border a triangle reaches, in texels: so far that sampling between texels at the border finds
/// nothing else.
const REACH: f32 = 1.0;

/// For each texel, row by row from the top, the triangle it belongs to.
pub struct Coverage {
    /// The triangles; [`NOBODY`] for none.
    pub owners: Vec<u32>,
}

impl Coverage {
    /// Gives every texel to the nearest triangle within reach; among several to the first. Corners are in
    /// texels from the top left.
    pub fn new(size: u32, triangles: &[[Vec2; 3]]) -> Self {
        let side = size as usize;
        let mut owners = vec![NOBODY; side * side];
        let mut bands: Vec<(usize, &mut [u32])> = owners.chunks_mut(BAND * side).enumerate().collect();
        parallel::for_each(&mut bands, |(band, owners)| cover(*band * BAND, side, owners, triangles));
        Self { owners }
    }
}

/// Covers a band of rows that starts at `top`.
fn cover(top: usize, side: usize, owners: &mut [u32], triangles: &[[Vec2; 3]]) {
    let rows = owners.len() / side;
    let mut distances = vec![REACH * REACH; owners.len()];
    for (i, triangle) in triangles.iter().enumerate() {
        let [a, b, c] = *triangle;
        let (low, high) = (a.min(b).min(c) - REACH, a.max(b).max(c) + REACH);
        let range = |low: f32, high: f32, first: usize, count: usize| {
            let start = (low - 0.5).ceil().max(first as f32) as usize;
            let end = ((high - 0.5).floor() + 1.0).clamp(0.0, (first + count) as f32) as usize;
            start..end.max(start)
        };
        for y in range(low.y, high.y, top, rows) {
            for x in range(low.x, high.x, 0, side) {
                let at = (y - top) * side + x;
                let (_, distance) = nearest(triangle, texel(x, y));
                if distance < distances[at] {
                    (distances[at], owners[at]) = (distance, i as u32);
                }
            }
        }
    }
}

/// Middle of a texel.
pub fn texel(x: usize, y: usize) -> Vec2 {
    Vec2::new(x as f32 + 0.5, y as f32 + 0.5)
}

/// Barycentric weights of the point of a triangle that is nearest to `p`, and its squared distance.
pub fn nearest(&[a, b, c]: &[Vec2; 3], p: Vec2) -> (Vec3, f32) {
    let area = (b - a).perp_dot(c - a);
    if area != 0.0 {
        let weights = Vec3::new((b - p).perp_dot(c - p), (c - p).perp_dot(a - p), (a - p).perp_dot(b - p)) / area;
        if weights.min_element() >= 0.0 && weights.is_finite() {
            return (weights / weights.element_sum(), 0.0);
        }
    }
    let mut best = (Vec3::X, f32::INFINITY);
    for (i, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
        let along = to - from;
        let length = along.length_squared();
        let t = if length > 0.0 { ((p - from).dot(along) / length).clamp(0.0, 1.0) } else { 0.0 };
        let distance = (from + along * t).distance_squared(p);
        if distance < best.1 {
            let mut weights = Vec3::ZERO;
            weights[i] = 1.0 - t;
            weights[(i + 1) % 3] += t;
            best = (weights, distance);
        }
    }
    best
}

/// Samples along the longer side of the bounding box when overlaps are looked for, for each triangle's share of it.
const FINENESS: f32 = 6.0;
/// Most samples along a side.
const FINEST: f32 = 1024.0;

/// Number of samples that lie inside two triangles or more, and of those inside any. The samples are so dense
/// that a triangle of mean size holds some twenty.
pub fn count_overlaps(triangles: &[[Vec2; 3]]) -> (usize, usize) {
    let Some(around) = bounds(triangles.iter().flatten().copied()) else { return (0, 0) };
    let (low, size) = (around.min, around.max - around.min);
    let area: f32 = triangles.iter().map(|[a, b, c]| (b - a).perp_dot(c - a).abs() * 0.5).sum();
    let mean_side = (area / triangles.len() as f32).sqrt();
    let step = (mean_side / FINENESS).max(size.max_element() / FINEST);
    if !(step > 0.0) || !step.is_finite() {
        return (0, 0);
    }
    let (width, height) = ((size.x / step) as usize + 1, (size.y / step) as usize + 1);
    let mut counts = vec![0u8; width * height];
    for triangle in triangles {
        let [a, b, c] = triangle.map(|p| (p - low) / step);
        let area = (b - a).perp_dot(c - a);
        if area == 0.0 {
            continue;
        }
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        for y in (least.y as usize)..=(most.y as usize).min(height - 1) {
            for x in (least.x as usize)..=(most.x as usize).min(width - 1) {
                let p = texel(x, y);
                let edges = [(a, b), (b, c), (c, a)];
                // A hundredth of a step within the border: what merely touches does not overlap.
                let inside = |(from, to): (Vec2, Vec2)| {
                    let along = to - from;
                    along.perp_dot(p - from) * area.signum() > 0.01 * along.length()
                };
                if edges.into_iter().all(inside) {
                    counts[y * width + x] = counts[y * width + x].saturating_add(1);
                }
            }
        }
    }
    (counts.iter().filter(|&&n| n > 1).count(), counts.iter().filter(|&&n| n > 0).count())
}

#[cfg(test)]
mod tests {
    use super::*;

    const SQUARE: [[Vec2; 3]; 2] = [
        [Vec2::new(2.0, 2.0), Vec2::new(10.0, 2.0), Vec2::new(10.0, 10.0)],
        [Vec2::new(2.0, 2.0), Vec2::new(10.0, 10.0), Vec2::new(2.0, 10.0)],
    ];

    #[test]
    fn texels_belong_to_the_triangle_they_lie_in_and_one_texel_around() {
        let coverage = Coverage::new(64, &SQUARE);
        let owner = |x: usize, y: usize| coverage.owners[y * 64 + x];
        assert_eq!([owner(8, 3), owner(3, 8)], [0, 1]);
        assert_eq!([owner(1, 5), owner(10, 5), owner(0, 5), owner(11, 5)], [1, 0, NOBODY, NOBODY]);
        assert_eq!(coverage.owners.iter().filter(|&&o| o != NOBODY).count(), 100);
    }

    #[test]
    fn slivers_between_texels_are_seen() {
        let sliver = [Vec2::new(3.9, 1.0), Vec2::new(4.1, 1.0), Vec2::new(4.0, 30.0)];
        let coverage = Coverage::new(64, &[sliver]);
        assert!((2..29).all(|y| coverage.owners[y * 64 + 3] == 0 && coverage.owners[y * 64 + 4] == 0));
    }

    #[test]
    fn the_nearest_point_has_weights_that_sum_to_one() {
        for p in [Vec2::new(8.0, 4.0), Vec2::new(-5.0, 1.0), Vec2::new(20.0, 20.0), Vec2::new(6.0, 0.0)] {
            let (weights, distance) = nearest(&SQUARE[0], p);
            let [a, b, c] = SQUARE[0];
            let at = a * weights.x + b * weights.y + c * weights.z;
            assert!((weights.element_sum() - 1.0).abs() < 1e-6 && (at.distance_squared(p) - distance).abs() < 1e-3);
        }
    }

    #[test]
    fn overlaps_are_told_from_touching() {
        assert_eq!(count_overlaps(&SQUARE).0, 0);
        let twice = [SQUARE[0], SQUARE[1], SQUARE[0].map(|p| p + 1.0)];
        assert!(count_overlaps(&twice).0 > 10);
    }
}
