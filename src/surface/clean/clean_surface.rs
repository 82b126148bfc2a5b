//! The result of cleaning.

use bevy_math::Vec3;

use crate::surface::{prop_surface::SurfaceSite, warning::BuildWarning};

/// Surface that is an oriented manifold: every edge has one face, or two that run along it in opposite directions, and
/// the faces of every vertex form one fan. Made by [`clean`](crate::surface::clean).
///
/// All lists but `positions` and `warnings` hold one entry for each triangle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CleanSurface {
    /// Positions of the vertices: those of the surface after welding, in the order of their indices there. Duplicates
    /// made by splitting come last. Every vertex is used by a triangle.
    pub positions: Vec<Vec3>,
    /// Vertex indices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Surface corners whose attributes the triangle's corners have: `3 * t + k` for corner `k` of the surface's
    /// triangle `t`. All three belong to the triangle's [`source`](Self::source). The exception is a corner at a former
    /// T-junction, which has the corner of the dissolved triangle that filled the junction.
    pub corners: Vec<[u32; 3]>,
    /// Points of the surface at which the triangle's corners lie, always on its [`source`](Self::source). A corner of
    /// the source has weight 1 for that corner; only a corner at a former T-junction lies between two of them.
    pub sites: Vec<[SurfaceSite; 3]>,
    /// Triangle of the surface that the triangle is, or is a part of.
    pub source: Vec<u32>,
    /// Whether the triangle has the opposite winding of its source.
    pub flipped: Vec<bool>,
    /// Repairs that were made.
    pub warnings: Vec<BuildWarning>,
}
