//! New faces on a film whose connectivity stays what it is: paint that is whole already.

use super::{
    handles::{FaceId, HalfEdgeId, VertexId},
    mesh::FilmMesh,
};

/// Faces of a film that are made new where nothing has torn between them.
#[derive(Clone, Debug)]
pub(crate) struct Repaint<'a> {
    /// Whether each face is made new.
    pub is_new: &'a [bool],
    /// Faces that are made new, in ascending order.
    pub faces: Vec<FaceId>,
    /// Their corners, in ascending order: original vertices, each once.
    pub corners: Vec<VertexId>,
}

impl Repaint<'_> {
    /// Returns the edges that are new: those between two new faces, and of new faces at the border. In ascending order.
    pub fn new_edges<'b>(&'b self, mesh: &'b FilmMesh) -> impl Iterator<Item = HalfEdgeId> + 'b {
        let topology = &mesh.topology;
        let sides = self.faces.iter().flat_map(|f| f.half_edges());
        sides.filter(|&h| {
            topology.edge(h) == h && topology.rest_twin(h).is_none_or(|twin| self.is_new[twin.face().index()])
        })
    }

    /// Returns whether `v` is a corner of a new face.
    pub fn has(&self, v: VertexId) -> bool {
        self.corners.binary_search(&v).is_ok()
    }
}

impl FilmMesh {
    /// Returns what making these faces new comes to if no connectivity changes by it, or `None` if it does: [`renew`]
    /// has to put the film together again where a face is gone, an edge between two of the faces has torn, or a crack
    /// has left one of them with a duplicate of its vertex.
    ///
    /// [`renew`]: Self::renew
    pub(crate) fn repaint<'a>(&self, is_new: &'a [bool]) -> Option<Repaint<'a>> {
        debug_assert_eq!(is_new.len(), self.topology.face_count());
        let topology = &self.topology;
        let originals = topology.original_vertex_count();
        let (mut faces, mut corners) = (Vec::new(), Vec::new());
        for f in is_new.iter().enumerate().filter(|(_, is_new)| **is_new).map(|(f, _)| FaceId::new(f)) {
            let is_open = |h: HalfEdgeId| {
                topology.is_torn(h) && topology.rest_twin(h).is_some_and(|twin| is_new[twin.face().index()])
            };
            let own = topology.corners(f);
            let is_whole = topology.is_live(f) && own.iter().all(|v| v.index() < originals);
            if !is_whole || f.half_edges().into_iter().any(is_open) {
                return None;
            }
            faces.push(f);
            corners.extend(own);
        }
        corners.sort_unstable();
        corners.dedup();
        Some(Repaint { is_new, faces, corners })
    }
}
