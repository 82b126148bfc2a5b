//! The prop's own surface as plain arrays, and a point on it.

use bevy_math::{Vec2, Vec3, Vec4};

/// The prop's own surface: the triangles of one connected prop (all primitives of one glTF node), in the
/// prop's space with its world scale applied. Corner attributes hold three entries a triangle, in the order
/// of the triangle's corners; an attribute that the prop does not have is empty.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Vertex positions; unused and repeated ones are fine.
    pub positions: Vec<Vec3>,
    /// Vertex indices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Slot (primitive, material) of each triangle; empty: all are slot 0.
    pub slots: Vec<u32>,
    /// Shading normals, three a triangle; empty: none.
    pub normals: Vec<Vec3>,
    /// First texture coordinates, three a triangle; empty: none.
    pub uvs: Vec<Vec2>,
    /// Second texture coordinates (lightmaps), three a triangle; empty: none.
    pub uvs_1: Vec<Vec2>,
    /// Tangents with handedness in `w`, three a triangle; empty: none.
    pub tangents: Vec<Vec4>,
    /// Linear vertex colours, three a triangle; empty: none.
    pub colors: Vec<Vec4>,
}

/// A place on a [`Surface`]: a triangle and barycentric weights of its corners 0, 1 and 2 (sum 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSite {
    /// Index into [`Surface::triangles`].
    pub triangle: u32,
    /// Weights of the triangle's corners, in the surface's corner order.
    pub weights: Vec3,
}
