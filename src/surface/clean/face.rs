//! A triangle while it is being cleaned.

use bevy_math::{DVec3, Vec3};

/// Index of no vertex or half-edge.
pub(super) const NONE: u32 = u32::MAX;

/// Triangle of the surface, or a part of one, as the stages of cleaning pass it on.
#[derive(Clone, Debug)]
pub(super) struct Face {
    /// Indices of the welded vertices.
    pub vertices: [u32; 3],
    /// Surface corners of the face: see `CleanSurface::corners`.
    pub corners: [u32; 3],
    /// Barycentric weights of each corner in the source triangle.
    pub weights: [Vec3; 3],
    pub source: u32,
    pub flipped: bool,
}

impl Face {
    /// Reverses the winding. Half-edges 0 and 2 change places.
    pub fn turn(&mut self) {
        self.vertices.swap(1, 2);
        self.corners.swap(1, 2);
        self.weights.swap(1, 2);
        self.flipped = !self.flipped;
    }

    pub fn points(&self, positions: &[Vec3]) -> [DVec3; 3] {
        self.vertices.map(|v| positions[v as usize].as_dvec3())
    }
}

/// Returns whether two of the three vertices are the same.
pub(super) fn has_repeats([a, b, c]: [u32; 3]) -> bool {
    a == b || b == c || c == a
}
