//! Half-edge connectivity of the film (VC 3.3, fig. 4). Knows no positions.
//!
//! Face `f` owns half-edges `3f..3f + 3`, so next and previous are arithmetic and only the twin is stored.
//! The twin is the one of the rest state and is kept when the edge tears: whether the two are still bound is
//! a flag. All handles stay valid for the life of the film (see [`super::edit`]).

use super::handles::{FaceId, HalfEdgeId, VertexId};

/// What has become of a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaceFate {
    /// Part of the film.
    Live,
    /// Removed because all its edges were torn (VC 5.3).
    Stripped,
    /// Removed as part of a small loose piece.
    Fallen,
}

/// Why triangles are no film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TopologyError {
    /// A triangle refers to a vertex that does not exist, or to one vertex twice.
    #[error("triangle {triangle} is not three different vertices below {vertices}")]
    BadTriangle {
        /// Index of the triangle.
        triangle: u32,
        /// Number of vertices.
        vertices: u32,
    },
    /// Two triangles run along an edge in the same direction, or more than two share it.
    #[error("the edge from vertex {from} to {to} belongs to two faces in the same direction")]
    NonManifoldEdge {
        /// Start of the edge.
        from: u32,
        /// End of the edge.
        to: u32,
    },
    /// The faces of a vertex form more than one fan.
    #[error("the faces at vertex {vertex} form more than one fan")]
    NonManifoldVertex {
        /// The vertex.
        vertex: u32,
    },
}

/// Connectivity of the film. Every vertex that has faces has exactly one fan of faces joined across bound
/// edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Topology {
    /// Start vertex of each half-edge.
    pub(super) origins: Vec<VertexId>,
    /// Opposite half-edge at rest; `NONE` at the film's open border.
    pub(super) twins: Vec<HalfEdgeId>,
    /// Whether the edge is torn; the same on both half-edges.
    pub(super) torn: Vec<bool>,
    /// Fate of each face.
    pub(super) fates: Vec<FaceFate>,
    /// First half-edge of each vertex's fan: where the fan is open the clockwise-most one, else any;
    /// `NONE` when no face is left.
    pub(super) fans: Vec<HalfEdgeId>,
    /// The vertex of the rest state that each vertex is, or is a duplicate of.
    pub(super) originals: Vec<VertexId>,
    /// Whether the vertex lies on the film's border at rest or is a duplicate.
    pub(super) border: Vec<bool>,
    /// Number of vertices at rest.
    pub(super) original_vertices: u32,
    /// Number of faces that were removed.
    pub(super) removed_faces: u32,
}

impl Topology {
    /// Connects `triangles` (an oriented manifold over vertices `0..vertices`).
    ///
    /// # Errors
    /// [`TopologyError`] when the triangles are no oriented manifold; [`super::build`] makes one of anything.
    pub fn from_triangles(vertices: usize, triangles: &[[u32; 3]]) -> Result<Self, TopologyError> {
        let mut origins = Vec::with_capacity(triangles.len() * 3);
        for (i, t) in triangles.iter().enumerate() {
            let distinct = t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
            if !distinct || t.iter().any(|&v| v as usize >= vertices) {
                return Err(TopologyError::BadTriangle { triangle: i as u32, vertices: vertices as u32 });
            }
            origins.extend(t.map(VertexId));
        }
        let mut topology = Self {
            twins: vec![HalfEdgeId::NONE; origins.len()],
            torn: vec![false; origins.len()],
            fates: vec![FaceFate::Live; triangles.len()],
            fans: vec![HalfEdgeId::NONE; vertices],
            originals: (0..vertices).map(VertexId::new).collect(),
            border: vec![false; vertices],
            original_vertices: vertices as u32,
            removed_faces: 0,
            origins,
        };
        topology.pair_twins()?;
        topology.find_fans()?;
        Ok(topology)
    }

