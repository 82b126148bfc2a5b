//! Follows how each vertex of the film has turned since rest, as patches need it.

use bevy_math::{Mat3A, Vec3A};

use crate::appearance::seen::Seen;
use crate::{film::FilmMesh, fracture::FilmForces};

/// Normal of each vertex, and the rotation that brought it there from rest.
///
/// Vertices that are attached have not turned.
#[derive(Clone, Debug, Default)]
pub(super) struct VertexFrames {
    /// Unit normal of each vertex.
    pub normals: Vec<Vec3A>,
    /// Rotation of each vertex since rest.
    pub rotations: Vec<Mat3A>,
    /// Whether each vertex is where it was at rest and has not turned.
    pub still: Vec<bool>,
}

impl VertexFrames {
    /// Turns the vertices at faces that moved.
    pub fn follow(&mut self, mesh: &FilmMesh, forces: &FilmForces, seen: &Seen) {
        let Self { normals, rotations, still } = self;
        let geometry = &mesh.geometry;
        let count = mesh.topology.vertex_count();
        normals.resize(count, Vec3A::ZERO);
        rotations.resize(count, Mat3A::IDENTITY);
        still.resize(count, true);
        for &v in &seen.moves.vertices {
            let i = v.index();
            let turn = if forces.is_attached(v) { Default::default() } else { seen.frames.turn(v) };
            normals[i] = turn.apply(geometry.rest_normals[i]).into();
            rotations[i] = turn.matrix();
            still[i] = turn.is_still() && seen.moves.positions()[i] == geometry.rest_positions[i];
        }
    }
}
