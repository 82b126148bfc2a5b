//! Loose pieces keep their place: without inertia, what a solve adds to a free piece as a whole is an
//! artefact of the order of constraints, and would propel and spin it.

use bevy_math::{Mat3, Vec3};

use super::{
    half_space::above_plane,
    packed::points::{Motion, Points},
};
use crate::film::{Geometry, LoosePiece, LoosePieces, rotation::Rotation};

/// Notes in `before` where the vertices of the loose pieces are before a solve. Pieces that sleep are passed over.
pub fn remember(positions: &[Vec3], loose: &LoosePieces, points: &Points, before: &mut Vec<Vec3>) {
    before.clear();
    let pieces = loose.iter().filter(|piece| is_awake(piece, points));
    before.extend(pieces.flat_map(|piece| piece.vertices).map(|v| positions[v.index()]));
}

/// Takes each loose piece's net translation and rotation since [`remember`] out again, and out of its momentum.
pub fn put_back(geometry: &mut Geometry, loose: &LoosePieces, points: &mut Points, before: &[Vec3]) {
    let mut left = before;
    for piece in loose.iter() {
        if !is_awake(&piece, points) {
            continue;
        }
        let Some((before, rest)) = left.split_at_checked(piece.vertices.len()) else { return };
        left = rest;
        let positions = &geometry.positions;
        let now = || piece.vertices.iter().map(|v| positions[v.index()]);
        let count = before.len() as f32;
        let centre_before = before.iter().sum::<Vec3>() / count;
        let centre_now = now().sum::<Vec3>() / count;
        let turn = net_rotation(before.iter().map(|p| p - centre_before), now().map(|p| p - centre_now));
        let back = |p: Vec3| centre_before + turn.apply(p - centre_now);
        for &v in piece.vertices {
            if points.motion(v.index()) == Motion::Asleep {
                continue;
            }
            let i = v.index();
            let p = above_plane(back(geometry.positions[i]), geometry.rest_positions[i], geometry.rest_normals[i]);
            geometry.positions[i] = p;
            points.put(i, p, back(points.position_before(i)));
        }
    }
}

/// Returns whether any vertex of a piece moves.
fn is_awake(piece: &LoosePiece, points: &Points) -> bool {
    piece.vertices.iter().any(|&v| points.motion(v.index()) != Motion::Asleep)
}

/// Returns the rotation that takes the net turn from `before` to `now` (both about their centres) out again: the
/// angular velocity of the displacement, from angular momentum and inertia tensor of unit masses.
fn net_rotation(before: impl Iterator<Item = Vec3>, now: impl Iterator<Item = Vec3>) -> Rotation {
    let (mut momentum, mut inertia) = (Vec3::ZERO, Mat3::ZERO);
    for (a, b) in before.zip(now) {
        let middle = (a + b) * 0.5;
        momentum += middle.cross(b - a);
        let outer = Mat3::from_cols(middle * middle.x, middle * middle.y, middle * middle.z);
        inertia += Mat3::from_diagonal(Vec3::splat(middle.length_squared())) - outer;
    }
    // Points on a line leave a turn about it open: no rotation is taken out then.
    let trace = inertia.x_axis.x + inertia.y_axis.y + inertia.z_axis.z;
    // In units in which the trace is near 1 nothing below overflows or vanishes. A power of two changes no other bit.
    let unit = f32::from_bits(trace.to_bits() & 0x7f80_0000);
    if !(unit.is_normal() && unit.recip().is_normal()) {
        return Rotation::IDENTITY;
    }
    let (momentum, inertia, trace) = (momentum * unit.recip(), inertia * unit.recip(), trace * unit.recip());
    let Mat3 { x_axis: x, y_axis: y, z_axis: z } = inertia;
    let determinant = z.dot(x.cross(y));
    if !(determinant > 1e-9 * trace * trace * trace) {
        return Rotation::IDENTITY;
    }
    // The inverse by hand: releases of the maths library make it in different orders, so that last bits differ.
    let inverse = [y.cross(z), z.cross(x), x.cross(y)].map(|row| row * determinant.recip());
    let half_turn = Vec3::from_array(inverse.map(|row| row.dot(momentum))) * -0.5;
    // Cayley: exact for the half-way frame used above, and needs no trigonometry.
    Rotation::of([half_turn.x, half_turn.y, half_turn.z, 1.0])
}
