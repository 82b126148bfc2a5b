//! Welds vertices that are at (almost) the same position.

use std::collections::HashMap;

use bevy_math::{DVec3, Vec3};

use super::face::NONE;
use crate::{
    rest::{LIGHT_PIECE, Rest, pieces},
    surface::prop_surface::Surface,
};

/// Vertices closer than this part of the bounding box's diagonal are welded.
const TOLERANCE: f64 = 1e-5;
/// Vertices further apart than this part of the shortest edge at either of them are never welded.
const EDGE_FRACTION: f64 = 0.1;

/// Vertices of a surface after welding.
pub(super) struct Welded {
    /// Position of each welded vertex: that of its lowest surface vertex.
    pub positions: Vec<Vec3>,
    /// Welded vertex of each surface vertex; [`NONE`] where no triangle uses it.
    pub vertex_of: Vec<u32>,
    /// Largest distance at which vertices were welded, in the surface's unit.
    pub tolerance: f64,
}

pub(super) async fn weld(surface: &Surface, rest: &mut impl Rest) -> Welded {
    let first = merge_equal(surface, rest).await;
    let shortest = shortest_edges(surface, &first, rest).await;

    let firsts = || (0..first.len()).filter(|&v| first[v] == v as u32);
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for v in firsts() {
        let p = surface.positions[v].as_dvec3();
        (low, high) = (low.min(p), high.max(p));
    }
    let tolerance = TOLERANCE * (high - low).length();

    let mut grid = Grid::new(low, tolerance, surface.positions.len());
    let mut welded = Welded { positions: Vec::new(), vertex_of: vec![NONE; first.len()], tolerance };
    for range in pieces(first.len(), LIGHT_PIECE) {
        for v in range.filter(|&v| first[v] == v as u32) {
            let p = surface.positions[v].as_dvec3();
            let reach = |w: usize| tolerance.min(EDGE_FRACTION * shortest[v].min(shortest[w]));
            // The grid holds only vertices that were not welded to another, so chains of close vertices do not drift.
            let mut nearest: Option<(f64, usize)> = None;
            grid.for_near(p, |w| {
                let distance = surface.positions[w].as_dvec3().distance(p);
                if distance <= reach(w) && nearest.is_none_or(|best| (distance, w) < best) {
                    nearest = Some((distance, w));
                }
            });
            welded.vertex_of[v] = match nearest {
                Some((_, w)) => welded.vertex_of[w],
                None => {
                    grid.insert(p, v);
                    welded.positions.push(surface.positions[v]);
                    welded.positions.len() as u32 - 1
                }
            };
        }
        rest.rest().await;
    }
    for (v, &first) in first.iter().enumerate() {
        if first != NONE {
            welded.vertex_of[v] = welded.vertex_of[first as usize];
        }
    }
    welded
}

/// Returns the lowest used vertex at exactly the same position as each vertex; [`NONE`] for unused vertices.
async fn merge_equal(surface: &Surface, rest: &mut impl Rest) -> Vec<u32> {
    let mut first = vec![NONE; surface.positions.len()];
    for piece in surface.triangles.chunks(LIGHT_PIECE) {
        for &v in piece.iter().flatten() {
            first[v as usize] = v;
        }
        rest.rest().await;
    }
    // Only ever looked up, so its order cannot matter. In the order of the vertices the lowest one comes first.
    let mut at = HashMap::with_capacity(first.len());
    for piece in first.chunks_mut(LIGHT_PIECE) {
        for first in piece.iter_mut().filter(|first| **first != NONE) {
            // Adding zero turns -0 into 0, so that both have the same bits.
            let bits = (surface.positions[*first as usize] + Vec3::ZERO).to_array().map(f32::to_bits);
            *first = *at.entry(bits).or_insert(*first);
        }
        rest.rest().await;
    }
    first
}

/// Returns the length of the shortest edge at each vertex; edges of length 0 do not count.
async fn shortest_edges(surface: &Surface, first: &[u32], rest: &mut impl Rest) -> Vec<f64> {
    let mut shortest = vec![f64::INFINITY; first.len()];
    for piece in surface.triangles.chunks(LIGHT_PIECE) {
        for &[a, b, c] in piece {
            for (a, b) in [(a, b), (b, c), (c, a)] {
                let (a, b) = (first[a as usize] as usize, first[b as usize] as usize);
                if a != b {
                    let length = surface.positions[a].as_dvec3().distance(surface.positions[b].as_dvec3());
                    shortest[a] = shortest[a].min(length);
                    shortest[b] = shortest[b].min(length);
                }
            }
        }
        rest.rest().await;
    }
    shortest
}

/// Sparse grid of cells twice the tolerance wide. Every vertex within the tolerance of a point lies in one of the eight
/// cells around the cell corner nearest to the point.
struct Grid {
    low: DVec3,
    cell: f64,
    /// Last vertex of each cell. Only ever looked up, so its order cannot matter.
    head: HashMap<[i32; 3], u32>,
    /// The vertex before it in the same cell.
    next: Vec<u32>,
}

impl Grid {
    fn new(low: DVec3, tolerance: f64, vertices: usize) -> Self {
        // With all vertices at one place there is one cell, whatever its size.
        let cell = if tolerance > 0.0 { 2.0 * tolerance } else { 1.0 };
        Self { low, cell, head: HashMap::with_capacity(vertices), next: vec![NONE; vertices] }
    }

    fn insert(&mut self, p: DVec3, vertex: usize) {
        let cell = ((p - self.low) / self.cell).floor().as_ivec3().to_array();
        if let Some(before) = self.head.insert(cell, vertex as u32) {
            self.next[vertex] = before;
        }
    }

    fn for_near(&self, p: DVec3, mut visit: impl FnMut(usize)) {
        let corner = ((p - self.low) / self.cell).round().as_ivec3();
        for i in 0..8 {
            let cell = [corner.x - (i & 1), corner.y - (i >> 1 & 1), corner.z - (i >> 2 & 1)];
            let mut v = self.head.get(&cell).copied().unwrap_or(NONE);
            while v != NONE {
                visit(v as usize);
                v = self.next[v as usize];
            }
        }
    }
}
