//! The prop's own surface as plain arrays, and a point on it.

use bevy_math::{Vec2, Vec3, Vec4};

/// Surface of one prop: the triangles of all primitives of one glTF node, in the prop's space with its world scale
/// applied.
///
/// Corner attributes (normals and all that follow) hold three entries for each triangle, in the order of its corners:
/// corner `k` of triangle `t` is entry `3 * t + k`. An attribute that the prop does not have is an empty list.
///
/// ```
/// use bevy_coating::surface::Surface;
/// use bevy_math::{Vec2, Vec3};
///
/// // One triangle with texture coordinates and without normals.
/// let surface = Surface {
///     positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
///     triangles: vec![[0, 1, 2]],
///     uvs: vec![Vec2::ZERO, Vec2::X, Vec2::Y],
///     ..Surface::default()
/// };
/// assert_eq!(surface.uvs.len(), 3 * surface.triangles.len());
/// ```
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Positions of the vertices. Vertices may be unused, and several may have the same position.
    pub positions: Vec<Vec3>,
    /// Vertex indices of each triangle, counter-clockwise seen from outside. [`clean`](crate::surface::clean) turns
    /// triangles that disagree with their neighbours.
    pub triangles: Vec<[u32; 3]>,
    /// Slot of each triangle: the number of its primitive, and so of its material. If empty, all triangles are in slot
    /// 0.
    pub slots: Vec<u32>,
    /// Shading normals of the corners. They need not have unit length.
    pub normals: Vec<Vec3>,
    /// First texture coordinates of the corners.
    pub uvs: Vec<Vec2>,
    /// Second texture coordinates of the corners, often those of a lightmap.
    pub uvs_1: Vec<Vec2>,
    /// Tangents of the corners, with the handedness (1 or -1) in `w`.
    pub tangents: Vec<Vec4>,
    /// Linear RGBA colours of the corners.
    pub colors: Vec<Vec4>,
}

/// Point on a [`Surface`], given by a triangle and barycentric weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSite {
    /// Index of the triangle in [`Surface::triangles`].
    pub triangle: u32,
    /// Weights of the triangle's corners 0, 1 and 2. They sum to 1.
    pub weights: Vec3,
}
