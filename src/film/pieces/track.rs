//! Pieces kept up to date, edit by edit.

use super::{
    flood::{PieceScratch, bound_neighbours},
    loose::LoosePieces,
};
use crate::film::{
    edit::TearEnd,
    handles::{FaceId, HalfEdgeId, VertexId},
    topology::Topology,
};

/// Piece of a face that is in none.
const NONE: u32 = u32::MAX;

/// Which piece each face belongs to, and how much of each piece still holds on.
///
/// Pieces are live faces joined across bound edges. A tear can cut one in two only where both of its ends split, and
/// then only the smaller side is looked at; an attached vertex belongs to one piece, as its faces are one fan.
#[derive(Clone, Debug, Default)]
pub struct FilmPieces {
    /// Piece of each face; says nothing of removed faces.
    of: Vec<u32>,
    pieces: Vec<Piece>,
    /// Faces of pieces that came loose, or changed while loose, since the list of loose pieces was last renewed.
    changed: Vec<FaceId>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Piece {
    /// Number of attached vertices.
    attached: u32,
    /// Whether the list of loose pieces does not have it as it is. Used by the renewal of the list alone.
    stale: bool,
}

impl FilmPieces {
    /// Finds all pieces of a film. All that are loose count as changed: the list of loose pieces is to be empty.
    pub fn new(topology: &Topology, is_attached: impl Fn(VertexId) -> bool) -> Self {
        let mut found = Self { of: vec![NONE; topology.face_count()], ..Self::default() };
        let mut faces = Vec::new();
        for seed in topology.live_faces() {
            if found.of[seed.index()] != NONE {
                continue;
            }
            let id = found.pieces.len() as u32;
            found.of[seed.index()] = id;
            faces.clear();
            faces.push(seed);
            let mut next = 0;
            while let Some(&f) = faces.get(next) {
                next += 1;
                for neighbour in bound_neighbours(topology, f) {
                    if found.of[neighbour.index()] == NONE {
                        found.of[neighbour.index()] = id;
                        faces.push(neighbour);
                    }
                }
            }
            let attached = count_attached(topology, &faces, &is_attached);
            found.pieces.push(Piece { attached, stale: false });
            found.note(seed);
        }
        found
    }

    /// Whether there is a piece for each face of `topology`: not so of the default, unless the film is empty.
    pub fn fits(&self, topology: &Topology) -> bool {
        self.of.len() == topology.face_count()
    }

    /// Follows the separation of `v`, which was attached until now.
    pub fn vertex_separated(&mut self, topology: &Topology, v: VertexId) {
        let Some(h) = topology.fan(v).next() else { return };
        let piece = self.piece_mut(h.face());
        piece.attached = piece.attached.saturating_sub(1);
        self.note(h.face());
    }

    /// Follows the tear of `edge`, which did `ends` to its ends.
    pub fn edge_torn(
        &mut self,
        topology: &Topology,
        edge: HalfEdgeId,
        ends: &[TearEnd; 2],
        scratch: &mut PieceScratch,
        is_attached: impl Fn(VertexId) -> bool,
    ) {
        let Some(twin) = topology.rest_twin(edge) else { return };
        // The faces still hang together around an end that has opened.
        let split = ends.iter().all(|end| matches!(end, TearEnd::Split { .. }));
        if split && let Some(side) = scratch.cut_off(topology, edge, twin) {
            let attached = count_attached(topology, side, is_attached);
            let whole = self.piece_mut(edge.face());
            whole.attached = whole.attached.saturating_sub(attached);
            let id = self.pieces.len() as u32;
            self.pieces.push(Piece { attached, stale: false });
            for f in side {
                self.of[f.index()] = id;
            }
        }
        self.note(edge.face());
        if self.of[edge.face().index()] != self.of[twin.face().index()] {
            self.note(twin.face());
        }
    }

    /// Brings the list of loose pieces up to date. Looks at those pieces that tears and separations changed, and copies
    /// the others; pieces that were removed without such a change are to be taken off by
    /// [`LoosePieces::retain_live`].
    pub fn renew(&mut self, topology: &Topology, loose: &mut LoosePieces, scratch: &mut PieceScratch) {
        if self.changed.is_empty() {
            return;
        }
        self.changed.retain(|&f| topology.is_live(f));
        for i in 0..self.changed.len() {
            self.piece_mut(self.changed[i]).stale = true;
        }
        scratch.lists.fresh.clear();
        scratch.lists.order.clear();
        for (i, piece) in loose.iter().enumerate() {
            let Some(&lowest) = piece.faces.first() else { continue };
            if !topology.is_live(lowest) {
                continue;
            }
            // Pieces only get smaller, so what has this face still has it as the lowest.
            if core::mem::take(&mut self.piece_mut(lowest).stale) {
                scratch.list_piece(topology, lowest);
            } else {
                scratch.lists.order.push((lowest, false, i as u32));
            }
        }
        for i in 0..self.changed.len() {
            let seed = self.changed[i];
            if core::mem::take(&mut self.piece_mut(seed).stale) {
                let mark = scratch.fresh_mark(topology);
                let faces = scratch.flood(topology, seed, mark);
                let lowest = faces.iter().copied().min().unwrap_or(seed);
                scratch.list_piece(topology, lowest);
            }
        }
        self.changed.clear();
        loose.assemble(&mut scratch.lists);
    }

    /// Remembers to list the piece of `f` anew if it is loose.
    fn note(&mut self, f: FaceId) {
        if self.piece_mut(f).attached == 0 {
            self.changed.push(f);
        }
    }

    fn piece_mut(&mut self, f: FaceId) -> &mut Piece {
        &mut self.pieces[self.of[f.index()] as usize]
    }

    /// Whether this and the list of loose pieces, unless it is to be renewed, are what a look at the whole film finds.
    pub fn agrees(
        &self,
        topology: &Topology,
        loose: &LoosePieces,
        is_attached: impl Fn(VertexId) -> bool + Copy,
    ) -> bool {
        let mut listed = LoosePieces::default();
        let pieces = listed.find(topology, &mut PieceScratch::default(), is_attached);
        let found = Self::new(topology, is_attached);
        // Names differ, but each of one side must have one of the other.
        let names = |f: FaceId| Some((found.of.get(f.index())?, self.of.get(f.index())?));
        let mut pairs: Vec<_> = topology.live_faces().filter_map(names).collect();
        pairs.sort_unstable();
        pairs.dedup();
        let mut mine: Vec<_> = pairs.iter().map(|pair| pair.1).collect();
        mine.sort_unstable();
        mine.dedup();
        let attached = |pieces: &[Piece], id: u32| pieces.get(id as usize).map(|piece| piece.attached);
        self.fits(topology)
            && [pairs.len(), mine.len()] == [pieces; 2]
            && pairs.iter().all(|&(&its, &mine)| attached(&found.pieces, its) == attached(&self.pieces, mine))
            && (listed == *loose || !self.changed.is_empty())
    }
}

/// Number of attached vertices of a whole piece.
fn count_attached(topology: &Topology, faces: &[FaceId], is_attached: impl Fn(VertexId) -> bool) -> u32 {
    let corners = faces.iter().flat_map(|f| f.half_edges());
    corners.filter(|&h| topology.starts_fan(h) && is_attached(topology.origin(h))).count() as u32
}
