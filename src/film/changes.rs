//! The record of one step: the fracture stages write it, the stages after them and the display read it.

use bevy_math::Vec3;

use super::{
    edit::TearEnd,
    handles::{FaceId, HalfEdgeId, VertexId},
};

/// A piece of film that fell off in one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Debris {
    /// Mean position of the corners of the piece's faces when it fell, in the film's space.
    pub position: Vec3,
    /// Mean normal of the piece's faces, weighted by area. It has unit length, or is zero if the normals cancel out.
    pub normal: Vec3,
    /// Rest area of the piece, in square units of the film's space.
    pub area: f32,
    /// Number of faces of the piece.
    pub faces: u32,
    /// Lowest face of the piece.
    pub face: FaceId,
}

/// Changes of one step. Each list is in the order in which its changes happened.
///
/// The record is cleared at the start of each step.
///
/// ```
/// use bevy_coating::film::{FilmChanges, VertexId};
///
/// let mut changes = FilmChanges::default();
/// assert!(!changes.fractured());
/// changes.separated.push(VertexId(3));
/// assert!(changes.fractured());
/// changes.clear();
/// assert_eq!(changes, FilmChanges::default());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component), component(clone_behavior = Ignore))]
pub struct FilmChanges {
    /// Vertices that separated from the metal (VC 5.1).
    pub separated: Vec<VertexId>,
    /// Edges that tore (VC 5.2), one half-edge for each.
    pub torn: Vec<HalfEdgeId>,
    /// Ends of the torn edges, one entry for each of [`torn`](Self::torn): the effect of the tear on the origin and on
    /// the target of its half-edge.
    pub torn_ends: Vec<[TearEnd; 2]>,
    /// Vertices that tearing added, duplicates of the vertices at which fans of faces parted.
    pub duplicates: Vec<VertexId>,
    /// Faces that were stripped (VC 5.3) or fell with a loose piece.
    pub removed: Vec<FaceId>,
    /// Pieces that fell: each stripped face by itself, and loose pieces.
    pub debris: Vec<Debris>,
    /// Vertices that had separated and that new paint attached again, between two steps.
    pub attached: Vec<VertexId>,
    /// Whether any vertex may have moved in this step.
    pub moved: bool,
}

impl FilmChanges {
    /// Empties the record. The memory of the lists is kept for the next step.
    pub fn clear(&mut self) {
        self.separated.clear();
        self.torn.clear();
        self.torn_ends.clear();
        self.duplicates.clear();
        self.removed.clear();
        self.debris.clear();
        self.attached.clear();
        self.moved = false;
    }

    /// Appends what an edit between two steps changed.
    pub fn append(&mut self, mut edit: Self) {
        self.separated.append(&mut edit.separated);
        self.torn.append(&mut edit.torn);
        self.torn_ends.append(&mut edit.torn_ends);
        self.duplicates.append(&mut edit.duplicates);
        self.removed.append(&mut edit.removed);
        self.debris.append(&mut edit.debris);
        self.attached.append(&mut edit.attached);
        self.moved |= edit.moved;
    }

    /// Returns whether a vertex separated, an edge tore or a face was removed. Constraints and pieces must then be
    /// brought up to date.
    pub fn fractured(&self) -> bool {
        !(self.separated.is_empty() && self.torn.is_empty() && self.removed.is_empty())
    }
}
