//! Keeps the pieces of the film up to date, edit by edit.

use super::{
    flood::{PieceScratch, bound_neighbours},
    loose::LoosePieces,
};
use crate::film::{
    edit::TearEnd,
    handles::{FaceId, HalfEdgeId, VertexId},
    topology::Topology,
};

/// Index of no piece, for faces that have not been assigned one.
const NONE: u32 = u32::MAX;

/// Index from each face to its piece, with the number of attached vertices of each piece.
///
/// A piece is a set of live faces that are joined across bound edges. A tear can cut a piece in two only if both of its
/// ends split, and then only the faces of the smaller side are visited. An attached vertex belongs to one piece, since
/// its faces form one fan.
///
/// ```
/// use bevy_coating::film::{FilmPieces, LoosePieces, PieceScratch, Topology, VertexId};
///
/// let topology = Topology::from_triangles(6, &[[0, 1, 2], [3, 4, 5]])?;
/// let is_attached = |v| v == VertexId(3);
/// let (mut loose, mut scratch) = (LoosePieces::default(), PieceScratch::default());
/// let mut pieces = FilmPieces::new(&topology, |v| v.0 < 4);
///
/// for v in [VertexId(0), VertexId(1), VertexId(2)] {
///     pieces.vertex_separated(&topology, v);
/// }
/// pieces.renew(&topology, &mut loose, &mut scratch);
/// assert_eq!(loose.len(), 1);
/// assert!(pieces.agrees(&topology, &loose, is_attached));
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct FilmPieces {
    /// Index of the piece of each face. The entries of removed faces mean nothing.
    of: Vec<u32>,
    pieces: Vec<Piece>,
    /// One face of each piece that came loose, or changed while loose, since the list of loose pieces was last brought
    /// up to date.
    changed: Vec<FaceId>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Piece {
    /// Number of attached vertices.
    attached: u32,
    /// Whether the list of loose pieces must get this piece again. Only used while that list is brought up to date.
    stale: bool,
}

impl FilmPieces {
    /// Finds all pieces of a film. `is_attached` says whether a vertex is attached to the metal.
    ///
    /// The next [`renew`](Self::renew) lists all loose pieces, so its list must be empty.
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

    /// Returns whether every face of `topology` has an entry. This is false for the default value, unless the film is
    /// empty.
    pub fn fits(&self, topology: &Topology) -> bool {
        self.of.len() == topology.face_count()
    }

    /// Returns the number of attached vertices of the piece of `f`, which must be live.
    pub fn attached_of(&self, f: FaceId) -> u32 {
        self.pieces[self.of[f.index()] as usize].attached
    }

    /// Records that `v`, which was attached until now, has separated.
    pub fn vertex_separated(&mut self, topology: &Topology, v: VertexId) {
        let Some(h) = topology.fan(v).next() else { return };
        let piece = self.piece_mut(h.face());
        piece.attached = piece.attached.saturating_sub(1);
        self.note(h.face());
    }

    /// Records that `v`, which had separated from a piece that is held elsewhere, is attached again.
    pub fn vertex_attached(&mut self, topology: &Topology, v: VertexId) {
        if let Some(h) = topology.fan(v).next() {
            self.piece_mut(h.face()).attached += 1;
        }
    }

    /// Records that `edge` has torn. `ends` is what the tear did to its two ends, and `is_attached` says whether a
    /// vertex is attached to the metal.
    pub fn edge_torn(
        &mut self,
        topology: &Topology,
        edge: HalfEdgeId,
        ends: &[TearEnd; 2],
        scratch: &mut PieceScratch,
        is_attached: impl Fn(VertexId) -> bool,
    ) {
        let Some(twin) = topology.rest_twin(edge) else { return };
        // Where an end has only opened, the two faces are still connected around it.
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

    /// Returns the index of the piece of `f`, which must be live.
    pub(super) fn id(&self, f: FaceId) -> u32 {
        self.of[f.index()]
    }

    /// Puts `f` into the piece at index `id`.
    pub(super) fn put(&mut self, f: FaceId, id: u32) {
        self.of[f.index()] = id;
    }

    /// Makes `f` a piece of its own, which nothing holds.
    pub(super) fn begin_piece(&mut self, f: FaceId) {
        self.put(f, self.pieces.len() as u32);
        self.pieces.push(Piece::default());
    }

    /// Returns the number of attached vertices of the piece at index `id`.
    pub(super) fn attached(&self, id: u32) -> u32 {
        self.pieces[id as usize].attached
    }

    /// Counts one attached vertex more in the piece of `f`, or one less.
    pub(super) fn attach(&mut self, f: FaceId, is_attached: bool) {
        let attached = &mut self.piece_mut(f).attached;
        *attached = if is_attached { *attached + 1 } else { attached.saturating_sub(1) };
    }

    /// Counts the attached vertices of the piece at index `id` as those of `taker`.
    pub(super) fn take_attached(&mut self, id: u32, taker: u32) {
        let taken = core::mem::take(&mut self.pieces[id as usize].attached);
        self.pieces[taker as usize].attached += taken;
    }

    /// Puts the pieces of `faces` into the list of loose pieces, from which they were taken, where they are loose.
    pub(super) fn list_again(
        &mut self,
        topology: &Topology,
        loose: &mut LoosePieces,
        scratch: &mut PieceScratch,
        faces: &[FaceId],
    ) {
        self.changed.retain(|&f| topology.is_live(f));
        // New paint may hold by now what had come loose.
        let mut changed = core::mem::take(&mut self.changed);
        changed.retain(|&f| self.attached_of(f) == 0);
        self.changed = changed;
        faces.iter().for_each(|&f| self.note(f));
        self.renew(topology, loose, scratch);
    }

    /// Brings the list of loose pieces up to date.
    ///
    /// Pieces that tears and separations changed are searched again; the others are copied. A piece that was removed
    /// without such a change is dropped by [`LoosePieces::retain_live`].
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
            // Pieces only get smaller, so this is still the lowest face of its piece.
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

    /// Notes that the piece of `f` has changed, if it is loose.
    fn note(&mut self, f: FaceId) {
        if self.piece_mut(f).attached == 0 {
            self.changed.push(f);
        }
    }

    fn piece_mut(&mut self, f: FaceId) -> &mut Piece {
        &mut self.pieces[self.of[f.index()] as usize]
    }

    /// Returns whether these pieces are those that a search of the whole film finds. The list of loose pieces is
    /// compared too, unless it still waits for [`renew`](Self::renew). Meant for tests and debugging.
    pub fn agrees(
        &self,
        topology: &Topology,
        loose: &LoosePieces,
        is_attached: impl Fn(VertexId) -> bool + Copy,
    ) -> bool {
        let mut listed = LoosePieces::default();
        let pieces = listed.find(topology, &mut PieceScratch::default(), is_attached);
        let found = Self::new(topology, is_attached);
        // The indices of pieces may differ, but each index here must match exactly one there.
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

/// Returns the number of attached vertices of a piece, given all its faces.
fn count_attached(topology: &Topology, faces: &[FaceId], is_attached: impl Fn(VertexId) -> bool) -> u32 {
    let corners = faces.iter().flat_map(|f| f.half_edges());
    corners.filter(|&h| topology.starts_fan(h) && is_attached(topology.origin(h))).count() as u32
}
