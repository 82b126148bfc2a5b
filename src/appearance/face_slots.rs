//! Tells which slot each face belongs to, and in which winding its triangle is drawn.

use std::sync::Arc;

use crate::{
    film::{FaceId, Topology},
    fracture::FilmForces,
    remesh::BuiltFilm,
};

/// Slot (primitive of the prop) and winding of each face.
#[derive(Clone, Debug)]
pub(super) struct FaceSlots {
    slots: Arc<[u32]>,
    flipped: Arc<[bool]>,
    /// Whether each slot is hidden.
    hidden: Vec<bool>,
}

impl FaceSlots {
    /// Copies the slots and windings of `built` for `faces` faces. Faces that `built` does not list are in slot 0 and
    /// not flipped.
    pub fn new(built: &BuiltFilm, faces: usize) -> Self {
        let (mut slots, mut flipped) = (built.slots.clone(), built.flipped.clone());
        slots.resize(faces, 0);
        flipped.resize(faces, false);
        let count = slots.iter().max().map_or(0, |&slot| slot as usize + 1);
        Self { slots: slots.into(), flipped: flipped.into(), hidden: vec![false; count] }
    }

    /// Returns the number of slots: the highest slot of a face and one.
    pub fn slot_count(&self) -> usize {
        self.hidden.len()
    }

    /// Hides the faces of slot `slot` for good.
    pub fn hide(&mut self, slot: usize) {
        if let Some(hidden) = self.hidden.get_mut(slot) {
            *hidden = true;
        }
    }

    /// Hides the slots that `other` hides, and returns whether any was not hidden before.
    pub fn hide_as(&mut self, other: &Self) -> bool {
        let mut news = false;
        for (own, &other) in self.hidden.iter_mut().zip(&other.hidden) {
            news |= other && !*own;
            *own |= other;
        }
        news
    }

    /// Returns whether each face is in a slot that is hidden.
    pub fn hidden_faces(&self) -> Vec<bool> {
        self.slots.iter().map(|&slot| self.hidden[slot as usize]).collect()
    }

    /// Returns whether `f` is in a slot that is hidden.
    pub fn is_hidden(&self, f: FaceId) -> bool {
        self.hidden[self.slot(f)]
    }

    /// Returns the slot of `f`.
    pub fn slot(&self, f: FaceId) -> usize {
        self.slots[f.index()] as usize
    }

    /// Returns whether two faces have the same slot and winding.
    pub fn are_alike(&self, f: FaceId, g: FaceId) -> bool {
        self.slot(f) == self.slot(g) && self.is_flipped(f) == self.is_flipped(g)
    }

    /// Returns whether `f` runs against the winding of the prop's own triangles.
    pub fn is_flipped(&self, f: FaceId) -> bool {
        self.flipped[f.index()]
    }
}

/// Returns whether any vertex of `f` has separated.
pub(super) fn has_separated(topology: &Topology, forces: &FilmForces, f: FaceId) -> bool {
    topology.corners(f).iter().any(|&v| !forces.is_attached(v))
}
