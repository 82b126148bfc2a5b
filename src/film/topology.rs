//! Half-edge connectivity of the film (VC 3.3, fig. 4).
//!
//! Face `f` owns half-edges `3 * f` to `3 * f + 2`, so the next and the previous half-edge of a face are arithmetic and
//! only twins are stored. A twin is never forgotten: a torn edge keeps its twins, and a flag says that it is torn.

use super::handles::{FaceId, HalfEdgeId, VertexId};
use crate::rest::{NoRest, Rest, at_once, sort_by_number};

/// State of a face: part of the film or removed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaceFate {
    /// The face is part of the film.
    Live,
    /// The face was removed because it was joined to no other face any more (VC 5.3).
    Stripped,
    /// The face was removed as part of a loose piece that fell.
    Fallen,
}

/// Reason why triangles cannot be the faces of a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TopologyError {
    /// A triangle refers to a vertex that does not exist, or to one vertex twice.
    #[error("triangle {triangle} is not three different vertices below {vertices}")]
    BadTriangle {
        /// Index of the triangle.
        triangle: u32,
        /// Number of vertices that there are.
        vertices: u32,
    },
    /// Two triangles run along an edge in the same direction, or more than two share it.
    #[error("the edge from vertex {from} to {to} belongs to two faces in the same direction")]
    NonManifoldEdge {
        /// Index of one end of the edge.
        from: u32,
        /// Index of the other end of the edge.
        to: u32,
    },
    /// The faces of a vertex form more than one fan.
    #[error("the faces at vertex {vertex} form more than one fan")]
    NonManifoldVertex {
        /// Index of the vertex.
        vertex: u32,
    },
}

