//! Searches of pieces: breadth-first, over live faces that are joined across bound edges.

use super::loose::ListScratch;
use crate::film::{
    handles::{FaceId, HalfEdgeId},
    topology::Topology,
};

/// Buffers for searches of pieces. Keep them between steps to save allocations; the default is empty.
#[derive(Clone, Debug, Default)]
pub struct PieceScratch {
    /// Mark of the last search that visited each face.
    marks: Vec<u32>,
    /// Highest mark that was given out.
    last: u32,
    /// Faces that the last searches visited, in that order.
    floods: [Vec<FaceId>; 2],
    pub(super) lists: ListScratch,
}

impl PieceScratch {
    /// Returns a mark that no face bears. No face bears the next higher one either.
    pub(super) fn fresh_mark(&mut self, topology: &Topology) -> u32 {
        if self.marks.len() != topology.face_count() || self.last > u32::MAX - 2 {
            self.marks.clear();
            self.marks.resize(topology.face_count(), 0);
            self.last = 0;
        }
        self.last += 2;
        self.last
    }

    /// Returns whether `f` bears `mark`.
    pub(super) fn bears(&self, f: FaceId, mark: u32) -> bool {
        self.marks[f.index()] == mark
    }

    /// Marks all faces of the piece of `seed`, which must not bear `mark`, and returns them in the order of the search.
    pub(super) fn flood(&mut self, topology: &Topology, seed: FaceId, mark: u32) -> &[FaceId] {
        let faces = &mut self.floods[0];
        faces.clear();
        faces.push(seed);
        self.marks[seed.index()] = mark;
        let mut next = 0;
        while let Some(&f) = faces.get(next) {
            next += 1;
            for neighbour in bound_neighbours(topology, f) {
                if self.marks[neighbour.index()] != mark {
                    self.marks[neighbour.index()] = mark;
                    faces.push(neighbour);
                }
            }
        }
        faces
    }

    /// Returns the faces of the piece of `seed`, in the order of a breadth-first search.
    pub fn piece_of(&mut self, topology: &Topology, seed: FaceId) -> &[FaceId] {
        let mark = self.fresh_mark(topology);
        self.flood(topology, seed, mark)
    }

    /// Returns the faces of the smaller side, in the order of the search, if the tear of `edge` and its twin cut a
    /// piece in two. Returns `None` if both sides are still connected some other way. Both ends of the edge must have
    /// split.
    ///
    /// The search visits at most about twice the faces of the smaller side, or the half-edges of the shorter of the two
    /// borders that the tear joined. Only a cut through a handle of the surface (as of a torus) may take longer, and
    /// there are never more such cuts than handles.
    pub(super) fn cut_off(&mut self, topology: &Topology, edge: HalfEdgeId, twin: HalfEdgeId) -> Option<&[FaceId]> {
        if on_one_border(topology, edge, twin) {
            return None;
        }
        let mark = self.fresh_mark(topology);
        let marks = [mark, mark + 1];
        for (side, seed) in [edge.face(), twin.face()].into_iter().enumerate() {
            self.floods[side].clear();
            self.floods[side].push(seed);
            self.marks[seed.index()] = marks[side];
        }
        // Each side visits one face in turn, until one of them has no more faces or meets the other.
        let mut next = 0;
        loop {
            for side in 0..2 {
                let Some(&f) = self.floods[side].get(next) else { return Some(&self.floods[side]) };
                for neighbour in bound_neighbours(topology, f) {
                    let mark = &mut self.marks[neighbour.index()];
                    if *mark == marks[1 - side] {
                        return None;
                    }
                    if *mark != marks[side] {
                        *mark = marks[side];
                        self.floods[side].push(neighbour);
                    }
                }
            }
            next += 1;
        }
    }

    /// Appends the piece whose lowest face is `lowest` to the pieces that have changed.
    pub(super) fn list_piece(&mut self, topology: &Topology, lowest: FaceId) {
        let mark = self.fresh_mark(topology);
        self.flood(topology, lowest, mark);
        let ListScratch { fresh, order, .. } = &mut self.lists;
        order.push((lowest, true, fresh.len() as u32));
        fresh.push(topology, &self.floods[0]);
    }
}

/// Iterates over the faces that are bound to `f`.
pub(super) fn bound_neighbours(topology: &Topology, f: FaceId) -> impl Iterator<Item = FaceId> + '_ {
    f.half_edges().into_iter().filter_map(|h| topology.bound_twin(h)).map(HalfEdgeId::face)
}

/// Returns whether two half-edges that are bound to no twin lie on the same loop of border. Walks from both in turn
/// until a walk meets the other half-edge or returns to its own.
fn on_one_border(topology: &Topology, a: HalfEdgeId, b: HalfEdgeId) -> bool {
    let mut walks = [a, b];
    loop {
        for walk in &mut walks {
            *walk = topology.next_on_border(*walk);
        }
        let [from_a, from_b] = walks;
        if from_a == b || from_b == a {
            return true;
        }
        if from_a == a || from_b == b {
            return false;
        }
    }
}
