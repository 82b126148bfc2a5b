//! How faces have turned since the rest state.

use bevy_coating::film::{FaceId, FilmMesh};
use bevy_math::{Mat3, Vec3};

/// The rotation of every face from rest to now; `None` where it has not moved, so that what stands still keeps its
/// normals to the bit, and where it has no area.
pub fn rotations(mesh: &FilmMesh) -> Vec<Option<Mat3>> {
    mesh.topology.all_faces().map(|f| rotation(mesh, f)).collect()
}

fn rotation(mesh: &FilmMesh, f: FaceId) -> Option<Mat3> {
    let corners = mesh.topology.corners(f);
    let rest = corners.map(|v| mesh.geometry.rest_positions[v.index()]);
    let now = corners.map(|v| mesh.geometry.positions[v.index()]);
    if rest == now {
        return None;
    }
    Some(frame(now)? * frame(rest)?.transpose())
}

/// An orthonormal frame of a triangle. It leans on the triangle's middle rather than on one edge, so that strain
/// turns it as little as possible.
fn frame([a, b, c]: [Vec3; 3]) -> Option<Mat3> {
    let normal = (b - a).cross(c - a).try_normalize()?;
    let along = (b - a).try_normalize()? + normal.cross(c - (a + b) * 0.5).try_normalize().map_or(Vec3::ZERO, |n| -n);
    let along = along.try_normalize()?;
    Some(Mat3::from_cols(along, normal.cross(along), normal))
}
