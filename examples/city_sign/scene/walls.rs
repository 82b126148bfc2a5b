//! One broken wall: a slab whose outline is where a field of distances (to the ragged top, to windows, to
//! holes) changes sign, traced by marching squares.

use super::builder::{Corner, MeshBuilder};
use bevy::prelude::*;
use noise::{Fbm, NoiseFn, Perlin};

/// Unbroken masonry is drawn in squares of this many cells.
const BLOCK: i32 = 4;

pub struct Wall {
    pub length: f32,
    pub height: f32,
    pub thickness: f32,
    /// Openings, in the wall's own plane.
    pub windows: Vec<Rect>,
    /// How much has come down: 0 stands, 1 is half gone.
    pub ruin: f32,
    /// Size of the tracing grid, metres.
    pub cell: f32,
    /// Texture repeats per metre.
    pub uv_scale: f32,
    pub tint: Vec3,
    pub noise: Fbm<Perlin>,
    /// Whether its back can be seen.
    pub two_sided: bool,
    /// Where in the noise this wall lies.
    pub offset: f32,
    /// Start and direction in the building's plan: walls that meet in a corner have broken to the same height
    /// there.
    pub plan: (Vec2, Vec2),
    /// Where in the noise the building lies.
    pub site: f32,
    /// For a floor: points of its edge where the wall it rests on still stands. Without walls nothing carries
    /// it beyond a short cantilever.
    pub bearings: Vec<Vec2>,
}

impl Wall {
    fn field(&self, x: f32, y: f32, z: f32) -> f32 {
        self.noise.get([f64::from(x), f64::from(y), f64::from(z + self.offset)]) as f32
    }

    /// Positive inside the masonry: about the distance to the nearest edge.
    pub fn solid(&self, at: Vec2) -> f32 {
        let spot = (self.plan.0 + self.plan.1 * at.x) * 0.09;
        let height = self.noise.get([f64::from(spot.x), f64::from(spot.y), f64::from(self.site)]) as f32;
        let lost = self.ruin * (0.42 + 1.5 * height);
        let ragged = 0.55 * self.field(at.x * 0.8, at.y * 0.8, 7.0);
        let top = self.height * (1.0 - lost.clamp(0.0, 0.85)) - at.y + ragged;
        let ends = at.x.min(self.length - at.x);
        let holes = 2.6 * (0.62 - 0.25 * self.ruin - self.field(at.x * 0.22, at.y * 0.22, 21.0));
        // Frames have been torn out unevenly.
        let torn = 0.05 * self.field(at.x * 2.5, at.y * 2.5, 33.0);
        let windows = self.windows.iter().map(|w| {
            let outside = (w.min - at).max(at - w.max);
            outside.max_element() + torn
        });
        let carried = if self.bearings.is_empty() {
            f32::MAX
        } else {
            let nearest = self.bearings.iter().map(|b| b.distance_squared(at)).fold(f32::MAX, f32::min).sqrt();
            2.3 - nearest + 2.2 * ragged
        };
        windows.fold(top.min(ends).min(holes).min(carried), f32::min)
    }

    /// Soot over the windows, damp at the foot, dust.
    fn shade(&self, at: Vec2) -> Vec3 {
        let soot = self.windows.iter().map(|w| {
            let above = at.y - w.max.y + 0.2;
            let beside = (w.min.x - at.x).max(at.x - w.max.x).max(0.0);
            if above < -0.6 { 0.0 } else { (-above.max(0.0) / 0.9 - beside / 0.25).exp() }
        });
        let soot = soot.fold(0.0, f32::max) * (0.55 + 0.9 * self.field(at.x * 0.4, at.y * 0.15, 50.0)).clamp(0.0, 0.9);
        let damp = 0.45 * (-at.y.max(0.0) / 0.5).exp();
        let patches = 1.0 + 0.25 * self.field(at.x * 0.3, at.y * 0.3, 60.0);
        self.tint * (1.0 - soot) * (1.0 - damp) * patches
    }

