//! The prop's surface at the points of the faces' grids, at rest.

use bevy_math::{Vec2, Vec3, Vec4};

use super::lanes::Places;
use crate::{
    appearance::{
        corners::{CornerAttributes, sample},
        part::MeshPart,
    },
    film::{FaceGrid, FaceId, FilmMesh},
    remesh::{BuiltFilm, FineSites, fine_sites},
    surface::{BuildError, Surface},
};

/// Grid of every face, and positions and attributes of each of its points at rest, face by face.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Base {
    pub grid: FaceGrid,
    /// Where the points of the grid lie on their face.
    pub(super) places: Vec<Places>,
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
    /// Samples `surface` at the points of the grids of `level`.
    ///
    /// # Errors
    /// The errors of [`fine_sites`].
    pub fn sample(
        built: &BuiltFilm,
        surface: &Surface,
        mesh: &FilmMesh,
        corners: &CornerAttributes,
        level: u32,
    ) -> Result<Self, BuildError> {
        let grid = FaceGrid::new(level);
        let sites = fine_sites(surface, built, &grid)?;
        Ok(Self::new(&sites, surface, mesh, corners, grid))
    }

    /// Returns the same at the points of the grids of `level`, which is not above that of this.
    pub fn coarser(&self, level: u32) -> Self {
        let grid = FaceGrid::new(level);
        let own = self.grid.points_of(&grid);
        let faces = self.positions.len() / self.points.max(1);
        let indices = || (0..faces).flat_map(|f| own.iter().map(move |&i| f * self.points + i as usize));
        fn pick<T: Copy>(values: &[T], indices: impl Iterator<Item = usize>) -> Vec<T> {
            if values.is_empty() { Vec::new() } else { indices.map(|i| values[i]).collect() }
        }
        let CornerAttributes { normals, uvs, uvs_1, tangents, colors } = &self.attributes;
        let attributes = CornerAttributes {
            normals: pick(normals, indices()),
            uvs: pick(uvs, indices()),
            uvs_1: pick(uvs_1, indices()),
            tangents: pick(tangents, indices()),
            colors: pick(colors, indices()),
        };
        Self {
            places: Places::all(grid.points()),
            points: own.len(),
            positions: pick(&self.positions, indices()),
            attributes,
            grid,
        }
    }

    /// Samples `surface` at `sites`. Where the prop has no normals they are those at the film's corners, interpolated.
    fn new(sites: &FineSites, surface: &Surface, mesh: &FilmMesh, corners: &CornerAttributes, grid: FaceGrid) -> Self {
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
        Self { points: grid.points().len(), places: Places::all(grid.points()), positions, attributes, grid }
    }

    /// Returns the index of the point `i` of the face `f`.
    #[inline]
    pub fn index(&self, f: FaceId, i: usize) -> usize {
        f.index() * self.points + i
    }

    /// Writes the triangles of a face whose vertices begin at `vertex`, from the index `index` on; with `flipped`, the
    /// other way round.
    pub(super) fn put_triangles(&self, part: &mut MeshPart, vertex: u32, index: u32, flipped: bool) {
        for (i, triangle) in self.grid.triangles().iter().enumerate() {
            part.put_triangle(index as usize + 3 * i, triangle.map(|point| vertex + point), flipped);
        }
    }

    /// Returns what lies at the point `i` of the face `f`.
    pub(super) fn of(&self, f: FaceId, i: usize) -> Place {
        let at = self.index(f, i);
        let CornerAttributes { normals, uvs, uvs_1, colors, .. } = &self.attributes;
        Place {
            position: self.positions[at],
            normal: normals[at],
            uv: uvs.get(at).copied(),
            uv_1: uvs_1.get(at).copied(),
            color: colors.get(at).copied(),
        }
    }

    /// Returns what lies at the barycentric coordinates `b` of the face `f`: linear between the points of its grid, and
    /// beyond its edges a continuation.
    pub(super) fn at(&self, f: FaceId, b: Vec3) -> Place {
        let (points, weights) = self.grid.locate(b);
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
