//! Casts rays from the surface of a film at rest.

use std::sync::Arc;

use bevy_math::{Affine3A, Vec3, ops};

use super::{ray::Ray, tree::TriangleTree};
use crate::{
    film::{FilmMesh, VertexId},
    rest::{NoRest, PIECE, Rest, at_once},
    stain::fields::Exposure,
};

/// Number of rays that are cast from each vertex.
pub const RAYS: usize = 16;
/// Tangent of half the opening angle (4 degrees) of the cone that the rays of a vertex fill.
pub const SPREAD: f32 = 0.07;

/// Distance from the surface at which rays begin, in mean edges.
const LIFT: f32 = 0.01;
/// Distance that is added to [`LIFT`], relative to the largest coordinate, for rounding.
const LIFT_ROUNDING: f32 = 16.0 * f32::EPSILON;
/// Least sine of the angle between a ray and the tangent plane. Below it a surface may meet its own rays by rounding.
const GRAZING: f32 = 0.02;

/// Surface of a film at rest, prepared for casting rays from it.
///
/// Preparing costs more than casting; keep the surface where rain or sun change often. [`exposure_of`] does both at
/// once.
///
/// ```
/// use std::sync::Arc;
///
/// use bevy_coating::{
///     film::FilmMesh,
///     stain::exposure::{Blocker, ExposedSurface, TriangleTree},
/// };
/// use bevy_math::{Affine3A, Vec3};
///
/// let (a, b, c) = (Vec3::ZERO, Vec3::Z, Vec3::X);
/// let surface = ExposedSurface::new(&FilmMesh::new(vec![a, b, c], &[[0, 1, 2]])?);
/// // A larger triangle, 2 metres above.
/// let roof = [a, b, c].map(|p| (p - Vec3::splat(0.3)) * 10.0 + Vec3::Y * 5.0);
/// let roof = Blocker { tree: Arc::new(TriangleTree::new([roof])), into: Affine3A::IDENTITY };
///
/// let exposure = surface.cast(&[roof], Vec3::NEG_Y, Vec3::new(1.0, -0.1, 0.0));
/// assert_eq!(exposure.rain, [0.0; 3], "the roof keeps the rain off");
/// assert!(exposure.sun.is_empty(), "the low sun shines in under it");
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
#[derive(Clone, Debug)]
pub struct ExposedSurface {
    /// Place where the rays of each original vertex begin.
    points: Vec<Vec3>,
    /// Unit normal of each original vertex, or zero.
    normals: Vec<Vec3>,
    /// Triangles of the surface.
    tree: TriangleTree,
    /// Centre of a sphere around the surface.
    center: Vec3,
    /// Radius of that sphere.
    radius: f32,
}

/// Triangles, in a space of their own, that may hold off rain and sunlight.
#[derive(Clone, Debug)]
pub struct Blocker {
    /// Triangles of the blocker.
    pub tree: Arc<TriangleTree>,
    /// Transform from the film's space to the space of the triangles. A blocker whose transform cannot be inverted
    /// blocks nothing.
    pub into: Affine3A,
}

impl ExposedSurface {
    /// Prepares the surface of `mesh` as it was at rest, whatever has torn, moved or fallen since.
    pub fn new(mesh: &FilmMesh) -> Self {
        at_once(Self::new_in_pieces(mesh, &mut NoRest))
    }

    /// Does what [`new`](Self::new) does, with rests between its pieces.
    pub(crate) async fn new_in_pieces(mesh: &FilmMesh, rest: &mut impl Rest) -> Self {
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        let originals = topology.original_vertex_count();
        let at = |v: VertexId| geometry.rest_positions[topology.original(v).index()];
        let triangles = topology.all_faces().map(|f| topology.corners(f).map(at));
        let tree = TriangleTree::new_in_pieces(triangles, rest).await;
        let normals = geometry.rest_normals[..originals].to_vec();
        let points = geometry.rest_positions[..originals]
            .iter()
            .zip(&normals)
            .map(|(&p, &normal)| p + normal * (LIFT * geometry.mean_edge + LIFT_ROUNDING * p.abs().max_element()))
            .collect();
        let (min, max) = tree.bounds().unwrap_or_default();
        Self { points, normals, tree, center: (min + max) / 2.0, radius: (max - min).length() / 2.0 }
    }

    /// Returns the centre and the radius of a sphere around the surface, in the film's space.
    pub fn sphere(&self) -> (Vec3, f32) {
        (self.center, self.radius)
    }

    /// Returns the exposure of each original vertex to rain that falls along `rain` and to sunlight that falls along
    /// `sun`.
    ///
    /// Both are directions in the film's space, of any length. A direction that is zero or not finite means that there
    /// is no rain or sunlight: no rays are cast and its field of the result is empty. A field is also empty if
    /// everything is exposed. The surface blocks its own rays, beside the `blockers`.
    pub fn cast(&self, blockers: &[Blocker], rain: Vec3, sun: Vec3) -> Exposure {
        at_once(self.cast_in_pieces(blockers, rain, sun, &mut NoRest))
    }

    /// Does what [`cast`](Self::cast) does, with rests between its pieces.
    pub(crate) async fn cast_in_pieces(
        &self,
        blockers: &[Blocker],
        rain: Vec3,
        sun: Vec3,
        rest: &mut impl Rest,
    ) -> Exposure {
        Exposure { rain: self.cast_one(blockers, rain, rest).await, sun: self.cast_one(blockers, sun, rest).await }
    }