    /// Adds the wall to `faces`, and to `edges` what is seen of its inside where it broke. In `place` the wall
    /// runs along x, stands along y, and faces z.
    pub fn build(&self, place: &Transform, faces: &mut MeshBuilder, edges: &mut MeshBuilder) {
        let columns = (self.length / self.cell).ceil() as i32 + 1;
        let rows = (self.height / self.cell).ceil() as i32 + 3;
        let at = |i: i32, j: i32| Vec2::new(i as f32 - 0.5, j as f32 - 1.0) * self.cell;
        let stride = columns as usize + 1;
        let grid: Vec<Vec2> = (0..=rows).flat_map(|j| (0..=columns).map(move |i| at(i, j))).collect();
        let mut values: Vec<f32> = grid.iter().map(|at| self.solid(*at)).collect();
        self.drop_islands(&mut values, &grid, stride);
        let value = |i: i32, j: i32| values[j as usize * stride + i as usize];
        let corners = |i: i32, j: i32, span: i32| [(i, j), (i + span, j), (i + span, j + span), (i, j + span)];
        let whole = |i: i32, j: i32| {
            i + BLOCK <= columns
                && j + BLOCK <= rows
                && (0..=BLOCK).all(|dj| (0..=BLOCK).all(|di| value(i + di, j + dj) > 0.0))
        };
        for j in (0..rows).step_by(BLOCK as usize) {
            for i in (0..columns).step_by(BLOCK as usize) {
                if whole(i, j) {
                    let square = corners(i, j, BLOCK).map(|(i, j)| at(i, j));
                    self.square(square, [1.0; 4], place, faces, edges);
                    continue;
                }
                for j in j..(j + BLOCK).min(rows) {
                    for i in i..(i + BLOCK).min(columns) {
                        let square = corners(i, j, 1).map(|(i, j)| at(i, j));
                        self.square(square, corners(i, j, 1).map(|(i, j)| value(i, j)), place, faces, edges);
                    }
                }
            }
        }
    }

    /// Masonry that hangs on to nothing has fallen: what is not connected to the ground, or a floor to the walls
    /// it rests on.
    fn drop_islands(&self, values: &mut [f32], grid: &[Vec2], stride: usize) {
        let rests = |at: Vec2| {
            if self.bearings.is_empty() {
                at.y <= 0.0
            } else {
                self.bearings.iter().any(|bearing| bearing.distance_squared(at) < 0.36)
            }
        };
        let mut held: Vec<bool> = values.iter().zip(grid).map(|(value, at)| *value > 0.0 && rests(*at)).collect();
        let mut open: Vec<usize> = (0..held.len()).filter(|&i| held[i]).collect();
        while let Some(i) = open.pop() {
            // Rows begin and end outside the wall, so stepping over a row's end meets nothing solid.
            let neighbours = [i.wrapping_sub(1), i + 1, i.wrapping_sub(stride), i + stride];
            for n in neighbours {
                if values.get(n).is_some_and(|value| *value > 0.0) && !held[n] {
                    held[n] = true;
                    open.push(n);
                }
            }
        }
        for (value, held) in values.iter_mut().zip(held) {
            if *value > 0.0 && !held {
                *value = -0.05;
            }
        }
    }

    fn square(
        &self,
        corners: [Vec2; 4],
        values: [f32; 4],
        place: &Transform,
        faces: &mut MeshBuilder,
        edges: &mut MeshBuilder,
    ) {
        if values.iter().all(|v| *v <= 0.0) {
            return;
        }
        let half = self.thickness / 2.0;
        let mut outline: Vec<Vec2> = Vec::with_capacity(8);
        let mut left: Option<Vec2> = None;
        let mut cuts: Vec<(Vec2, Vec2)> = Vec::new();
        let mut entered: Option<Vec2> = None;
        for k in 0..4 {
            let next = (k + 1) % 4;
            if values[k] > 0.0 {
                outline.push(corners[k]);
            }
            if (values[k] > 0.0) != (values[next] > 0.0) {
                let cross = corners[k].lerp(corners[next], values[k] / (values[k] - values[next]));
                outline.push(cross);
                if values[k] > 0.0 {
                    left = Some(cross);
                } else if let Some(from) = left.take() {
                    cuts.push((from, cross));
                } else {
                    // The outline began inside a gap: its other end comes last.
                    entered = Some(cross);
                }
            }
        }
        if let (Some(from), Some(to)) = (left, entered) {
            cuts.push((from, to));
        }
        let corner = |p: Vec2, z: f32, shade: f32| {
            let position = place.transform_point(p.extend(z));
            Corner::new(position, Vec2::new(p.x, -p.y) * self.uv_scale, self.shade(p) * shade)
        };
        let front: Vec<Corner> = outline.iter().map(|p| corner(*p, half, 1.0)).collect();
        faces.polygon(&front);
        if self.two_sided {
            let back: Vec<Corner> = outline.iter().rev().map(|p| corner(*p, -half, 0.8)).collect();
            faces.polygon(&back);
        }
        for (from, to) in cuts {
            let side = |p: Vec2, z: f32| {
                let along = p.x + p.y;
                Corner::new(place.transform_point(p.extend(z)), Vec2::new(along, z) * 0.5, self.shade(p) * 0.9)
            };
            edges.polygon(&[side(to, half), side(from, half), side(from, -half), side(to, -half)]);
        }
    }
}
