//! Follows how each vertex of the film has turned since rest.

use bevy_math::Vec3;

use super::{
    differences::Differences,
    moves::Moves,
    turn::{Turn, unit},
};
use crate::film::{FaceId, FilmMesh, Topology, VertexId};

/// Rotation of each vertex since rest: the smallest between the normals of its faces then and now.
///
/// Both normals are means over the faces that the vertex has now, so a film at rest has not turned however it has torn.
/// What lies on a vertex (the prop's own normals and tangents) turns with it.
#[derive(Clone, Debug, Default)]
pub(super) struct Frames {
    /// Cross product of two sides of each face at rest and now: its normal, as long as twice its area.
    rest_faces: Vec<Vec3>,
    faces: Vec<Vec3>,
    /// Unit normal of each vertex at rest over the faces that it has now.
    rest: Vec<Vec3>,
    /// Rotation of each vertex.
    turns: Vec<Turn>,
}

impl Frames {
    /// Measures the faces of `mesh` at rest; it may have torn and moved since.
    pub fn new(mesh: &FilmMesh) -> Self {
        let rest = |v| mesh.geometry.rest_positions[mesh.topology.original(v).index()];
        let rest_faces: Vec<_> = mesh.topology.all_faces().map(|f| cross(mesh.topology.corners(f).map(rest))).collect();
        Self { faces: rest_faces.clone(), rest_faces, ..Self::default() }
    }

    /// Turns the vertices at faces that moved, and those with other faces.
    pub fn follow(&mut self, mesh: &FilmMesh, moves: &Moves, differences: &Differences) {
        let Self { rest_faces, faces, rest, turns } = self;
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        rest.resize(topology.vertex_count(), Vec3::ZERO);
        turns.resize(topology.vertex_count(), Turn::default());
        for &f in &moves.faces {
            faces[f.index()] = cross(topology.corners(f).map(|v| geometry.positions[v.index()]));
        }
        if differences.whole {
            for v in topology.all_vertices() {
                rest[v.index()] = mean(topology, rest_faces, v);
            }
        } else {
            for &v in &differences.vertices {
                rest[v.index()] = mean(topology, rest_faces, v);
            }
        }
        for &v in &moves.vertices {
            turns[v.index()] = Turn::between(rest[v.index()], mean(topology, faces, v));
        }
    }

    /// Returns the rotation of `v` since rest.
    #[inline]
    pub fn turn(&self, v: VertexId) -> Turn {
        self.turns[v.index()]
    }
}

/// Returns the unit mean of the normals of the faces around `v`, or zero if it has none.
#[inline]
fn mean(topology: &Topology, faces: &[Vec3], v: VertexId) -> Vec3 {
    let face = |f: FaceId| faces[f.index()];
    unit(topology.fan(v).fold(Vec3::ZERO, |sum, h| sum + face(h.face())))
}

#[inline]
fn cross([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a)
}
