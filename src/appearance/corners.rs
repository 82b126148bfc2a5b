//! Attributes of the film's corners, taken from the prop's surface.

use std::ops::{Add, Mul};

use bevy_math::{Vec2, Vec3, Vec4, VectorSpace};

use crate::{
    film::FilmMesh,
    remesh::BuiltFilm,
    surface::{Surface, SurfaceSite},
};

/// Cosine of 30 degrees: where the prop has no normals, film that turns by less is shaded smooth.
const SMOOTH_COSINE: f32 = 0.866;

/// Attributes of each corner of the film at rest, three a face; empty where the prop has none, but for normals, which
/// are made up then.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CornerAttributes {
    /// Unit shading normals.
    pub normals: Vec<Vec3>,
    /// First texture coordinates.
    pub uvs: Vec<Vec2>,
    /// Second texture coordinates.
    pub uvs_1: Vec<Vec2>,
    /// Unit tangents, handedness in `w`.
    pub tangents: Vec<Vec4>,
    /// Linear colours.
    pub colors: Vec<Vec4>,
}

impl CornerAttributes {
    /// Samples `surface` where the corners of `built` lie on it. `mesh` is the film at rest or later.
    pub fn sample(built: &BuiltFilm, surface: &Surface, mesh: &FilmMesh) -> Self {
        let sites = &built.sites;
        let mut attributes = Self {
            normals: sample(&surface.normals, sites),
            uvs: sample(&surface.uvs, sites),
            uvs_1: sample(&surface.uvs_1, sites),
            tangents: sample(&surface.tangents, sites),
            colors: sample(&surface.colors, sites),
        };
        attributes.normals.resize(mesh.topology.half_edge_count(), Vec3::ZERO);
        attributes.finish_normals(mesh);
        for t in &mut attributes.tangents {
            *t = t.truncate().normalize_or(Vec3::X).extend(if t.w < 0.0 { -1.0 } else { 1.0 });
        }
        attributes
    }

    /// Makes normals unit vectors, and fills in those that the prop lacks.
    fn finish_normals(&mut self, mesh: &FilmMesh) {
        for h in mesh.topology.all_half_edges() {
            let normal = &mut self.normals[h.index()];
            *normal = normal.normalize_or_zero();
            if *normal == Vec3::ZERO {
                let original = |v| mesh.topology.original(v).index();
                let rest = |v| mesh.geometry.rest_positions[original(v)];
                let [a, b, c] = mesh.topology.corners(h.face()).map(rest);
                let flat = (b - a).cross(c - a).normalize_or(Vec3::Z);
                let smooth = mesh.geometry.rest_normals[original(mesh.topology.origin(h))];
                *normal = if smooth.dot(flat) > SMOOTH_COSINE { smooth } else { flat };
            }
        }
    }
}

fn sample<T: VectorSpace + Copy + Mul<f32, Output = T> + Add<Output = T>>(
    values: &[T],
    sites: &[SurfaceSite],
) -> Vec<T> {
    if values.is_empty() {
        return Vec::new();
    }
    let at = |site: &SurfaceSite| {
        let first = site.triangle as usize * 3;
        let [a, b, c] = site.weights.to_array();
        let corner = |i: usize| values.get(first + i).copied().unwrap_or(T::ZERO);
        corner(0) * a + corner(1) * b + corner(2) * c
    };
    sites.iter().map(at).collect()
}
