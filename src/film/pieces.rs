//! Connected pieces of the film, and which of them hang in the air.

use super::{FaceId, Topology, VertexId};

/// The loose pieces of a film: live faces joined across bound edges, none of whose vertices is attached.
/// Pieces are in the order of their lowest face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LoosePieces {
    faces: Vec<FaceId>,
    vertices: Vec<VertexId>,
    /// Ends of each piece in `faces` and `vertices`.
    ends: Vec<(u32, u32)>,
}

/// Room for flood fills, kept between steps.
#[derive(Clone, Debug, Default)]
pub struct PieceScratch {
    seen_faces: Vec<bool>,
    seen_vertices: Vec<bool>,
    faces: Vec<FaceId>,
}

/// One loose piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoosePiece<'a> {
    /// Its faces, in flood order.
    pub faces: &'a [FaceId],
    /// Its vertices, in flood order.
    pub vertices: &'a [VertexId],
}

impl LoosePieces {
    /// Finds all pieces anew and keeps the loose ones. Gives the number of pieces, attached ones included.
    pub fn find(
        &mut self,
        topology: &Topology,
        scratch: &mut PieceScratch,
        is_attached: impl Fn(VertexId) -> bool,
    ) -> usize {
        self.faces.clear();
        self.vertices.clear();
        self.ends.clear();
        let PieceScratch { seen_faces, seen_vertices, faces } = scratch;
        seen_faces.clear();
        seen_faces.resize(topology.face_count(), false);
        seen_vertices.clear();
        seen_vertices.resize(topology.vertex_count(), false);
        let mut pieces = 0;
        for seed in topology.all_faces() {
            if seen_faces[seed.index()] || !topology.is_live(seed) {
                continue;
            }
            pieces += 1;
            faces.clear();
            faces.push(seed);
            seen_faces[seed.index()] = true;
            let first_vertex = self.vertices.len();
            let (mut attached, mut next) = (false, 0);
            while let Some(&f) = faces.get(next) {
                next += 1;
                for h in f.half_edges() {
                    let v = topology.origin(h);
                    attached |= is_attached(v);
                    if !attached && !seen_vertices[v.index()] {
                        seen_vertices[v.index()] = true;
                        self.vertices.push(v);
                    }
                    if let Some(twin) = topology.bound_twin(h)
                        && !seen_faces[twin.face().index()]
                    {
                        seen_faces[twin.face().index()] = true;
                        faces.push(twin.face());
                    }
                }
            }
            if attached {
                self.vertices.truncate(first_vertex);
            } else {
                self.faces.extend_from_slice(faces);
                self.ends.push((self.faces.len() as u32, self.vertices.len() as u32));
            }
        }
        pieces
    }

    /// Number of loose pieces.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether no piece is loose.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The loose pieces, in the order of their lowest face.
    pub fn iter(&self) -> impl Iterator<Item = LoosePiece<'_>> {
        let starts = std::iter::once((0, 0)).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, end)| LoosePiece {
            faces: &self.faces[start.0 as usize..end.0 as usize],
            vertices: &self.vertices[start.1 as usize..end.1 as usize],
        })
    }
}
