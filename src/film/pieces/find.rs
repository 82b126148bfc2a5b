//! Finds the loose pieces of a whole film, and drops removed ones from their list.

use super::{
    flood::PieceScratch,
    loose::{ListScratch, LoosePieces},
};
use crate::film::{handles::VertexId, topology::Topology};

impl LoosePieces {
    /// Finds all pieces anew and keeps the loose ones. Gives the number of pieces, attached ones included. Takes time
    /// proportional to the film's size.
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

    /// Takes pieces whose faces have been removed off the list.
    pub fn retain_live(&mut self, topology: &Topology, scratch: &mut PieceScratch) {
        let ListScratch { order, .. } = &mut scratch.lists;
        order.clear();
        for (i, piece) in self.iter().enumerate() {
            if let Some(&lowest) = piece.faces.first().filter(|&&f| topology.is_live(f)) {
                order.push((lowest, false, i as u32));
            }
        }
        self.assemble(&mut scratch.lists);
    }
}
