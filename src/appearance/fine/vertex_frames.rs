//! Follows how each vertex of the film has turned since rest.

use bevy_math::{Mat3A, Vec3, Vec3A};

use crate::appearance::{
    moves::Moves,
    turn::{Turn, unit},
};
use crate::{film::FilmMesh, fracture::FilmForces};

/// Normal of each vertex, and the rotation that brought it there from rest.
///
/// Vertices that are attached have not turned. The normal of others is their normal at rest, turned with each of their
/// faces and averaged, so a film at rest has exactly the normals at rest however it has torn.
#[derive(Clone, Debug, Default)]
pub(super) struct VertexFrames {
    /// Unit normal of each face at rest; zero for a face without area.
    rest_faces: Vec<Vec3>,
    /// Twice the area of each face at rest: its weight in means.
    weights: Vec<f32>,
    /// Rotation of each face since rest.
    turns: Vec<Turn>,
    /// Unit normal of each vertex.
    pub normals: Vec<Vec3A>,
    /// Rotation of each vertex since rest.
    pub rotations: Vec<Mat3A>,
    /// Whether each vertex is where it was at rest and has not turned.
    pub still: Vec<bool>,
}

impl VertexFrames {
    /// Measures the faces of `mesh` at rest; it may have torn and moved since.
    pub fn new(mesh: &FilmMesh) -> Self {
        let topology = &mesh.topology;
        let cross = |f| {
            let [a, b, c] = topology.corners(f).map(|v| mesh.geometry.rest_positions[topology.original(v).index()]);
            (b - a).cross(c - a)
        };
        Self {
            rest_faces: topology.all_faces().map(|f| unit(cross(f))).collect(),
            weights: topology.all_faces().map(|f| cross(f).length()).collect(),
            turns: vec![Turn::default(); topology.face_count()],
            ..Self::default()
        }
    }

    /// Turns the vertices at faces that moved.
    pub fn follow(&mut self, mesh: &FilmMesh, forces: &FilmForces, moves: &Moves) {
        let Self { rest_faces, weights, turns, normals, rotations, still } = self;
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        for f in topology.live_faces().filter(|&f| moves.has_moved(f)) {
            let [a, b, c] = topology.corners(f).map(|v| geometry.positions[v.index()]);
            turns[f.index()] = Turn::between(rest_faces[f.index()], unit((b - a).cross(c - a)));
        }
        let count = topology.vertex_count();
        normals.resize(count, Vec3A::ZERO);
        rotations.resize(count, Mat3A::IDENTITY);
        still.resize(count, true);
        for v in topology.all_vertices().filter(|&v| moves.is_turned(v)) {
            let i = v.index();
            let rest = geometry.rest_normals[i];
            let mut sum = Vec3::ZERO;
            let mut turned = false;
            if !forces.is_attached(v) {
                for f in topology.fan(v).map(|h| h.face().index()) {
                    turned |= !turns[f].is_still();
                    sum += turns[f].apply(rest) * weights[f];
                }
            }
            let mean = unit(sum);
            let now = if turned && mean != Vec3::ZERO { mean } else { rest };
            let turn = Turn::between(rest, now);
            normals[i] = now.into();
            rotations[i] = turn.matrix();
            still[i] = turn.is_still() && geometry.positions[i] == geometry.rest_positions[i];
        }
    }
}
