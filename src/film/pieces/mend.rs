//! Keeps the pieces of the film up to date where it is mended: pieces grow together.

use super::{flood::bound_neighbours, loose::LoosePieces, track::FilmPieces};
use crate::film::{
    handles::{FaceId, VertexId},
    mend::Mend,
    pieces::flood::PieceScratch,
    topology::Topology,
};

/// Pieces that a mend touches, with those that grow together: each points to another one of them, or to itself.
struct Unions {
    ids: Vec<u32>,
    to: Vec<usize>,
}

impl Unions {
    fn new(mut ids: Vec<u32>) -> Self {
        ids.sort_unstable();
        ids.dedup();
        let to = (0..ids.len()).collect();
        Self { ids, to }
    }

    fn root(&self, id: u32) -> usize {
        // Every piece that is asked for is listed.
        let mut at = self.ids.partition_point(|&other| other < id);
        while self.to[at] != at {
            at = self.to[at];
        }
        at
    }

    fn unite(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        let (low, high) = (a.min(b), a.max(b));
        self.to[high] = low;
    }
}

impl FilmPieces {
    /// Records what was mended, and brings the list of loose pieces up to date. `was_attached` says of a vertex as it
    /// was whether the metal held it, `is_attached` of one as it is.
    pub(crate) fn mend(
        &mut self,
        topology: &Topology,
        mend: &Mend,
        loose: &mut LoosePieces,
        scratch: &mut PieceScratch,
        was_attached: impl Fn(VertexId) -> bool,
        is_attached: impl Fn(VertexId) -> bool,
    ) {
        for former in mend.before.iter().filter(|former| was_attached(former.vertex)) {
            self.attach(former.face, false);
        }
        for &f in &mend.came_back {
            self.begin_piece(f);
        }
        let at = mend.here.iter().filter_map(|&v| topology.fan(v).next()).map(|h| h.face());
        let touched: Vec<FaceId> = mend.faces.iter().copied().chain(at).collect();
        let mut unions = Unions::new(touched.iter().map(|&f| self.id(f)).collect());
        for &f in &mend.faces {
            for neighbour in bound_neighbours(topology, f) {
                unions.unite(self.id(f), self.id(neighbour));
            }
        }
        // Of those that grow together, the one that is held most takes the others in: it is likely to be the largest.
        let mut takers: Vec<u32> = unions.ids.clone();
        for (i, &id) in unions.ids.iter().enumerate() {
            let taker = &mut takers[unions.root(id)];
            if (self.attached(id), std::cmp::Reverse(id)) > (self.attached(*taker), std::cmp::Reverse(*taker)) {
                *taker = unions.ids[i];
            }
        }
        for &id in &unions.ids {
            let taker = takers[unions.root(id)];
            if taker != id {
                self.take_attached(id, taker);
            }
        }
        let mut faces = Vec::new();
        for &seed in &mend.faces {
            let taker = takers[unions.root(self.id(seed))];
            if self.id(seed) == taker {
                continue;
            }
            self.put(seed, taker);
            faces.push(seed);
            while let Some(f) = faces.pop() {
                for neighbour in bound_neighbours(topology, f) {
                    if self.id(neighbour) != taker {
                        self.put(neighbour, taker);
                        faces.push(neighbour);
                    }
                }
            }
        }
        for &v in mend.here.iter().filter(|&&v| is_attached(v)) {
            if let Some(h) = topology.fan(v).next() {
                self.attach(h.face(), true);
            }
        }
        // Their faces or the names of their vertices are others now.
        let is_touched = |this: &Self, f: FaceId| unions.ids.binary_search(&this.id(f)).is_ok();
        loose.retain(scratch, |lowest| !is_touched(self, lowest));
        self.list_again(topology, loose, scratch, &touched);
    }
}
