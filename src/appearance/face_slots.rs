//! Which slot each face belongs to and which way round it is shown.

use crate::{
    film::{FaceId, HalfEdgeId, Topology},
    fracture::FilmForces,
    remesh::BuiltFilm,
};

/// Slot and winding of each face.
#[derive(Clone, Debug)]
pub(super) struct FaceSlots {
    slots: Vec<u32>,
    flipped: Vec<bool>,
}

impl FaceSlots {
    pub fn new(built: &BuiltFilm, faces: usize) -> Self {
        let (mut slots, mut flipped) = (built.slots.clone(), built.flipped.clone());
        slots.resize(faces, 0);
        flipped.resize(faces, false);
        Self { slots, flipped }
    }

    pub fn slot_count(&self) -> usize {
        self.slots.iter().max().map_or(0, |&slot| slot as usize + 1)
    }

    pub fn slot(&self, f: FaceId) -> usize {
        self.slots[f.index()] as usize
    }

    pub fn is_flipped(&self, f: FaceId) -> bool {
        self.flipped[f.index()]
    }

    /// The corners of a face in the order in which it is shown: that of the prop's own triangle.
    pub fn corners(&self, f: FaceId) -> [HalfEdgeId; 3] {
        let [a, b, c] = f.half_edges();
        if self.is_flipped(f) { [a, c, b] } else { [a, b, c] }
    }
}

/// Whether any vertex of `f` has separated.
pub(super) fn has_separated(topology: &Topology, forces: &FilmForces, f: FaceId) -> bool {
    topology.corners(f).iter().any(|&v| !forces.is_attached(v))
}
