//! A triangle while it is being cleaned.

use bevy_math::{DVec3, Vec3};

/// The index of no vertex or half-edge.
pub(super) const NONE: u32 = u32::MAX;

/// One triangle on its way through the stages.
#[derive(Clone, Debug)]
pub(super) struct Face {
    /// Welded vertices.
    pub vertices: [u32; 3],
    /// Surface corners, see [`CleanSurface::corners`].
    pub corners: [u32; 3],
    /// Weights in the source triangle.
    pub weights: [Vec3; 3],
    pub source: u32,
    pub flipped: bool,
}

impl Face {
    /// Reverses the winding; half-edges 0 and 2 change places.
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

pub(super) fn has_repeats([a, b, c]: [u32; 3]) -> bool {
    a == b || b == c || c == a
}
