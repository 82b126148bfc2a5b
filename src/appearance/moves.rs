//! Finds the vertices that have moved since the appearance was last brought up to date.

use bevy_math::Vec3;

use crate::film::{FaceId, FilmMesh, VertexId};

/// Vertices that moved, and the faces and vertices whose directions depend on them.
#[derive(Clone, Debug, Default)]
pub(super) struct Moves {
    /// Positions at the last update.
    seen: Vec<Vec3>,
    /// Vertices that moved.
    moved: Vec<bool>,
    /// Faces with a corner that moved.
    faces: Vec<bool>,
    /// Corners of these faces.
    vertices: Vec<bool>,
}

impl Moves {
    /// Compares the film with the last update and returns whether anything moved. With `all` everything counts as
    /// moved.
    pub fn follow(&mut self, mesh: &FilmMesh, all: bool) -> bool {
        let (topology, positions) = (&mesh.topology, &mesh.geometry.positions);
        let Self { seen, moved, faces, vertices } = self;
        let all = all || seen.len() != positions.len();
        moved.clear();
        // Comparing all is quicker than keeping books of what moved.
        moved.extend(positions.iter().zip(seen.iter()).map(|(a, b)| (a.x != b.x) | (a.y != b.y) | (a.z != b.z)));
        if !all && !moved.contains(&true) {
            return false;
        }
        vertices.clear();
        vertices.resize(positions.len(), all);
        faces.clear();
        faces.resize(topology.face_count(), all);
        if !all {
            for f in topology.live_faces() {
                let corners = topology.corners(f).map(|v| v.index());
                if moved[corners[0]] | moved[corners[1]] | moved[corners[2]] {
                    faces[f.index()] = true;
                    corners.iter().for_each(|&v| vertices[v] = true);
                }
            }
        }
        seen.clear();
        seen.extend_from_slice(positions);
        true
    }

    /// Returns whether a corner of `f` moved.
    #[inline]
    pub fn has_moved(&self, f: FaceId) -> bool {
        self.faces[f.index()]
    }

    /// Returns whether `v` belongs to a face with a corner that moved.
    #[inline]
    pub fn is_turned(&self, v: VertexId) -> bool {
        self.vertices[v.index()]
    }
}
