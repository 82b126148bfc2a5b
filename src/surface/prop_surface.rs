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

impl Surface {
    /// Returns the area of all triangles that can be measured, in square metres.
    ///
    /// ```
    /// use bevy_coating::surface::Surface;
    /// use bevy_math::Vec3;
    ///
    /// let positions = vec![Vec3::ZERO, Vec3::X * 2.0, Vec3::Y];
    /// let surface = Surface { positions, triangles: vec![[0, 1, 2]], ..Surface::default() };
    /// assert_eq!(surface.area(), 1.0);
    /// ```
    pub fn area(&self) -> f64 {
        let corner = |v: u32| self.positions.get(v as usize).map(|p| p.as_dvec3());
        let areas = self.triangles.iter().filter_map(|&[a, b, c]| {
            let (a, b, c) = (corner(a)?, corner(b)?, corner(c)?);
            Some((b - a).cross(c - a).length() * 0.5).filter(|area| area.is_finite())
        });
        areas.sum()
    }

    /// Moves a surface that lies far from its space's zero to around zero, and returns the point that zero is now: add
    /// it to a position to get the old one. Surfaces that are not far away stay where they are, and zero is returned.
    ///
    /// Single precision has seven digits: a prop that was modelled a kilometre from its origin would move in steps of
    /// 0.06 mm. Far is more than eight times the size of the surface.
    ///
    /// ```
    /// use bevy_coating::surface::Surface;
    /// use bevy_math::Vec3;
    ///
    /// let far = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|corner| corner + Vec3::Z * 1024.0);
    /// let mut surface = Surface { positions: far.to_vec(), triangles: vec![[0, 1, 2]], ..Surface::default() };
    /// assert_eq!(surface.recentre(), Vec3::new(0.5, 0.5, 1024.0));
    /// assert_eq!(surface.positions[1], Vec3::new(0.5, -0.5, 0.0));
    /// ```
    pub fn recentre(&mut self) -> Vec3 {
        let finite = || self.positions.iter().filter(|p| p.is_finite()).map(|p| p.as_dvec3());
        let bounds = finite().map(|p| (p, p)).reduce(|(low, high), (p, _)| (low.min(p), high.max(p)));
        let Some((low, high)) = bounds else { return Vec3::ZERO };
        let middle = (low * 0.5 + high * 0.5).as_vec3();
        if !middle.is_finite() || middle.as_dvec3().length() <= FAR * (high - low).length() {
            return Vec3::ZERO;
        }
        for position in &mut self.positions {
            *position = (position.as_dvec3() - middle.as_dvec3()).as_vec3();
        }
        middle
    }
}

/// Distance from zero, in sizes of the surface, beyond which single precision is too coarse.
const FAR: f64 = 8.0;

/// Point on a [`Surface`], given by a triangle and barycentric weights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSite {
    /// Index of the triangle in [`Surface::triangles`].
    pub triangle: u32,
    /// Weights of the triangle's corners 0, 1 and 2. They sum to 1.
    pub weights: Vec3,
}
