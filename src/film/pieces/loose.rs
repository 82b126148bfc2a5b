//! The list of loose pieces.

use crate::film::{
    handles::{FaceId, VertexId},
    topology::Topology,
};

/// List of the loose pieces of a film, in the order of the lowest face of each.
///
/// A piece is a set of live faces that are joined across bound edges. It is loose if none of its vertices is attached.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoosePieces {
    faces: Vec<FaceId>,
    vertices: Vec<VertexId>,
    /// End of each piece in `faces` and in `vertices`; it starts where the piece before it ends.
    ends: Vec<(u32, u32)>,
    /// Number of faces of the smallest piece, `None` if there is no piece.
    smallest: Option<u32>,
}

/// Buffers for rebuilding the list, kept between steps.
#[derive(Clone, Debug, Default)]
pub(super) struct ListScratch {
    /// Pieces that have changed since the list was last rebuilt.
    pub fresh: LoosePieces,
    /// Pieces of the new list: the lowest face, whether the piece is in `fresh`, and its index there or in the old
    /// list.
    pub order: Vec<(FaceId, bool, u32)>,
    /// The new list while it is built.
    list: LoosePieces,
}

/// One loose piece of the film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoosePiece<'a> {
    /// Faces of the piece, in the order of a breadth-first search from the lowest.
    pub faces: &'a [FaceId],
    /// Vertices of the piece, each once, in an order that follows from that of the faces.
    pub vertices: &'a [VertexId],
}

impl LoosePieces {
    /// Returns the number of loose pieces.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Returns whether no piece is loose.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Iterates over the loose pieces, in the order of their lowest face.
    pub fn iter(&self) -> impl Iterator<Item = LoosePiece<'_>> {
        (0..self.len()).map(|i| self.piece(i))
    }

    /// Returns the number of faces of the smallest loose piece, or `None` if no piece is loose.
    pub fn smallest(&self) -> Option<u32> {
        self.smallest
    }

    /// Empties the list. Its memory is kept.
    pub(super) fn clear(&mut self) {
        self.faces.clear();
        self.vertices.clear();
        self.ends.clear();
        self.smallest = None;
    }

    /// Returns the piece at index `i` of the list.
    pub(super) fn piece(&self, i: usize) -> LoosePiece<'_> {
        let start = if i == 0 { (0, 0) } else { self.ends[i - 1] };
        let end = self.ends[i];
        LoosePiece {
            faces: &self.faces[start.0 as usize..end.0 as usize],
            vertices: &self.vertices[start.1 as usize..end.1 as usize],
        }
    }

    /// Appends a piece with these faces and finds its vertices.
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

    /// Rebuilds the list from the pieces that `scratch` names.
    pub(super) fn assemble(&mut self, scratch: &mut ListScratch) {
        let ListScratch { fresh, order, list } = scratch;
        order.sort_unstable();
        list.clear();
        for &(_, is_fresh, index) in order.iter() {
            list.append(if is_fresh { fresh.piece(index as usize) } else { self.piece(index as usize) });
        }
        core::mem::swap(self, list);
    }
}
