//! What one step has changed: written by the fracture stages, read by the stages after them and by display.

use bevy_math::Vec3;

use super::{
    edit::TearEnd,
    handles::{FaceId, HalfEdgeId, VertexId},
};

/// A piece of film that fell in this step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Debris {
    /// Mean of the piece's corners when it fell, in the film's space.
    pub position: Vec3,
    /// Mean of the face normals, weighted by area; unit length, or zero for a piece folded onto itself.
    pub normal: Vec3,
    /// Area of the piece at rest.
    pub area: f32,
    /// Number of faces.
    pub faces: u32,
}

/// Changes of one step, in the order they happened. Cleared at the start of each step; the buffers are kept.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component))]
pub struct FilmChanges {
    /// Vertices that separated.
    pub separated: Vec<VertexId>,
    /// One half-edge of each edge that tore.
    pub torn: Vec<HalfEdgeId>,
    /// What each of these tears did at the origin and the target of its half-edge.
    pub torn_ends: Vec<[TearEnd; 2]>,
    /// Vertices that tearing appended.
    pub duplicates: Vec<VertexId>,
    /// Faces that were stripped or fell.
    pub removed: Vec<FaceId>,
    /// Pieces that fell: stripped faces and loose pieces.
    pub debris: Vec<Debris>,
    /// Whether any vertex may have moved.
    pub moved: bool,
}

impl FilmChanges {
    /// Forgets everything, keeping the buffers.
    pub fn clear(&mut self) {
        self.separated.clear();
        self.torn.clear();
        self.torn_ends.clear();
        self.duplicates.clear();
        self.removed.clear();
        self.debris.clear();
        self.moved = false;
    }

    /// Whether connectivity or the state of a vertex changed, so that constraints and pieces must follow.
    pub fn fractured(&self) -> bool {
        !(self.separated.is_empty() && self.torn.is_empty() && self.removed.is_empty())
    }
}
