//! Finds the vertices that have moved from where they are shown.

use bevy_math::Vec3;

use crate::film::{FilmMesh, VertexId};

/// Vertices that moved, and those whose directions depend on them.
///
/// A vertex is shown where it was when it last counted as moved, so that slow moves add up.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Moves {
    /// Positions at which the vertices are shown.
    shown: Vec<Vec3>,
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

    /// Compares the film with how it is shown and returns whether anything moved. A vertex counts as moved when it is
    /// further than `tolerance` metres from where it is shown, along any axis. `others` count as moved, too, and with
    /// `all` everything does.
    pub fn follow(
        &mut self,
        mesh: &FilmMesh,
        all: bool,
        tolerance: f32,
        others: impl Iterator<Item = VertexId>,
    ) -> bool {
        self.clear();
        let (topology, positions) = (&mesh.topology, &mesh.geometry.positions);
        let Self { shown, moved, turned, vertices } = self;
        // What is new was nowhere.
        shown.resize(positions.len(), Vec3::NAN);
        turned.resize(positions.len(), false);
        if all {
            shown.fill(Vec3::NAN);
        }
        moved.clear();
        // Comparing all is quicker than keeping books of what moved. What is not a number is far from everything.
        let is_far = |a: f32, b: f32| !((a - b).abs() <= tolerance);
        let far = |(a, b): (&Vec3, &Vec3)| is_far(a.x, b.x) | is_far(a.y, b.y) | is_far(a.z, b.z);
        moved.extend(positions.iter().zip(shown.iter()).map(far));
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
            for ((shown, &position), &moved) in shown.iter_mut().zip(positions).zip(moved.iter()) {
                if moved {
                    *shown = position;
                }
            }
        }
        !vertices.is_empty()
    }

    /// Returns the positions at which the vertices are shown.
    #[inline]
    pub fn positions(&self) -> &[Vec3] {
        &self.shown
    }

    /// Returns whether `v` belongs to a face with a corner that moved, or counts as moved.
    #[inline]
    pub fn is_turned(&self, v: VertexId) -> bool {
        self.turned[v.index()]
    }
}
