//! The list of loose pieces.

use crate::film::{
    handles::{FaceId, VertexId},
    topology::Topology,
};

/// The loose pieces of a film: live faces joined across bound edges, none of whose vertices is attached.
/// Pieces are in the order of their lowest face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoosePieces {
    faces: Vec<FaceId>,
    vertices: Vec<VertexId>,
    /// Ends of each piece in `faces` and `vertices`.
    ends: Vec<(u32, u32)>,
    /// Number of faces of the smallest piece.
    smallest: Option<u32>,
}

/// Room for a list that is put together anew.
#[derive(Clone, Debug, Default)]
pub(super) struct ListScratch {
    /// Pieces that have changed.
    pub fresh: LoosePieces,
    /// Lowest face of each piece of the list to be, whether it is one of `fresh`, and its place there or in the old list.
    pub order: Vec<(FaceId, bool, u32)>,
    /// The list to be.
    list: LoosePieces,
}

/// One loose piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoosePiece<'a> {
    /// Its faces, in the order of a flood from the lowest.
    pub faces: &'a [FaceId],
    /// Its vertices, in an order that follows from that of the faces.
    pub vertices: &'a [VertexId],
}

impl LoosePieces {
    /// Number of loose pieces.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether no piece is loose.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The loose pieces, in the order of their lowest face.
    pub fn iter(&self) -> impl Iterator<Item = LoosePiece<'_>> {
        (0..self.len()).map(|i| self.piece(i))
    }

    /// Number of faces of the smallest loose piece.
    pub fn smallest(&self) -> Option<u32> {
        self.smallest
    }

    /// Forgets all, keeping the buffers.
    pub(super) fn clear(&mut self) {
        self.faces.clear();
        self.vertices.clear();
        self.ends.clear();
        self.smallest = None;
    }

    pub(super) fn piece(&self, i: usize) -> LoosePiece<'_> {
        let start = if i == 0 { (0, 0) } else { self.ends[i - 1] };
        let end = self.ends[i];
        LoosePiece {
            faces: &self.faces[start.0 as usize..end.0 as usize],
            vertices: &self.vertices[start.1 as usize..end.1 as usize],
        }
    }

    /// Appends a piece of these faces.
    pub(super) fn push(&mut self, topology: &Topology, faces: &[FaceId]) {
        self.faces.extend_from_slice(faces);
        let corners = faces.iter().flat_map(|f| f.half_edges());
        self.vertices.extend(corners.filter(|&h| topology.starts_fan(h)).map(|h| topology.origin(h)));
        self.end_piece();
    }

    fn append(&mut self, piece: LoosePiece<'_>) {
        self.faces.extend_from_slice(piece.faces);
        self.vertices.extend_from_slice(piece.vertices);
        self.end_piece();
    }

    fn end_piece(&mut self) {
        let start = self.ends.last().map_or(0, |end| end.0);
        let faces = self.faces.len() as u32;
        self.ends.push((faces, self.vertices.len() as u32));
        self.smallest = Some(self.smallest.map_or(faces - start, |smallest| smallest.min(faces - start)));
    }

    /// Puts the list together anew from what `scratch` says of it.
    pub(super) fn assemble(&mut self, scratch: &mut ListScratch) {
        let ListScratch { fresh, order, list } = scratch;
        order.sort_unstable();
        list.clear();
        for &(_, is_fresh, place) in order.iter() {
            list.append(if is_fresh { fresh.piece(place as usize) } else { self.piece(place as usize) });
        }
        core::mem::swap(self, list);
    }
}
