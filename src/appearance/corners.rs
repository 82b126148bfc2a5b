//! Samples the prop's surface attributes (normals, texture coordinates, colours) at the film's corners.

use std::ops::{Add, Mul};

use bevy_math::{Vec2, Vec3, Vec4, VectorSpace};

use crate::{
    film::FilmMesh,
    remesh::BuiltFilm,
    rest::{LIGHT_PIECE, Rest},
    surface::{Surface, SurfaceSite},
};

/// Cosine of 30 degrees. Where the prop has no normals, a corner gets the smooth vertex normal if that differs by less
/// than this angle from the face's normal, and the face's normal otherwise.
const SMOOTH_COSINE: f32 = 0.866;

/// Attributes of each corner of the film at rest, in the order of the film's half-edges: three entries a face.
///
/// An attribute that the prop does not have is an empty vector. Normals are the exception: where the prop has none they
/// are computed from the film's shape, so there are always three a face.
///
/// ```
/// use bevy_coating::{
///     appearance::CornerAttributes, remesh::sample, settings::CoatingSettings, sim::FilmState,
/// };
///
/// let piece = sample::plate(200, 1)?;
/// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 0, 1000).ok_or("an empty film")?;
/// let attributes = CornerAttributes::sample(&piece.film, &piece.surface, &film.mesh);
/// assert_eq!(attributes.normals.len(), 3 * 200);
/// assert_eq!(attributes.uvs.len(), 3 * 200, "the plate has texture coordinates");
/// assert!(attributes.colors.is_empty(), "but no colours");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CornerAttributes {
    /// Shading normals, of unit length.
    pub normals: Vec<Vec3>,
    /// First texture coordinates; empty if the prop has none.
    pub uvs: Vec<Vec2>,
    /// Second texture coordinates; empty if the prop has none.
    pub uvs_1: Vec<Vec2>,
    /// Tangents of unit length, with the handedness (1 or -1) in `w`; empty if the prop has none.
    pub tangents: Vec<Vec4>,
    /// Linear vertex colours with alpha; empty if the prop has none.
    pub colors: Vec<Vec4>,
}

impl CornerAttributes {
    /// Samples `surface` at the places where the corners of `built` lie on it.
    ///
    /// `mesh` is the film that was made of `built`, in any state: only its rest pose is used.
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

    /// Makes normals unit vectors, and computes the normals that the prop lacks.
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

/// Interpolates the corner values `values` at `sites`. Values that are missing count as zero.
pub(super) fn sample<T: VectorSpace + Copy + Mul<f32, Output = T> + Add<Output = T>>(
    values: &[T],
    sites: &[SurfaceSite],
) -> Vec<T> {
    if values.is_empty() { Vec::new() } else { sites.iter().map(|site| sample_at(values, site)).collect() }
}

/// Does what [`sample`] does, with rests between its pieces.
pub(super) async fn sample_in_pieces<T>(values: &[T], sites: &[SurfaceSite], rest: &mut impl Rest) -> Vec<T>
where
    T: VectorSpace + Copy + Mul<f32, Output = T> + Add<Output = T> + Send + Sync,
{
    let mut sampled = Vec::with_capacity(if values.is_empty() { 0 } else { sites.len() });
    for piece in sites.chunks(LIGHT_PIECE).filter(|_| !values.is_empty()) {
        sampled.extend(piece.iter().map(|site| sample_at(values, site)));
        rest.rest().await;
    }
    sampled
}

/// Interpolates the corner values `values` at one site. Values that are missing count as zero.
pub(super) fn sample_at<T: VectorSpace + Copy + Mul<f32, Output = T> + Add<Output = T>>(
    values: &[T],
    site: &SurfaceSite,
) -> T {
    let first = site.triangle as usize * 3;
    let [a, b, c] = site.weights.to_array();
    let corner = |i: usize| values.get(first + i).copied().unwrap_or(T::ZERO);
    corner(0) * a + corner(1) * b + corner(2) * c
}
