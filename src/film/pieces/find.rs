//! Finds the loose pieces of a whole film, and drops removed ones from their list.

use super::{
    flood::PieceScratch,
    loose::{ListScratch, LoosePieces},
};
use crate::film::{
    handles::{FaceId, VertexId},
    topology::Topology,
};

impl LoosePieces {
    /// Searches the whole film and replaces the list by the loose pieces found. Returns the number of all pieces,
    /// including attached ones.
    ///
    /// `is_attached` says whether a vertex is attached to the metal. The time is proportional to the size of the film.
    ///
    /// ```
    /// use bevy_coating::film::{LoosePieces, PieceScratch, Topology, VertexId};
    ///
    /// // Only vertex 3 is attached: the face without it is loose.
    /// let topology = Topology::from_triangles(6, &[[0, 1, 2], [3, 4, 5]])?;
    /// let mut loose = LoosePieces::default();
    /// let pieces = loose.find(&topology, &mut PieceScratch::default(), |v| v == VertexId(3));
    /// assert_eq!((pieces, loose.len(), loose.smallest()), (2, 1, Some(1)));
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn find(
        &mut self,
        topology: &Topology,
        scratch: &mut PieceScratch,
        is_attached: impl Fn(VertexId) -> bool,
    ) -> usize {
        self.clear();
        let mark = scratch.fresh_mark(topology);
        let mut pieces = 0;
        for seed in topology.live_faces() {
            if scratch.bears(seed, mark) {
                continue;
            }
            pieces += 1;
            let faces = scratch.flood(topology, seed, mark);
            if !faces.iter().any(|&f| topology.corners(f).into_iter().any(&is_attached)) {
                self.push(topology, faces);
            }
        }
        pieces
    }

    /// Drops the pieces whose faces have been removed from the list.
    pub fn retain_live(&mut self, topology: &Topology, scratch: &mut PieceScratch) {
        self.retain(scratch, |lowest| topology.is_live(lowest));
    }

    /// Drops the pieces from the list whose lowest face does not meet `stays`.
    pub(super) fn retain(&mut self, scratch: &mut PieceScratch, stays: impl Fn(FaceId) -> bool) {
        let ListScratch { order, .. } = &mut scratch.lists;
        order.clear();
        for (i, piece) in self.iter().enumerate() {
            if let Some(&lowest) = piece.faces.first().filter(|&&f| stays(f)) {
                order.push((lowest, false, i as u32));
            }
        }
        self.assemble(&mut scratch.lists);
    }
}
