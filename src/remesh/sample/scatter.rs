//! Blue noise in an outline, and its Delaunay triangulation.
//!
//! A triangulation of `n` points, `b` of them on a convex border, has `2n - 2 - b` triangles (Euler). The number of
//! border points is chosen to fit the edge length that the number of triangles implies, and to be even or odd like that
//! number. The number of inner points follows.

use bevy_math::DVec2;
use delaunator::Point;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::outline::Outline;
use crate::surface::BuildError;

/// Highest number of triangles of a piece.
const MAX_TRIANGLES: u32 = 10_000_000;

/// Number of rounds of relaxation: enough for even edges (coefficient of variation near 0.135), and so few that half of
/// the points still have more or fewer than six neighbours. Many more rounds would let the points form lattices.
const RELAXATIONS: usize = 12;

/// Returns points and counter-clockwise triangles, exactly as many as asked for.
pub(super) fn triangulate(
    outline: Outline,
    triangles: u32,
    seed: u64,
) -> Result<(Vec<DVec2>, Vec<[u32; 3]>), BuildError> {
    let count = triangles as usize;
    let (min, range) = match outline {
        Outline::Square => (2, "2 to 10000000 triangles"),
        Outline::Disk => (6, "6 to 10000000 triangles"),
    };
    if triangles < min || triangles > MAX_TRIANGLES {
        return Err(BuildError::Resolution { found: format!("{triangles} triangles"), range });
    }
    // The edge of an equilateral triangle of the mean area.
    let edge = (outline.area() / count as f64 * 4.0 / 3.0_f64.sqrt()).sqrt();
    let wanted = (outline.perimeter() / edge).round() as usize;
    let border =
        (wanted + (wanted + count) % 2).clamp(outline.min_border() + (outline.min_border() + count) % 2, count + 2);
    let inner = (count + 2 - border) / 2;

    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut points = outline.border(border, &mut rng);
    throw_darts(outline, inner, edge, &mut points, &mut rng);
    for _ in 0..RELAXATIONS {
        relax(&mut points, border);
    }
    let triangles = delaunay(&points);
    debug_assert_eq!(triangles.len(), count);
    Ok((points, triangles))
}

/// Adds `count` random points that keep a distance from each other and from the border. The distance shrinks a little
/// with each point that is refused, so the number is always reached and the spacing stays even.
fn throw_darts(outline: Outline, count: usize, edge: f64, points: &mut Vec<DVec2>, rng: &mut ChaCha8Rng) {
    let mut distance = 0.85 * edge;
    let shrink = 1.0 - 0.1 / count.max(1) as f64;
    let half = outline.extent() / 2.0;
    let mut grid = Grid::new(half, edge);
    for (i, p) in points.iter().enumerate() {
        grid.insert(*p, i);
    }
    let goal = points.len() + count;
    while points.len() < goal {
        let p = DVec2::new(rng.random_range(-half..half), rng.random_range(-half..half));
        if outline.depth(p) > 0.6 * distance && grid.is_free(p, distance, points) {
            grid.insert(p, points.len());
            points.push(p);
        } else {
            distance *= shrink;
        }
    }
}

/// Moves each inner point to the centroid of the triangles around it (Chen 2004, "Mesh smoothing schemes based
/// on optimal Delaunay triangulations", centroidal patch triangulation).
fn relax(points: &mut [DVec2], border: usize) {
    let mut sums = vec![(DVec2::ZERO, 0.0); points.len()];
    for triangle in delaunay(points) {
        let [a, b, c] = triangle.map(|v| points[v as usize]);
        let area = (b - a).perp_dot(c - a);
        for v in triangle {
            let (moment, mass) = &mut sums[v as usize];
            *moment += area * (a + b + c) / 3.0;
            *mass += area;
        }
    }
    for (p, (moment, mass)) in points.iter_mut().zip(sums).skip(border) {
        if mass > 0.0 {
            *p = moment / mass;
        }
    }
}

fn delaunay(points: &[DVec2]) -> Vec<[u32; 3]> {
    let points: Vec<_> = points.iter().map(|p| Point { x: p.x, y: p.y }).collect();
    let corners = delaunator::triangulate(&points).triangles;
    // Delaunator's counter-clockwise is for a y axis that points down.
    corners.as_chunks::<3>().0.iter().map(|&[a, b, c]| [a as u32, c as u32, b as u32]).collect()
}

/// Grid of square cells, one ideal edge wide, that finds the points near a point.
struct Grid {
    half: f64,
    cell: f64,
    side: usize,
    head: Vec<u32>,
    next: Vec<u32>,
}

const NONE: u32 = u32::MAX;

impl Grid {
    fn new(half: f64, cell: f64) -> Self {
        let side = (2.0 * half / cell) as usize + 1;
        Self { half, cell, side, head: vec![NONE; side * side], next: Vec::new() }
    }

    fn column(&self, x: f64) -> usize {
        (((x + self.half) / self.cell) as usize).min(self.side - 1)
    }

    /// Adds a point. Points must be added in the order of their indices.
    fn insert(&mut self, p: DVec2, index: usize) {
        let cell = self.column(p.y) * self.side + self.column(p.x);
        self.next.push(std::mem::replace(&mut self.head[cell], index as u32));
    }

    /// Returns whether no point is nearer than `distance`, which must be at most one cell.
    fn is_free(&self, p: DVec2, distance: f64, points: &[DVec2]) -> bool {
        let around = |x: f64| self.column(x - self.cell)..=self.column(x + self.cell);
        around(p.y).all(|row| {
            around(p.x).all(|column| {
                let mut i = self.head[row * self.side + column];
                while i != NONE {
                    if points[i as usize].distance_squared(p) < distance * distance {
                        return false;
                    }
                    i = self.next[i as usize];
                }
                true
            })
        })
    }
}
