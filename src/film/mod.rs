//! The film: a half-edge triangle mesh of the paint (VC 3.3).
//!
//! [`Topology`] knows no positions, [`Geometry`] knows no connectivity. Both together are the
//! [`FilmMesh`]. Per-element quantities of the stages (forces, constraints, stains) are flat arrays of their
//! own, indexed by the same handles.

mod changes;
mod edit;
mod geometry;
mod handles;
mod mesh;
mod pieces;
mod topology;
mod validate;

pub use changes::{Debris, FilmChanges};
pub use edit::TearEnd;
pub use geometry::{Geometry, signed_dihedral};
pub use handles::{FaceId, HalfEdgeId, VertexId};
pub use mesh::FilmMesh;
pub use pieces::{FilmPieces, LoosePiece, LoosePieces, PieceScratch};
pub use topology::{FaceFate, Fan, Topology, TopologyError};
pub use validate::InvariantError;

#[cfg(test)]
pub(crate) mod tests;
