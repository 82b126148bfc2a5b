//! Noise that repeats, for the textures of walls and ground. The `noise` crate's fields do not repeat; a
//! texture's must, or every tile shows its border.

use bevy::math::{IVec2, Vec2};

/// A well-mixed hash of a lattice point.
fn hash(cell: IVec2, seed: u32) -> u32 {
    let mut h = seed ^ (cell.x as u32).wrapping_mul(0x9E37_79B1) ^ (cell.y as u32).wrapping_mul(0x85EB_CA77);
    h = (h ^ (h >> 15)).wrapping_mul(0x2C1B_3C6D);
    h = (h ^ (h >> 12)).wrapping_mul(0x297A_2D39);
    h ^ (h >> 15)
}

/// `hash` as a number in 0..1.
fn unit(cell: IVec2, seed: u32) -> f32 {
    (hash(cell, seed) >> 8) as f32 / (1 << 24) as f32
}

/// A vector in the square -1..1 for the lattice point: as good as one on the circle, without its sine.
fn slope(at: IVec2, period: i32, seed: u32) -> Vec2 {
    let h = hash(at.rem_euclid(IVec2::splat(period)), seed);
    Vec2::new((h & 0xFFFF) as f32, (h >> 16) as f32) / 32_767.5 - 1.0
}

/// A number in 0..1 for the cell, repeating every `period` cells.
pub fn cell(at: IVec2, period: i32, seed: u32) -> f32 {
    unit(at.rem_euclid(IVec2::splat(period)), seed)
}

/// Gradient noise in about -1..1 with `period` cells over the unit square.
pub fn gradient(at: Vec2, period: i32, seed: u32) -> f32 {
    let p = at * period as f32;
    let base = p.floor().as_ivec2();
    let f = p - base.as_vec2();
    let s = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let corner = |dx: i32, dy: i32| {
        let offset = IVec2::new(dx, dy);
        slope(base + offset, period, seed).dot(f - offset.as_vec2())
    };
    let lower = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * s.x;
    let upper = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * s.x;
    (lower + (upper - lower) * s.y) * 1.5
}

/// Octaves of [`gradient`], each at twice the frequency and half the height; about -1..1.
pub fn fractal(at: Vec2, period: i32, octaves: u32, seed: u32) -> f32 {
    let (mut sum, mut height, mut total) = (0.0, 1.0, 0.0);
    for octave in 0..octaves {
        sum += gradient(at, period << octave, seed.wrapping_add(octave * 101)) * height;
        total += height;
        height *= 0.5;
    }
    sum / total * 1.4
}

/// How far the point lies from the nearest border between the cells of a jittered grid, in cells: the
/// pattern of dried mud and of crazed asphalt.
pub fn crack_distance(at: Vec2, period: i32, seed: u32) -> f32 {
    let p = at * period as f32;
    let base = p.floor().as_ivec2();
    let site = |offset: IVec2| {
        let c = base + offset;
        let jitter = Vec2::new(cell(c, period, seed), cell(c, period, seed ^ 0x5bd1));
        c.as_vec2() + jitter - p
    };
    let offsets = |reach: i32| (-reach..=reach).flat_map(move |y| (-reach..=reach).map(move |x| IVec2::new(x, y)));
    let nearest = offsets(1).map(site).min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    let nearest = nearest.unwrap_or_default();
    offsets(2)
        .map(site)
        .filter(|other| other.distance_squared(nearest) > 1e-6)
        .map(|other| ((nearest + other) * 0.5).dot((other - nearest).normalize()))
        .fold(f32::MAX, f32::min)
}
