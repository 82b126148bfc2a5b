//! The film: a half-edge triangle mesh of the paint (VC 3.3).

pub mod build;
pub mod handles;

pub use handles::{FaceId, HalfEdgeId, VertexId};