    /// Returns the share of the rays against `direction` that meet nothing, for each original vertex; empty if no ray
    /// meets anything.
    async fn cast_one(&self, blockers: &[Blocker], direction: Vec3, rest: &mut impl Rest) -> Vec<f32> {
        let Some(up) = (-direction).try_normalize() else { return Vec::new() };
        let blockers: Vec<&Blocker> = blockers.iter().filter(|blocker| self.may_meet(blocker, up)).collect();
        let (mut cast, mut free) = (vec![0u32; self.points.len()], vec![0u32; self.points.len()]);
        let mut origins = Vec::with_capacity(self.points.len());
        let mut open = vec![false; self.points.len()];
        for towards in cone(up) {
            for ((open, cast), normal) in open.iter_mut().zip(&mut cast).zip(&self.normals) {
                // Rays into the surface itself tell which way it faces, not what shelters it, so they are not counted.
                // A vertex that has no other rays faces away and counts as sheltered.
                *open = *normal == Vec3::ZERO || normal.dot(towards) > GRAZING;
                *cast += u32::from(*open);
            }
            let own = Ray::new(towards);
            close(&mut open, &self.points, |p| self.tree.is_met(&own, p), rest).await;
            for blocker in &blockers {
                let Some(direction) = blocker.into.transform_vector3(towards).try_normalize() else { continue };
                let ray = Ray::new(direction);
                origins.clear();
                origins.extend(self.points.iter().map(|&p| blocker.into.transform_point3(p)));
                close(&mut open, &origins, |p| blocker.tree.is_met(&ray, p), rest).await;
            }
            for (free, &open) in free.iter_mut().zip(&open) {
                *free += u32::from(open);
            }
        }
        if cast == free && cast.iter().all(|&cast| cast > 0) {
            return Vec::new();
        }
        cast.iter().zip(&free).map(|(&cast, &free)| free as f32 / cast.max(1) as f32).collect()
    }

    /// Returns whether `blocker` may meet rays from the surface along `up`, a unit vector. Compares spheres around the
    /// two, so `true` does not mean that a ray does meet it.
    pub fn may_meet(&self, blocker: &Blocker, up: Vec3) -> bool {
        let Some((min, max)) = blocker.tree.bounds() else { return false };
        let out = blocker.into.inverse();
        if !(blocker.into.is_finite() && out.is_finite()) {
            return false;
        }
        let middle = out.transform_point3((min + max) / 2.0);
        // No less than half the diagonal of the transformed box.
        let (axes, size) = (out.matrix3, (max - min) / 2.0);
        let reach = axes.x_axis.length() * size.x + axes.y_axis.length() * size.y + axes.z_axis.length() * size.z;
        let apart = middle - self.center;
        let along = apart.dot(up);
        let radii = self.radius + reach;
        let aside = (apart - up * along).length();
        along >= -radii && aside <= radii + SPREAD * (along + radii).max(0.0)
    }
}

/// Clears each entry of `open` whose point is met.
async fn close(open: &mut [bool], points: &[Vec3], is_met: impl Fn(Vec3) -> bool + Send, rest: &mut impl Rest) {
    for (open, points) in open.chunks_mut(2 * PIECE).zip(points.chunks(2 * PIECE)) {
        for (open, &p) in open.iter_mut().zip(points) {
            *open = *open && !is_met(p);
        }
        rest.rest().await;
    }
}

/// Returns directions that fill the cone around `up`, a unit vector, evenly. Their ends are arranged like the seeds of
/// a sunflower: each is turned by a golden angle from the one before and stands for an equal share of the disk.
fn cone(up: Vec3) -> [Vec3; RAYS] {
    const GOLDEN_ANGLE: f32 = 2.399_963_2;
    let (a, b) = up.any_orthonormal_pair();
    core::array::from_fn(|k| {
        let radius = SPREAD * ((k as f32 + 0.5) / RAYS as f32).sqrt();
        let (sin, cos) = ops::sin_cos(GOLDEN_ANGLE * k as f32);
        up + (a * cos + b * sin) * radius
    })
}

/// Returns the exposure of a film to rain that falls along `rain` and to sunlight that falls along `sun`, with
/// `triangles` standing around it. All are in the film's space; see [`ExposedSurface::cast`] for the details.
///
/// ```
/// use bevy_coating::{film::FilmMesh, stain::exposure::exposure_of};
/// use bevy_math::Vec3;
///
/// let (a, b, c) = (Vec3::ZERO, Vec3::Z, Vec3::X);
/// let film = FilmMesh::new(vec![a, b, c], &[[0, 1, 2]]).expect("a triangle");
/// let roof = [a, b, c].map(|p| (p - Vec3::splat(0.3)) * 10.0 + Vec3::Y * 5.0);
/// assert_eq!(exposure_of(&film, [roof], Vec3::NEG_Y, Vec3::ZERO).rain, [0.0; 3]);
/// assert!(exposure_of(&film, [], Vec3::NEG_Y, Vec3::ZERO).rain.is_empty(), "nothing shelters anything");
/// ```
pub fn exposure_of(film: &FilmMesh, triangles: impl IntoIterator<Item = [Vec3; 3]>, rain: Vec3, sun: Vec3) -> Exposure {
    let around = Blocker { tree: Arc::new(TriangleTree::new(triangles)), into: Affine3A::IDENTITY };
    ExposedSurface::new(film).cast(&[around], rain, sun)
}
