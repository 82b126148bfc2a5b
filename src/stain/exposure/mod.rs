//! What shelters a surface from rain and sun: rays from every vertex against the direction in which they fall.
//!
//! Rays are cast from the film at rest, a little off the metal, through the film itself and whatever stands around.
//! Several rays a vertex, spread over a narrow cone, make the borders soft, as drifting drops and a wide sun do.
//! The pattern is fixed, so that the same scene gives the same bits on any machine and any number of threads.

mod ray;
mod tree;

#[cfg(test)]
mod tests;

use std::sync::Arc;

use bevy_math::{Affine3A, Vec3, ops};

use super::Exposure;
use crate::film::{FilmMesh, VertexId};
pub use ray::Ray;
pub use tree::TriangleTree;

/// Rays a vertex.
pub const RAYS: usize = 16;
/// Tangent of half the angle of the cone that they fill: 4 degrees.
pub const SPREAD: f32 = 0.07;

/// How far off the surface rays begin, in mean edges.
const LIFT: f32 = 0.01;
/// And in units of the last place of the coordinates.
const LIFT_ROUNDING: f32 = 16.0 * f32::EPSILON;
/// Sine of the angle over its tangent plane below which a surface would meet its own rays by rounding alone.
const GRAZING: f32 = 0.02;

/// The surface of a film at rest, ready to be asked what reaches it.
#[derive(Clone, Debug)]
pub struct ExposedSurface {
    /// Where the rays of each original vertex begin.
    points: Vec<Vec3>,
    /// Unit normal of each original vertex, or zero.
    normals: Vec<Vec3>,
    tree: TriangleTree,
    center: Vec3,
    radius: f32,
}

/// Something that may stand in the way: triangles in a space of their own.
#[derive(Clone, Debug)]
pub struct Blocker {
    /// Its triangles.
    pub tree: Arc<TriangleTree>,
    /// From the film's space to theirs.
    pub into: Affine3A,
}

impl ExposedSurface {
    /// The surface of `mesh` as it was at rest, whatever has happened to the film since.
    pub fn new(mesh: &FilmMesh) -> Self {
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        let originals = topology.original_vertex_count();
        let at = |v: VertexId| geometry.rest_positions[topology.original(v).index()];
        let tree = TriangleTree::new(topology.all_faces().map(|f| topology.corners(f).map(at)));
        let normals = geometry.rest_normals[..originals].to_vec();
        let points = geometry.rest_positions[..originals]
            .iter()
            .zip(&normals)
            .map(|(&p, &normal)| p + normal * (LIFT * geometry.mean_edge + LIFT_ROUNDING * p.abs().max_element()))
            .collect();
        let (min, max) = tree.bounds().unwrap_or_default();
        Self { points, normals, tree, center: (min + max) / 2.0, radius: (max - min).length() / 2.0 }
    }

    /// Middle and radius of a sphere around the surface.
    pub fn sphere(&self) -> (Vec3, f32) {
        (self.center, self.radius)
    }

    /// What reaches the surface of rain and of sunlight that fall along `rain` and `sun` (in the film's space, of any
    /// length; zero, which is also how anything not finite counts: none, and then nothing is cast). The surface
    /// itself blocks in any case.
    pub fn cast(&self, blockers: &[Blocker], rain: Vec3, sun: Vec3) -> Exposure {
        Exposure { rain: self.cast_one(blockers, rain), sun: self.cast_one(blockers, sun) }
    }

    /// Share of the rays against `direction` that get away, for each original vertex; empty if all do.
    fn cast_one(&self, blockers: &[Blocker], direction: Vec3) -> Vec<f32> {
        let Some(up) = (-direction).try_normalize() else { return Vec::new() };
        let blockers: Vec<&Blocker> = blockers.iter().filter(|blocker| self.may_meet(blocker, up)).collect();
        let (mut cast, mut free) = (vec![0u32; self.points.len()], vec![0u32; self.points.len()]);
        let mut origins = Vec::with_capacity(self.points.len());
        let mut open = vec![false; self.points.len()];
        for towards in cone(up) {
            for ((open, cast), normal) in open.iter_mut().zip(&mut cast).zip(&self.normals) {
                // Rays into the surface itself say which way it faces, not what shelters it. A point that has no
                // other is turned away, and keeps none.
                *open = *normal == Vec3::ZERO || normal.dot(towards) > GRAZING;
                *cast += u32::from(*open);
            }
            let own = Ray::new(towards);
            close(&mut open, &self.points, |p| self.tree.is_met(&own, p));
            for blocker in &blockers {
                let Some(direction) = blocker.into.transform_vector3(towards).try_normalize() else { continue };
                let ray = Ray::new(direction);
                origins.clear();
                origins.extend(self.points.iter().map(|&p| blocker.into.transform_point3(p)));
                close(&mut open, &origins, |p| blocker.tree.is_met(&ray, p));
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

    /// Whether `blocker` may stand in the way of rays along `up`, a unit vector, as far as spheres around the two tell.
    pub fn may_meet(&self, blocker: &Blocker, up: Vec3) -> bool {
        let Some((min, max)) = blocker.tree.bounds() else { return false };
        let out = blocker.into.inverse();
        if !(blocker.into.is_finite() && out.is_finite()) {
            return false;
        }
        let middle = out.transform_point3((min + max) / 2.0);
        // At least half a diagonal of the box, however its sides are turned.
        let (axes, size) = (out.matrix3, (max - min) / 2.0);
        let reach = axes.x_axis.length() * size.x + axes.y_axis.length() * size.y + axes.z_axis.length() * size.z;
        let apart = middle - self.center;
        let along = apart.dot(up);
        let radii = self.radius + reach;
        let aside = (apart - up * along).length();
        along >= -radii && aside <= radii + SPREAD * (along + radii).max(0.0)
    }
}

/// Clears `open` where `is_met`.
fn close(open: &mut [bool], points: &[Vec3], is_met: impl Fn(Vec3) -> bool) {
    for (open, &p) in open.iter_mut().zip(points) {
        *open = *open && !is_met(p);
    }
}

/// Directions spread evenly over the cone around `up`, a unit vector: points of a sunflower's head, each a golden
/// angle further round and all of equal share of the disk.
fn cone(up: Vec3) -> [Vec3; RAYS] {
    const GOLDEN_ANGLE: f32 = 2.399_963_2;
    let (a, b) = up.any_orthonormal_pair();
    core::array::from_fn(|k| {
        let radius = SPREAD * ((k as f32 + 0.5) / RAYS as f32).sqrt();
        let (sin, cos) = ops::sin_cos(GOLDEN_ANGLE * k as f32);
        up + (a * cos + b * sin) * radius
    })
}

/// What reaches a film of rain and sunlight that fall along `rain` and `sun`, with `triangles` standing around it, all
/// in the film's space: for tools without an engine. See [`ExposedSurface::cast`].
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