    fn pair_twins(&mut self) -> Result<(), TopologyError> {
        let mut order: Vec<(u32, u32, HalfEdgeId)> = self
            .all_half_edges()
            .map(|h| {
                let (a, b) = (self.origin(h).0, self.target(h).0);
                (a.min(b), a.max(b), h)
            })
            .collect();
        order.sort_unstable();
        for group in order.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            match *group {
                [_] => {}
                [(_, _, g), (_, _, h)] if self.origin(g) == self.target(h) => {
                    self.twins[g.index()] = h;
                    self.twins[h.index()] = g;
                }
                _ => return Err(TopologyError::NonManifoldEdge { from: group[0].0, to: group[0].1 }),
            }
        }
        Ok(())
    }

    fn find_fans(&mut self) -> Result<(), TopologyError> {
        let mut corners = vec![0u32; self.fans.len()];
        for h in self.all_half_edges() {
            let v = self.origin(h).index();
            corners[v] += 1;
            let open = self.twins[h.index()] == HalfEdgeId::NONE;
            if open || self.fans[v] == HalfEdgeId::NONE {
                self.fans[v] = h;
            }
            if open {
                self.border[v] = true;
                let end = self.target(h).index();
                self.border[end] = true;
            }
        }
        for v in (0..self.fans.len()).map(VertexId::new) {
            if self.fan(v).count() as u32 != corners[v.index()] {
                return Err(TopologyError::NonManifoldVertex { vertex: v.0 });
            }
        }
        Ok(())
    }

    /// Number of faces, stripped and fallen ones included.
    #[inline]
    pub fn face_count(&self) -> usize {
        self.fates.len()
    }

    /// Number of faces that were stripped or fell.
    #[inline]
    pub fn removed_face_count(&self) -> usize {
        self.removed_faces as usize
    }

    /// Number of half-edges, those of stripped and fallen faces included.
    #[inline]
    pub fn half_edge_count(&self) -> usize {
        self.origins.len()
    }

    /// Number of vertices, duplicates and those without faces included.
    #[inline]
    pub fn vertex_count(&self) -> usize {
        self.fans.len()
    }

    /// Number of vertices at rest. Their handles are the lowest; duplicates follow.
    #[inline]
    pub fn original_vertex_count(&self) -> usize {
        self.original_vertices as usize
    }

    /// All faces.
    pub fn all_faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.face_count()).map(FaceId::new)
    }

    /// All half-edges, those of removed faces included.
    pub fn all_half_edges(&self) -> impl ExactSizeIterator<Item = HalfEdgeId> + use<> {
        (0..self.half_edge_count()).map(HalfEdgeId::new)
    }

    /// All vertices, those without faces included.
    pub fn all_vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.vertex_count()).map(VertexId::new)
    }

    /// Faces that are still part of the film.
    pub fn live_faces(&self) -> impl Iterator<Item = FaceId> + '_ {
        self.all_faces().filter(|&f| self.is_live(f))
    }

    /// One half-edge an edge at rest, torn or not, of removed faces too: the lower half-edge of the pair, or
    /// the only one at the border.
    pub fn all_edges(&self) -> impl Iterator<Item = HalfEdgeId> + '_ {
        self.all_half_edges().filter(|&h| h < self.twins[h.index()])
    }

    /// Start vertex of `h`.
    #[inline]
    pub fn origin(&self, h: HalfEdgeId) -> VertexId {
        self.origins[h.index()]
    }

    /// End vertex of `h`.
    #[inline]
    pub fn target(&self, h: HalfEdgeId) -> VertexId {
        self.origins[h.next().index()]
    }

    /// The corner of `h`'s face that is not on `h`.
    #[inline]
    pub fn apex(&self, h: HalfEdgeId) -> VertexId {
        self.origins[h.previous().index()]
    }

    /// The three vertices of `f`, counter-clockwise seen from outside.
    #[inline]
    pub fn corners(&self, f: FaceId) -> [VertexId; 3] {
        f.half_edges().map(|h| self.origin(h))
    }

    /// The opposite half-edge at rest, whether torn or not; `None` at the open border.
    #[inline]
    pub fn rest_twin(&self, h: HalfEdgeId) -> Option<HalfEdgeId> {
        self.twins[h.index()].get()
    }

    /// The opposite half-edge that `h` is still bound to.
    #[inline]
    pub fn bound_twin(&self, h: HalfEdgeId) -> Option<HalfEdgeId> {
        if self.torn[h.index()] { None } else { self.twins[h.index()].get() }
    }

    /// The half-edge that stands for the whole edge: the lower of the pair.
    #[inline]
    pub fn edge(&self, h: HalfEdgeId) -> HalfEdgeId {
        h.min(self.twins[h.index()])
    }

    /// Whether the edge of `h` is torn.
    #[inline]
    pub fn is_torn(&self, h: HalfEdgeId) -> bool {
        self.torn[h.index()]
    }

    /// Whether `f` is part of the film.
    #[inline]
    pub fn is_live(&self, f: FaceId) -> bool {
        self.fates[f.index()] == FaceFate::Live
    }

    /// What has become of `f`.
    #[inline]
    pub fn fate(&self, f: FaceId) -> FaceFate {
        self.fates[f.index()]
    }

    /// Whether any face is left at `v`.
    #[inline]
    pub fn has_faces(&self, v: VertexId) -> bool {
        self.fans[v.index()] != HalfEdgeId::NONE
    }

    /// Whether `v` lies on the film's border at rest or is a duplicate. Such a vertex is never a crack end.
    #[inline]
    pub fn is_border(&self, v: VertexId) -> bool {
        self.border[v.index()]
    }

    /// The vertex at rest that `v` is, or is a duplicate of.
    #[inline]
    pub fn original(&self, v: VertexId) -> VertexId {
        self.originals[v.index()]
    }

    /// Whether an edge of `f` is torn.
    #[inline]
    pub fn has_torn_edge(&self, f: FaceId) -> bool {
        f.half_edges().iter().any(|&h| self.torn[h.index()])
    }

    /// How many of the two faces of `h`'s edge have a torn edge; 0 where the edge is not between two faces any more.
    #[inline]
    pub fn torn_faces(&self, h: HalfEdgeId) -> u8 {
        match self.bound_twin(h) {
            Some(twin) if self.is_live(h.face()) => {
                u8::from(self.has_torn_edge(h.face())) + u8::from(self.has_torn_edge(twin.face()))
            }
            _ => 0,
        }
    }

    /// The half-edges that start at `v`, one a face, counter-clockwise. Empty when no face is left.
    #[inline]
    pub fn fan(&self, v: VertexId) -> Fan<'_> {
        self.fan_from(self.fans[v.index()])
    }

    /// The fan of half-edges from `first` on, counter-clockwise, until it closes or ends.
    #[inline]
    pub(super) fn fan_from(&self, first: HalfEdgeId) -> Fan<'_> {
        Fan { topology: self, first, next: first, left: self.origins.len() }
    }

    /// The half-edges around an original vertex as they were at rest, torn or removed since or not, from `first` on:
    /// the start of its [fan](Self::fan) at rest. They start at the vertex or at a duplicate of it.
    #[inline]
    pub fn rest_fan(&self, first: HalfEdgeId) -> impl Iterator<Item = HalfEdgeId> + '_ {
        std::iter::successors(first.get(), move |h| self.rest_twin(h.previous()).filter(|&next| next != first))
    }

    /// Whether the [fan](Self::fan) of `h`'s start vertex begins at `h`: true of one half-edge a vertex that has faces,
    /// so vertices of faces can be counted without marks.
    #[inline]
    pub fn starts_fan(&self, h: HalfEdgeId) -> bool {
        self.fans[self.origin(h).index()] == h
    }

    /// The half-edge after `h` along the border of its piece, where `h` is bound to no other: the way round keeps the
    /// piece to its left.
    #[inline]
    pub(super) fn next_on_border(&self, h: HalfEdgeId) -> HalfEdgeId {
        let mut next = h.next();
        // The fan at the end of `h` is open, so this ends.
        while let Some(twin) = self.bound_twin(next) {
            next = twin.next();
        }
        next
    }

    /// Whether the faces at `v` go all the way round it.
    #[inline]
    pub fn is_closed_fan(&self, v: VertexId) -> bool {
        self.fans[v.index()].get().is_some_and(|h| self.bound_twin(h).is_some())
    }
}

/// Iterator over the half-edges that start at a vertex; see [`Topology::fan`].
#[derive(Clone, Debug)]
pub struct Fan<'a> {
    topology: &'a Topology,
    first: HalfEdgeId,
    next: HalfEdgeId,
    /// Ends the walk on connectivity that is no manifold, which construction must survive to report.
    left: usize,
}

impl Iterator for Fan<'_> {
    type Item = HalfEdgeId;

    #[inline]
    fn next(&mut self) -> Option<HalfEdgeId> {
        let h = self.next.get()?;
        self.left = self.left.checked_sub(1)?;
        self.next = self.topology.bound_twin(h.previous()).filter(|&n| n != self.first).unwrap_or(HalfEdgeId::NONE);
        Some(h)
    }
}
