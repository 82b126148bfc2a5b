//! The film: a half-edge triangle mesh of the paint (VC 3.3).
//!
//! A [`FilmMesh`] has two parts: [`Topology`] says which faces are connected and stores no positions, and [`Geometry`]
//! stores positions and what is measured on them. The stages of the simulation keep their own flat arrays (forces,
//! constraints, stains), which the same [handles](HalfEdgeId) index.
//!
//! ```
//! use bevy_coating::film::FilmMesh;
//! use bevy_math::Vec3;
//!
//! // A unit square of two triangles.
//! let corners = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
//! let mut film = FilmMesh::new(corners, &[[0, 1, 2], [0, 2, 3]])?;
//!
//! // Tear the diagonal. Both of its ends lie on the border, so each end becomes two vertices.
//! let diagonal = film.topology.all_edges().find(|&h| film.topology.bound_twin(h).is_some()).unwrap();
//! assert!(film.tear(diagonal, Vec3::NEG_Y).is_some());
//! assert_eq!(film.topology.vertex_count(), 6);
//! # Ok::<(), bevy_coating::film::TopologyError>(())
//! ```

mod changes;
pub(crate) mod direction;
mod edit;
mod geometry;
mod handles;
mod mesh;
mod pieces;
mod topology;
mod validate;
pub(crate) mod words;

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