/// Connectivity of the film.
///
/// An edge between two faces is *bound* until it tears. The faces of a vertex always form one *fan*: each is joined to
/// the next across a bound edge. Where a tear would leave two fans, the vertex is duplicated.
///
/// ```
/// use bevy_coating::film::{HalfEdgeId, Topology, VertexId};
///
/// // A unit square: its two faces share the diagonal from vertex 0 to vertex 2.
/// let topology = Topology::from_triangles(4, &[[0, 1, 2], [0, 2, 3]])?;
/// let diagonal = HalfEdgeId(2);
/// assert_eq!((topology.origin(diagonal), topology.target(diagonal)), (VertexId(2), VertexId(0)));
/// assert_eq!(topology.bound_twin(diagonal), Some(HalfEdgeId(3)));
///
/// // Walk the faces around vertex 0, counter-clockwise.
/// let faces: Vec<u32> = topology.fan(VertexId(0)).map(|h| h.face().0).collect();
/// assert_eq!(faces, [0, 1]);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
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
    /// Connects triangles over the vertices `0..vertices`. Triangles are counter-clockwise seen from outside.
    ///
    /// # Errors
    /// [`TopologyError`] if the triangles do not form an oriented manifold. [`clean`](crate::surface::clean) makes one
    /// of any triangles.
    ///
    /// ```
    /// use bevy_coating::film::{Topology, TopologyError};
    ///
    /// // Two triangles that only meet in a point.
    /// let error = Topology::from_triangles(5, &[[0, 1, 2], [0, 3, 4]]).unwrap_err();
    /// assert_eq!(error, TopologyError::NonManifoldVertex { vertex: 0 });
    /// ```
    pub fn from_triangles(vertices: usize, triangles: &[[u32; 3]]) -> Result<Self, TopologyError> {
        at_once(Self::in_pieces(vertices, triangles, &mut NoRest))
    }

    /// Does what [`from_triangles`](Self::from_triangles) does, with rests between its pieces.
    pub(super) async fn in_pieces(
        vertices: usize,
        triangles: &[[u32; 3]],
        rest: &mut impl Rest,
    ) -> Result<Self, TopologyError> {
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
        topology.pair_twins(rest).await?;
        rest.rest().await;
        topology.find_fans()?;
        rest.rest().await;
        Ok(topology)
    }

    /// Finds the twin of every half-edge that has one.
    async fn pair_twins(&mut self, rest: &mut impl Rest) -> Result<(), TopologyError> {
        let order: Vec<(u32, u32, HalfEdgeId)> = self
            .all_half_edges()
            .map(|h| {
                let (a, b) = (self.origin(h).0, self.target(h).0);
                (a.min(b), a.max(b), h)
            })
            .collect();
        let order = sort_by_number(order, |edge| edge.0, rest).await;
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

    /// Finds where the fan of every vertex begins at rest, and the vertices on the border.
    pub(super) fn begin_fans(&mut self) {
        for h in self.all_half_edges() {
            let v = self.origin(h).index();
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
    }

    /// Finds the fan of every vertex and the vertices on the border.
    fn find_fans(&mut self) -> Result<(), TopologyError> {
        self.begin_fans();
        let mut corners = vec![0u32; self.fans.len()];
        for h in self.all_half_edges() {
            corners[self.origin(h).index()] += 1;
        }
        for v in (0..self.fans.len()).map(VertexId::new) {
            if self.fan(v).count() as u32 != corners[v.index()] {
                return Err(TopologyError::NonManifoldVertex { vertex: v.0 });
            }
        }
        Ok(())
    }

    /// Returns the number of faces, including removed ones.
    #[inline]
    pub fn face_count(&self) -> usize {
        self.fates.len()
    }

    /// Returns the number of faces that were stripped or fell.
    #[inline]
    pub fn removed_face_count(&self) -> usize {
        self.removed_faces as usize
    }

    /// Returns the number of half-edges, including those of removed faces.
    #[inline]
    pub fn half_edge_count(&self) -> usize {
        self.origins.len()
    }

    /// Returns the number of vertices, including duplicates and vertices without faces.
    #[inline]
    pub fn vertex_count(&self) -> usize {
        self.fans.len()
    }

    /// Returns the number of vertices that are no duplicates. They have the lowest handles; duplicates follow.
    #[inline]
    pub fn original_vertex_count(&self) -> usize {
        self.original_vertices as usize
    }

    /// Iterates over all faces, including removed ones.
    pub fn all_faces(&self) -> impl ExactSizeIterator<Item = FaceId> + use<> {
        (0..self.face_count()).map(FaceId::new)
    }

    /// Iterates over all half-edges, including those of removed faces.
    pub fn all_half_edges(&self) -> impl ExactSizeIterator<Item = HalfEdgeId> + use<> {
        (0..self.half_edge_count()).map(HalfEdgeId::new)
    }

    /// Iterates over all vertices, including duplicates and vertices without faces.
    pub fn all_vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + use<> {
        (0..self.vertex_count()).map(VertexId::new)
    }

    /// Iterates over the faces that are part of the film.
    pub fn live_faces(&self) -> impl Iterator<Item = FaceId> + '_ {
        self.all_faces().filter(|&f| self.is_live(f))
    }

    /// Iterates over all edges of the film at rest, including torn ones and those of removed faces. Each is given by
    /// the lower of its two half-edges, or by its only one on the border.
    pub fn all_edges(&self) -> impl Iterator<Item = HalfEdgeId> + '_ {
        self.all_half_edges().filter(|&h| h < self.twins[h.index()])
    }

    /// Returns the vertex at which each half-edge starts.
    #[inline]
    pub(crate) fn origins(&self) -> &[VertexId] {
        &self.origins
    }

    /// Returns whether the edge of each half-edge is torn.
    #[inline]
    pub(crate) fn torn(&self) -> &[bool] {
        &self.torn
    }

    /// Returns the fate of each face.
    #[inline]
    pub(crate) fn fates(&self) -> &[FaceFate] {
        &self.fates
    }

    /// Returns the vertex of the rest state that each vertex is, or is a duplicate of.
    #[inline]
    pub(crate) fn originals(&self) -> &[VertexId] {
        &self.originals
    }

    /// Returns the vertex at which `h` starts.
    #[inline]
    pub fn origin(&self, h: HalfEdgeId) -> VertexId {
        self.origins[h.index()]
    }

    /// Returns the vertex at which `h` ends.
    #[inline]
    pub fn target(&self, h: HalfEdgeId) -> VertexId {
        self.origins[h.next().index()]
    }

    /// Returns the corner of the face of `h` that does not lie on `h`.
    #[inline]
    pub fn apex(&self, h: HalfEdgeId) -> VertexId {
        self.origins[h.previous().index()]
    }

    /// Returns the three corners of `f`, counter-clockwise seen from outside.
    #[inline]
    pub fn corners(&self, f: FaceId) -> [VertexId; 3] {
        f.half_edges().map(|h| self.origin(h))
    }

    /// Returns the half-edge that runs the other way along the same edge of the film at rest, even if the edge is torn
    /// by now. Returns `None` on the border.
    #[inline]
    pub fn rest_twin(&self, h: HalfEdgeId) -> Option<HalfEdgeId> {
        self.twins[h.index()].get()
    }

    /// Returns the half-edge that runs the other way along the same edge. Returns `None` on the border and where the
    /// edge is torn.
    #[inline]
    pub fn bound_twin(&self, h: HalfEdgeId) -> Option<HalfEdgeId> {
        if self.torn[h.index()] { None } else { self.twins[h.index()].get() }
    }

    /// Returns the half-edge that stands for the whole edge of `h`: the lower one of the two, as in
    /// [`all_edges`](Self::all_edges).
    #[inline]
    pub fn edge(&self, h: HalfEdgeId) -> HalfEdgeId {
        h.min(self.twins[h.index()])
    }

    /// Returns whether the edge of `h` is torn.
    #[inline]
    pub fn is_torn(&self, h: HalfEdgeId) -> bool {
        self.torn[h.index()]
    }

    /// Returns whether `f` is part of the film.
    #[inline]
    pub fn is_live(&self, f: FaceId) -> bool {
        self.fates[f.index()] == FaceFate::Live
    }

    /// Returns whether `f` is part of the film, was stripped or has fallen.
    #[inline]
    pub fn fate(&self, f: FaceId) -> FaceFate {
        self.fates[f.index()]
    }

    /// Returns whether any face is left at `v`.
    #[inline]
    pub fn has_faces(&self, v: VertexId) -> bool {
        self.fans[v.index()] != HalfEdgeId::NONE
    }

    /// Returns whether `v` lies on the film's border at rest or is a duplicate. Such a vertex is never the tip of a
    /// crack.
    #[inline]
    pub fn is_border(&self, v: VertexId) -> bool {
        self.border[v.index()]
    }

    /// Returns the vertex of which `v` is a duplicate, or `v` itself if it is none.
    #[inline]
    pub fn original(&self, v: VertexId) -> VertexId {
        self.originals[v.index()]
    }

    /// Returns whether at least one edge of `f` is torn.
    #[inline]
    pub fn has_torn_edge(&self, f: FaceId) -> bool {
        f.half_edges().iter().any(|&h| self.torn[h.index()])
    }

    /// Returns the number of faces at the edge of `h` that have a torn edge, 0 to 2. Returns 0 where the edge does not
    /// join two faces (any more).
    #[inline]
    pub fn torn_faces(&self, h: HalfEdgeId) -> u8 {
        match self.bound_twin(h) {
            Some(twin) if self.is_live(h.face()) => {
                u8::from(self.has_torn_edge(h.face())) + u8::from(self.has_torn_edge(twin.face()))
            }
            _ => 0,
        }
    }

    /// Iterates over the half-edges that start at `v`, one for each of its faces, counter-clockwise. Where the fan is
    /// open, the walk starts at its clockwise end. There are none if `v` has no faces left.
    ///
    /// ```
    /// use bevy_coating::film::{Topology, VertexId};
    ///
    /// let topology = Topology::from_triangles(5, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 1]])?;
    /// assert!(topology.is_closed_fan(VertexId(0)));
    /// let ring: Vec<u32> = topology.fan(VertexId(0)).map(|h| topology.target(h).0).collect();
    /// assert_eq!(ring.len(), 4);
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    #[inline]
    pub fn fan(&self, v: VertexId) -> Fan<'_> {
        self.fan_from(self.fans[v.index()])
    }

    /// Iterates over the half-edges of the fan from `first` on, counter-clockwise, until it closes or ends.
    #[inline]
    pub(super) fn fan_from(&self, first: HalfEdgeId) -> Fan<'_> {
        Fan { topology: self, first, next: first, left: self.origins.len() }
    }

    /// Iterates over the half-edges around an original vertex as they were at rest, even if edges have torn or faces
    /// were removed since. `first` is the half-edge at which the [fan](Self::fan) of the vertex began at rest. The
    /// half-edges start at the vertex or at a duplicate of it.
    #[inline]
    pub fn rest_fan(&self, first: HalfEdgeId) -> impl Iterator<Item = HalfEdgeId> + '_ {
        std::iter::successors(first.get(), move |h| self.rest_twin(h.previous()).filter(|&next| next != first))
    }

    /// Returns whether the [fan](Self::fan) of the origin of `h` begins at `h`. This holds for exactly one half-edge of
    /// each vertex that has faces, so a walk over half-edges can visit each vertex once.
    #[inline]
    pub fn starts_fan(&self, h: HalfEdgeId) -> bool {
        self.fans[self.origin(h).index()] == h
    }

    /// Returns the half-edge that follows `h` on the border of its piece. `h` must be on that border itself: bound to
    /// no twin. The piece lies to the left of the walk.
    #[inline]
    pub(super) fn next_on_border(&self, h: HalfEdgeId) -> HalfEdgeId {
        let mut next = h.next();
        // The fan at the end of `h` is open, so this ends.
        while let Some(twin) = self.bound_twin(next) {
            next = twin.next();
        }
        next
    }

    /// Returns whether the faces at `v` go all the way round it, with no border or torn edge between them.
    #[inline]
    pub fn is_closed_fan(&self, v: VertexId) -> bool {
        self.fans[v.index()].get().is_some_and(|h| self.bound_twin(h).is_some())
    }
}

/// Iterator over the half-edges that start at a vertex, made by [`Topology::fan`].
#[derive(Clone, Debug)]
pub struct Fan<'a> {
    topology: &'a Topology,
    first: HalfEdgeId,
    next: HalfEdgeId,
    /// Steps until the walk is given up. A fan of triangles that are no manifold may never close, and construction must
    /// end to report it.
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
