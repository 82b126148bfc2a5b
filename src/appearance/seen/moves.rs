//! Finds the vertices that have moved since the appearance was last brought up to date.

use bevy_math::Vec3;

use crate::film::{FilmMesh, VertexId};

/// Vertices that moved, and those whose directions depend on them.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Moves {
    /// Positions at the last update.
    seen: Vec<Vec3>,
    /// Whether each vertex moved.
    moved: Vec<bool>,
    /// Whether each vertex is in `vertices`.
    turned: Vec<bool>,
    /// Corners of faces with a corner that moved, and vertices that count as moved: each once.
    pub vertices: Vec<VertexId>,
}

impl Moves {
    /// Forgets the moves of the last update.
    pub fn clear(&mut self) {
        for v in self.vertices.drain(..) {
            self.turned[v.index()] = false;
        }
    }

    /// Compares the film with the last update and returns whether anything moved. `others` count as moved, and with
    /// `all` everything does.
    pub fn follow(&mut self, mesh: &FilmMesh, all: bool, others: impl Iterator<Item = VertexId>) -> bool {
        self.clear();
        let (topology, positions) = (&mesh.topology, &mesh.geometry.positions);
        let Self { seen, moved, turned, vertices } = self;
        // What is new was nowhere.
        seen.resize(positions.len(), Vec3::NAN);
        turned.resize(positions.len(), false);
        if all {
            seen.fill(Vec3::NAN);
        }
        moved.clear();
        // Comparing all is quicker than keeping books of what moved.
        moved.extend(positions.iter().zip(seen.iter()).map(|(a, b)| (a.x != b.x) | (a.y != b.y) | (a.z != b.z)));
        let mut turn = |v: VertexId| {
            if !std::mem::replace(&mut turned[v.index()], true) {
                vertices.push(v);
            }
        };
        others.for_each(&mut turn);
        if moved.contains(&true) {
            for f in topology.live_faces() {
                let corners = topology.corners(f);
                let [a, b, c] = corners.map(|v| moved[v.index()]);
                if a | b | c {
                    corners.iter().for_each(|&v| turn(v));
                }
            }
            seen.copy_from_slice(positions);
        }
        !vertices.is_empty()
    }

    /// Returns whether `v` belongs to a face with a corner that moved, or counts as moved.
    #[inline]
    pub fn is_turned(&self, v: VertexId) -> bool {
        self.turned[v.index()]
    }
}
