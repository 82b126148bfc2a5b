//! Bodies made for the gallery: a vase, turned on a lathe, and a toothed wheel with a hub.

use std::f32::consts::TAU;

use bevy_coating::surface::Surface;
use bevy_math::{Vec2, Vec3, ops};

/// Triangles around a body, counter-clockwise seen from outside.
struct Solid {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
}

/// Cosine of the angle between two faces beyond which their edge is a crease.
const CREASE: f32 = 0.8;

impl Solid {
    /// Returns the body with a position for every corner and normals that are smooth but for creases.
    fn surface(&self) -> Surface {
        let corner = |v: u32| self.positions[v as usize];
        let normals: Vec<Vec3> =
            (self.triangles.iter()).map(|&[a, b, c]| (corner(b) - corner(a)).cross(corner(c) - corner(a))).collect();
        let mut around = vec![Vec::new(); self.positions.len()];
        for (face, triangle) in self.triangles.iter().enumerate() {
            triangle.iter().for_each(|&v| around[v as usize].push(face));
        }
        let smooth = |face: usize, v: u32| {
            let own = normals[face].normalize_or_zero();
            let near = around[v as usize].iter().map(|&other| normals[other]);
            near.filter(|normal| normal.normalize_or_zero().dot(own) > CREASE).sum::<Vec3>().normalize_or_zero()
        };
        let corners = || self.triangles.iter().enumerate().flat_map(|(face, t)| t.map(|v| (face, v)));
        Surface {
            positions: corners().map(|(_, v)| corner(v)).collect(),
            normals: corners().map(|(face, v)| smooth(face, v)).collect(),
            triangles: (0..self.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
            ..Surface::default()
        }
    }
}

/// Radius and height of points along the vase's outline: from the middle of its foot, over stem, belly, neck and lip,
/// to the middle of the dish on top. Its bends are gentle but for the foot.
const VASE: [[f32; 2]; 23] = [
    [0.0, 0.0],
    [0.12, 0.0],
    [0.18, 0.0],
    [0.203, 0.015],
    [0.2, 0.045],
    [0.165, 0.075],
    [0.135, 0.1],
    [0.127, 0.15],
    [0.145, 0.21],
    [0.185, 0.27],
    [0.235, 0.34],
    [0.275, 0.42],
    [0.295, 0.5],
    [0.29, 0.58],
    [0.26, 0.66],
    [0.215, 0.73],
    [0.17, 0.79],
    [0.15, 0.85],
    [0.16, 0.9],
    [0.185, 0.95],
    [0.175, 0.967],
    [0.12, 0.95],
    [0.0, 0.935],
];
/// Ribs around the lower part, where it bends steeply to both sides: height at which they begin, from rib to rib, their
/// number, and how far they stand out.
const RIBS: (f32, f32, f32, f32) = (0.10, 0.11, 3.0, 0.022);

/// Makes the vase: one metre high, standing on the origin.
pub fn vase() -> Surface {
    const BETWEEN: usize = 8;
    let point = |i: usize| Vec2::from(VASE[i.min(VASE.len() - 1)]);
    let mut outline = Vec::new();
    for i in 0..VASE.len() - 1 {
        let [a, b, c, d] = [point(i.saturating_sub(1)), point(i), point(i + 1), point(i + 2)];
        for k in 0..BETWEEN {
            let t = k as f32 / BETWEEN as f32;
            // Catmull and Rom's spline.
            let bend = 2.0 * a - 5.0 * b + 4.0 * c - d + (3.0 * b - a - 3.0 * c + d) * t;
            let place = b + 0.5 * t * (c - a + t * bend);
            outline.push(Vec2::new((place.x + rib(place.y)).max(0.0), place.y));
        }
    }
    outline.push(point(VASE.len() - 1));
    turn(&outline, 120)
}

/// Returns how far the ribs stand out at a height; below 0 between them.
fn rib(height: f32) -> f32 {
    let (begin, wave, count, depth) = RIBS;
    let at = (height - begin) / wave;
    // They rise from nothing and end in it.
    let share = if (0.0..=count).contains(&at) { 1.0 - ops::cos(TAU * at / count) } else { 0.0 };
    -share.min(1.0) * depth * ops::cos(TAU * at)
}

/// Turns an outline, which begins and ends on the axis, around the y axis.
fn turn(outline: &[Vec2], sectors: u32) -> Surface {
    let [first, rings @ .., last] = outline else { return Surface::default() };
    let mut solid = Solid { positions: Vec::new(), triangles: Vec::new() };
    for ring in rings {
        solid.positions.extend((0..sectors).map(|sector| {
            let (sin, cos) = ops::sin_cos(sector as f32 / sectors as f32 * TAU);
            Vec3::new(ring.x * cos, ring.y, ring.x * sin)
        }));
    }
    let poles = [first, last].map(|pole| {
        solid.positions.push(Vec3::Y * pole.y);
        solid.positions.len() as u32 - 1
    });
    let at = |ring: u32, sector: u32| ring * sectors + sector % sectors;
    let upper = rings.len() as u32 - 1;
    for sector in 0..sectors {
        solid.triangles.push([poles[0], at(0, sector), at(0, sector + 1)]);
        solid.triangles.push([poles[1], at(upper, sector + 1), at(upper, sector)]);
        for ring in 0..upper {
            let [a, b] = [at(ring, sector), at(ring, sector + 1)];
            let [c, d] = [at(ring + 1, sector), at(ring + 1, sector + 1)];
            solid.triangles.extend([[a, c, d], [a, d, b]]);
        }
    }
    solid.surface()
}

/// Number of the wheel's teeth.
const TEETH: u32 = 18;

/// Makes the wheel: a rim with teeth, a web, and a hub with a bore, about one metre across, facing +z.
pub fn wheel() -> Surface {
    // Corners of half a section, from the bore outwards: radius, and half the thickness there.
    let flat = [[0.10, 0.125], [0.185, 0.125], [0.195, 0.05], [0.335, 0.045], [0.345, 0.085], [0.425, 0.085]];
    let sides: Vec<[f32; 2]> = flat.into_iter().chain(flat.into_iter().rev().map(|[r, z]| [r, -z])).collect();
    let sectors = 8 * TEETH;
    let mut solid = Solid { positions: Vec::new(), triangles: Vec::new() };
    for sector in 0..sectors {
        let (sin, cos) = ops::sin_cos(sector as f32 / sectors as f32 * TAU);
        for &[radius, z] in &sides {
            let radius = if radius > 0.4 { radius + tooth(sector % 8) } else { radius };
            solid.positions.push(Vec3::new(radius * cos, radius * sin, z));
        }
    }
    let across = sides.len() as u32;
    for sector in 0..sectors {
        for side in 0..across {
            let at = |sector: u32, side: u32| sector % sectors * across + side % across;
            let [a, b] = [at(sector, side), at(sector, side + 1)];
            let [c, d] = [at(sector + 1, side), at(sector + 1, side + 1)];
            solid.triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    solid.surface()
}

/// Returns how far the rim stands out at the eighth `part` of a tooth's share of it.
fn tooth(part: u32) -> f32 {
    [0.0, 0.0, 0.0, 0.03, 0.07, 0.07, 0.07, 0.03][part as usize % 8]
}
