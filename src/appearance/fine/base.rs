//! The prop's surface at the points of the faces' grids, at rest.

use bevy_math::{Vec2, Vec3, Vec4};

use crate::{
    appearance::corners::{CornerAttributes, sample},
    film::{FaceGrid, FaceId, FilmMesh},
    remesh::FineSites,
    surface::Surface,
};

/// Positions and attributes of every point of every face's grid at rest, face by face.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Base {
    /// Number of points of a face.
    pub points: usize,
    pub positions: Vec<Vec3>,
    /// Attributes of each point; as in [`CornerAttributes`], those that the prop does not have are empty.
    pub attributes: CornerAttributes,
}

/// Position and attributes at one place of a face, but for tangents: chips shift them too little to be seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub position: Vec3,
    pub normal: Vec3,
    pub uv: Option<Vec2>,
    pub uv_1: Option<Vec2>,
    pub color: Option<Vec4>,
}

impl Base {
    /// Samples `surface` at `sites`. Where the prop has no normals they are those at the film's corners, interpolated.
    pub fn new(
        sites: &FineSites,
        surface: &Surface,
        mesh: &FilmMesh,
        corners: &CornerAttributes,
        grid: &FaceGrid,
    ) -> Self {
        let mut positions = sites.positions.clone();
        let count = grid.points().len() * mesh.topology.face_count();
        // As many as there are faces, whatever came in.
        positions.resize(count, Vec3::ZERO);
        let mut normals = sample(&surface.normals, &sites.sites);
        normals.resize(count, Vec3::ZERO);
        for (f, normals) in normals.chunks_exact_mut(grid.points().len()).enumerate() {
            let of_corner = |k: usize| corners.normals.get(3 * f + k).copied().unwrap_or(Vec3::Z);
            for (normal, b) in normals.iter_mut().zip(grid.points()) {
                *normal = normal.normalize_or_zero();
                if *normal == Vec3::ZERO {
                    let mean = of_corner(0) * b.x + of_corner(1) * b.y + of_corner(2) * b.z;
                    *normal = mean.normalize_or(of_corner(0));
                }
            }
        }
        let mut tangents = sample(&surface.tangents, &sites.sites);
        for t in &mut tangents {
            *t = t.truncate().normalize_or(Vec3::X).extend(if t.w < 0.0 { -1.0 } else { 1.0 });
        }
        let attributes = CornerAttributes {
            normals,
            uvs: sample(&surface.uvs, &sites.sites),
            uvs_1: sample(&surface.uvs_1, &sites.sites),
            tangents,
            colors: sample(&surface.colors, &sites.sites),
        };
        Self { points: grid.points().len(), positions, attributes }
    }

    /// Returns the index of the point `i` of the face `f`.
    #[inline]
    pub fn index(&self, f: FaceId, i: usize) -> usize {
        f.index() * self.points + i
    }

    /// Returns what lies at the barycentric coordinates `b` of the face `f`: linear between the points of its grid, and
    /// beyond its edges a continuation.
    pub(super) fn at(&self, grid: &FaceGrid, f: FaceId, b: Vec3) -> Place {
        let (points, weights) = grid.locate(b);
        let indices = points.map(|i| self.index(f, i as usize));
        let CornerAttributes { normals, uvs, uvs_1, colors, .. } = &self.attributes;
        Place {
            position: mix(&self.positions, indices, weights).unwrap_or_default(),
            normal: mix(normals, indices, weights).map_or(Vec3::Z, |n| n.normalize_or(normals[indices[0]])),
            uv: mix(uvs, indices, weights),
            uv_1: mix(uvs_1, indices, weights),
            color: mix(colors, indices, weights).map(|color| color.clamp(Vec4::ZERO, Vec4::INFINITY)),
        }
    }
}

/// Returns the weighted sum of three values; `None` where there are none.
fn mix<T>(values: &[T], indices: [usize; 3], weights: Vec3) -> Option<T>
where
    T: Copy + std::ops::Mul<f32, Output = T> + std::ops::Add<Output = T>,
{
    let [a, b, c] = indices.map(|i| values.get(i).copied());
    Some(a? * weights.x + b? * weights.y + c? * weights.z)
}
