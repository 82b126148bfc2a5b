//! The film: a half-edge triangle mesh of the paint (VC 3.3).
//!
//! A [`FilmMesh`] has two parts: [`Topology`] says which faces are connected and stores no positions, and [`Geometry`]
//! stores positions and what is measured on them. The stages of the simulation keep their own flat arrays (forces,
//! constraints, stains), which the same [handles](HalfEdgeId) index.
//! Whatever tears or removes anything keeps all of them in step: the stages of a step, or from outside
//! [`FilmState::tear_edge`](crate::sim::FilmState::tear_edge) and
//! [`FilmState::strip_face`](crate::sim::FilmState::strip_face).
//!
//! ```
//! use bevy_coating::film::FilmMesh;
//! use bevy_math::Vec3;
//!
//! // A unit square of two triangles.
//! let corners = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
//! let film = FilmMesh::new(corners, &[[0, 1, 2], [0, 2, 3]])?;
//!
//! // Only the diagonal lies between two faces.
//! let inner: Vec<_> = film.topology.all_edges().filter(|&h| film.topology.bound_twin(h).is_some()).collect();
//! assert_eq!(inner.len(), 1);
//! assert_eq!(film.geometry.rest_lengths[inner[0].index()], 2f32.sqrt());
//! # Ok::<(), bevy_coating::film::TopologyError>(())
//! ```

mod changes;
pub(crate) mod direction;
mod edit;
mod face_grid;
mod geometry;
mod grain;
mod handles;
mod mend;
mod mesh;
mod pieces;
mod renew;
mod repaint;
pub(crate) mod rotation;
mod saved;
mod topology;
mod validate;
pub(crate) mod words;

pub use changes::{Debris, FilmChanges};
pub use edit::TearEnd;
pub use face_grid::FaceGrid;
pub use geometry::{Geometry, signed_dihedral};
pub use grain::Grain;
pub use handles::{FaceId, HalfEdgeId, VertexId};
pub(crate) use mend::Mend;
pub use mesh::FilmMesh;
pub use pieces::{FilmPieces, LoosePiece, LoosePieces, PieceScratch};
pub(crate) use renew::{Origin, Renewal};
pub(crate) use repaint::Repaint;
pub(crate) use saved::write_rest;
pub use topology::{FaceFate, Fan, Topology, TopologyError};
pub use validate::InvariantError;

#[cfg(test)]
pub(crate) mod tests;
