//! Length constraint: an edge keeps its rest length (VC 4.2).

use bevy_math::Vec3;

use crate::film::HalfEdgeId;

/// Keeps two vertices at the rest length of their edge. A bound edge has one, carried by its lower
/// half-edge; a torn edge has one for each half-edge whose face is live.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthConstraint {
    /// The half-edge that carries the constraint.
    pub half_edge: HalfEdgeId,
    /// The two vertices.
    pub ends: [u32; 2],
    /// Rest length d0.
    pub rest: f32,
}

/// Corrections of the two ends for inverse masses `w`: VC 4.2, as printed. `None` where both are fixed or the
/// ends coincide, so that no direction is left.
#[inline]
pub fn length_corrections(p: [Vec3; 2], w: [f32; 2], rest: f32) -> Option<[Vec3; 2]> {
    let mass = w[0] + w[1];
    let difference = p[0] - p[1];
    let length = length(difference);
    if !(mass > 0.0 && length > 0.0) {
        return None;
    }
    let correction = difference * ((length - rest) / (mass * length));
    Some([-w[0] * correction, w[1] * correction])
}

/// Length of `v`. The vector type's own length calls a library where it is built for the same bits on every
/// platform; a square root is exact everywhere, and here it must be one instruction.
#[inline]
pub(super) fn length(v: Vec3) -> f32 {
    v.length_squared().sqrt()
}
