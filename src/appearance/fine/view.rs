//! Holds what all parts of a fine surface look at.

use bevy_math::{Mat3A, Vec3, Vec3A};

use super::{base::Base, vertex_frames::VertexFrames};
use crate::appearance::face_slots::FaceSlots;
use crate::film::{FaceId, FilmMesh, HalfEdgeId, Topology, VertexId};

/// A film as it is now, and the surface that it had at rest.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub mesh: &'a FilmMesh,
    pub face_slots: &'a FaceSlots,
    pub base: &'a Base,
    /// Position at which each vertex is shown.
    pub positions: &'a [Vec3],
    pub frames: &'a VertexFrames,
}

/// The film at one of its vertices.
#[derive(Clone, Copy)]
pub(super) struct Pose<'a> {
    pub position: Vec3A,
    pub normal: Vec3A,
    /// Rotation since rest.
    pub rotation: &'a Mat3A,
    pub rest_normal: Vec3A,
    /// Whether the vertex is where it was at rest and has not turned.
    pub still: bool,
}

/// The direction in which the points along a straight edge are computed. It is the same for both faces at the edge, so
/// that they meet to the bit where a seam keeps them from sharing vertices.
#[derive(Clone, Copy)]
pub(super) struct Course {
    /// Vertices of the face at both ends.
    pub ends: [VertexId; 2],
    reversed: bool,
}

impl<'a> View<'a> {
    #[inline]
    pub fn topology(&self) -> &'a Topology {
        &self.mesh.topology
    }

    #[inline]
    pub fn pose(&self, v: VertexId) -> Pose<'a> {
        let (geometry, i) = (&self.mesh.geometry, v.index());
        Pose {
            position: self.positions[i].into(),
            normal: self.frames.normals[i],
            rotation: &self.frames.rotations[i],
            rest_normal: geometry.rest_normals[i].into(),
            still: self.frames.still[i],
        }
    }

    /// Returns the film at the corners of `f`.
    // Arrays are listed where speed counts: `map` is not always inlined.
    #[inline]
    pub fn poses(&self, f: FaceId) -> [Pose<'a>; 3] {
        let [a, b, c] = self.topology().corners(f);
        [self.pose(a), self.pose(b), self.pose(c)]
    }

    /// Returns the normals of the film at the corners of `f`.
    #[inline]
    pub fn normals(&self, f: FaceId) -> [Vec3A; 3] {
        let [a, b, c] = self.topology().corners(f);
        [self.normal(a), self.normal(b), self.normal(c)]
    }

    /// Returns the normal of the film at a vertex.
    #[inline]
    pub fn normal(&self, v: VertexId) -> Vec3A {
        self.frames.normals[v.index()]
    }

    /// Returns positions and normals at rest of the film at some vertices.
    #[inline]
    pub fn at_rest<const N: usize>(&self, vertices: [VertexId; N]) -> ([Vec3A; N], [Vec3A; N]) {
        let originals = vertices.map(|v| self.topology().original(v).index());
        let geometry = &self.mesh.geometry;
        (originals.map(|v| geometry.rest_positions[v].into()), originals.map(|v| geometry.rest_normals[v].into()))
    }

    /// Returns how deep the back of `f` lies behind its front against the normals of the film, for paint of this
    /// thickness.
    #[inline]
    pub fn depth(&self, f: FaceId, thickness: f32) -> f32 {
        if self.face_slots.is_flipped(f) { -thickness } else { thickness }
    }
}

impl Course {
    #[inline]
    pub fn of(view: &View, h: HalfEdgeId) -> Self {
        let reversed = view.base.is_reversed(h);
        let [a, b] = [view.topology().origin(h), view.topology().target(h)];
        Self { ends: if reversed { [b, a] } else { [a, b] }, reversed }
    }

    /// Returns which of `values`, which are in this direction, belongs to the point `i` of the half-edge.
    #[inline]
    pub fn pick<'v, T>(&self, values: &'v [T], i: usize) -> &'v T {
        &values[if self.reversed { values.len() - 1 - i } else { i }]
    }
}

/// Returns the sum of three vectors with the weights `b`.
#[inline]
pub(super) fn mix([p, q, r]: [Vec3A; 3], b: Vec3) -> Vec3A {
    p * b.x + q * b.y + r * b.z
}

/// Returns `v` scaled to unit length, or `or` if it has none.
#[inline]
pub(super) fn unit(v: Vec3A, or: Vec3A) -> Vec3A {
    // See `turn::unit` for the square root.
    let length = v.length_squared().sqrt();
    if length > 0.0 { v * (1.0 / length) } else { or }
}
