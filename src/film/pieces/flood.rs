//! Flood fills over live faces joined across bound edges.

use super::loose::ListScratch;
use crate::film::{
    handles::{FaceId, HalfEdgeId},
    topology::Topology,
};

/// Room for flood fills, kept between steps.
#[derive(Clone, Debug, Default)]
pub struct PieceScratch {
    /// The last flood that came over each face.
    marks: Vec<u32>,
    /// The last flood of all.
    last: u32,
    /// Faces of the last floods, in the order in which they came to them.
    floods: [Vec<FaceId>; 2],
    pub(super) lists: ListScratch,
}

impl PieceScratch {
    /// A mark that no face bears; nor does any bear the next higher one.
    pub(super) fn fresh_mark(&mut self, topology: &Topology) -> u32 {
        if self.marks.len() != topology.face_count() || self.last > u32::MAX - 2 {
            self.marks.clear();
            self.marks.resize(topology.face_count(), 0);
            self.last = 0;
        }
        self.last += 2;
        self.last
    }

    /// Whether `f` bears `mark`.
    pub(super) fn bears(&self, f: FaceId, mark: u32) -> bool {
        self.marks[f.index()] == mark
    }

    /// Marks all faces of the piece of `seed`, which must not bear `mark`, and gives them in flood order.
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

    /// Whether the tear of `edge` and its twin, both ends of which have split, cut a piece in two: then the faces of
    /// the smaller side, in flood order. `None` if both sides still hang together some other way.
    ///
    /// Looks at no more than about twice the smaller side, or than the shorter of the two borders that the tear
    /// joined. (Only a cut that opens a handle of the surface may take longer; there are never more such cuts than
    /// handles.)
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
        // One face of each side in turn, until a side has no more or comes to the other.
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

    /// Appends the piece of `lowest`, its lowest face, to those that go on the list anew.
    pub(super) fn list_piece(&mut self, topology: &Topology, lowest: FaceId) {
        let mark = self.fresh_mark(topology);
        self.flood(topology, lowest, mark);
        let ListScratch { fresh, order, .. } = &mut self.lists;
        order.push((lowest, true, fresh.len() as u32));
        fresh.push(topology, &self.floods[0]);
    }
}

/// Faces bound to `f`.
pub(super) fn bound_neighbours(topology: &Topology, f: FaceId) -> impl Iterator<Item = FaceId> + '_ {
    f.half_edges().into_iter().filter_map(|h| topology.bound_twin(h)).map(HalfEdgeId::face)
}

/// Whether the border of the piece left of one unbound half-edge leads to the other. Walks both in turn until one
/// comes to the other or is back.
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
