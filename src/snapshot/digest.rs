//! Names the mesh of a film.

use crate::film::{FilmMesh, write_rest};

/// Number of bytes of a digest.
pub const DIGEST_BYTES: usize = 32;

/// Name of a film's mesh: the digest of its positions at rest and its triangles (BLAKE3), and their numbers. It stays
/// the same whatever becomes of the film.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MeshName {
    pub digest: [u8; DIGEST_BYTES],
    /// Number of vertices at rest and of triangles.
    pub counts: [u32; 2],
}

impl MeshName {
    /// Returns the name of `mesh`.
    #[expect(clippy::cast_possible_truncation, reason = "handles of vertices and faces have 32 bits")]
    pub fn of(mesh: &FilmMesh) -> Self {
        let mut bytes = Vec::with_capacity(12 * (mesh.topology.original_vertex_count() + mesh.topology.face_count()));
        write_rest(mesh, |part| bytes.extend_from_slice(part));
        let counts = [mesh.topology.original_vertex_count(), mesh.topology.face_count()].map(|count| count as u32);
        Self { digest: blake3::hash(&bytes).into(), counts }
    }
}
