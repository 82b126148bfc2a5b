//! The result of cleaning.

use bevy_math::Vec3;

use crate::surface::{prop_surface::SurfaceSite, warning::BuildWarning};

/// A surface made an oriented manifold: every edge has one face, or two that run along it in opposite
/// directions, and the faces of every vertex form one fan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CleanSurface {
    /// Vertex positions: the surface's own, welded, in the order of their first use by index; duplicates made
    /// by splitting come last. Every vertex is used.
    pub positions: Vec<Vec3>,
    /// Vertex indices of each triangle.
    pub triangles: Vec<[u32; 3]>,
    /// For each corner of each triangle, the corner `3 * t + k` of the surface whose attributes it has. All
    /// three belong to the triangle's [`source`](Self::source), except at a vertex that ended a T-junction:
    /// there it is the corner of the dissolved triangle that had filled the junction.
    pub corners: Vec<[u32; 3]>,
    /// Where each corner of each triangle lies on the surface, always on its [`source`](Self::source). The
    /// weights are a unit vector except at a vertex that ended a T-junction.
    pub sites: Vec<[SurfaceSite; 3]>,
    /// The surface's triangle that each triangle is, or is a part of.
    pub source: Vec<u32>,
    /// Whether the triangle's winding is opposite to its source's.
    pub flipped: Vec<bool>,
    /// What was put right.
    pub warnings: Vec<BuildWarning>,
}
