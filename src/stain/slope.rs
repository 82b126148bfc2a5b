//! Decides whether a surface is steep enough for run-off (VC 6.1).

use bevy_math::Vec3;

use crate::film::{FilmMesh, VertexId};

/// Least part of gravity along the surface at which run-off flows and rust comes out. Without this limit a horizontal
/// plate would bleed rust through rounding.
pub(super) const LEAST_PULL: f32 = 1e-3;

/// Returns whether `gravity` pulls along the surface at `v`, in rest positions.
pub(super) fn is_steep(mesh: &FilmMesh, v: VertexId, gravity: Vec3) -> bool {
    let normal = mesh.geometry.rest_normals[v.index()];
    (gravity - normal * gravity.dot(normal)).length_squared() >= LEAST_PULL * LEAST_PULL
}
