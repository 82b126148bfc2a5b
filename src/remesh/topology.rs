//! Connectivity of the triangle mesh that remeshing edits: half-edges with origins and twins.
//!
//! Face `f` owns half-edges `3 * f`, `3 * f + 1` and `3 * f + 2`. A removed face has no origins, and a removed vertex
//! has no outgoing half-edge; both are used again. The outgoing half-edge of a border vertex is the one without a twin,
//! so that a turn counter-clockwise from it meets every face around the vertex.

use std::ops::Range;

use crate::{
    film::{FaceId, HalfEdgeId, VertexId},
    rest::{LIGHT_PIECE, Rest, pieces, sort_by_number},
};

/// Connectivity of a triangle mesh whose edges can be split, collapsed and flipped.
#[derive(Clone, Debug, Default)]
pub(super) struct Topology {
    origins: Vec<VertexId>,
    twins: Vec<HalfEdgeId>,
    outgoing: Vec<HalfEdgeId>,
    dead_faces: Vec<FaceId>,
    dead_vertices: Vec<VertexId>,
}

impl Topology {
    /// Joins triangles along the edges that exactly two of them run along in opposite directions.
    pub async fn new(triangles: &[[u32; 3]], vertices: usize, rest: &mut impl Rest) -> Self {
        let origins: Vec<VertexId> = triangles.iter().flatten().map(|&v| VertexId(v)).collect();
        let mut topology = Self { twins: vec![HalfEdgeId::NONE; origins.len()], origins, ..Self::default() };
        topology.outgoing = vec![HalfEdgeId::NONE; vertices];
        let edges: Vec<(VertexId, VertexId, HalfEdgeId)> = (0..topology.origins.len())
            .map(HalfEdgeId::new)
            .map(|h| {
                let (a, b) = (topology.origin(h), topology.target(h));
                (a.min(b), a.max(b), h)
            })
            .collect();
        rest.rest().await;
        let edges = sort_by_number(edges, |edge| edge.0.0, rest).await;
        for same in edges.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)) {
            if let &[(.., h), (.., t)] = same
                && topology.origin(h) == topology.target(t)
            {
                topology.link(h, t);
            }
        }
        rest.rest().await;
        for piece in pieces(topology.origins.len(), LIGHT_PIECE) {
            for h in piece.map(HalfEdgeId::new) {
                let v = topology.origin(h);
                if topology.outgoing[v.index()] == HalfEdgeId::NONE {
                    topology.anchor(v, h);
                }
            }
            rest.rest().await;
        }
        topology
    }

    #[inline]
    pub fn origin(&self, h: HalfEdgeId) -> VertexId {
        self.origins[h.index()]
    }

    #[inline]
    pub fn target(&self, h: HalfEdgeId) -> VertexId {
        self.origins[h.next().index()]
    }

    /// Returns the corner of the half-edge's face that does not lie on it.
    #[inline]
    pub fn opposite(&self, h: HalfEdgeId) -> VertexId {
        self.origins[h.previous().index()]
    }

    #[inline]
    pub fn twin(&self, h: HalfEdgeId) -> Option<HalfEdgeId> {
        self.twins[h.index()].get()
    }

    /// Returns one of the vertex's outgoing half-edges: on a border the one without a twin.
    #[inline]
    pub fn outgoing(&self, v: VertexId) -> Option<HalfEdgeId> {
        self.outgoing[v.index()].get()
    }

    #[inline]
    pub fn corners(&self, f: FaceId) -> [VertexId; 3] {
        f.half_edges().map(|h| self.origin(h))
    }

    #[inline]
    pub fn is_live(&self, f: FaceId) -> bool {
        self.origins[3 * f.index()] != VertexId::NONE
    }

    /// Returns the number of face ids in use or removed.
    pub fn face_slots(&self) -> usize {
        self.origins.len() / 3
    }

    /// Returns the number of half-edge ids in use or removed.
    pub fn half_edge_slots(&self) -> usize {
        self.origins.len()
    }

    /// Returns the number of vertex ids in use or removed.
    pub fn vertex_slots(&self) -> usize {
        self.outgoing.len()
    }

    pub fn live_faces(&self) -> usize {
        self.face_slots() - self.dead_faces.len()
    }

    /// Iterates over all edges, each given by the lower of its half-edges, in index order.
    pub fn edges(&self) -> impl Iterator<Item = HalfEdgeId> + '_ {
        self.edges_in(0..self.origins.len())
    }

    /// Iterates over the edges whose lower half-edges are among these.
    pub fn edges_in(&self, half_edges: Range<usize>) -> impl Iterator<Item = HalfEdgeId> + '_ {
        half_edges
            .map(HalfEdgeId::new)
            .filter(|&h| self.origin(h) != VertexId::NONE && self.twin(h).is_none_or(|t| h < t))
    }

    pub fn faces(&self) -> impl Iterator<Item = FaceId> + '_ {
        (0..self.face_slots()).map(FaceId::new).filter(|&f| self.is_live(f))
    }

    /// Returns the half-edge that follows `h` counter-clockwise around its origin.
    #[inline]
    pub fn counter_clockwise(&self, h: HalfEdgeId) -> Option<HalfEdgeId> {
        self.twin(h.previous())
    }

    /// Returns the half-edge that follows `h` clockwise around its origin.
    #[inline]
    pub fn clockwise(&self, h: HalfEdgeId) -> Option<HalfEdgeId> {
        self.twin(h).map(HalfEdgeId::next)
    }

    /// Iterates over the outgoing half-edges of the vertex, one for each face, counter-clockwise.
    pub fn ring(&self, v: VertexId) -> impl Iterator<Item = HalfEdgeId> + '_ {
        let first = self.outgoing(v);
        std::iter::successors(first, move |&h| self.counter_clockwise(h).filter(|&n| Some(n) != first))
    }

    pub fn faces_around(&self, v: VertexId) -> impl Iterator<Item = FaceId> + '_ {
        self.ring(v).map(HalfEdgeId::face)
    }

    pub fn is_border(&self, v: VertexId) -> bool {
        self.outgoing(v).is_some_and(|h| self.twin(h).is_none())
    }

    /// Iterates over the edges at the vertex with its neighbours, counter-clockwise.
    pub fn spokes(&self, v: VertexId) -> impl Iterator<Item = (HalfEdgeId, VertexId)> + '_ {
        let last = self
            .outgoing(v)
            .filter(|&h| self.twin(h).is_none())
            .and_then(|_| self.ring(v).last())
            .map(|h| (h.previous(), self.opposite(h)));
        self.ring(v).map(|h| (h, self.target(h))).chain(last)
    }

    /// Iterates over the neighbours of the vertex, counter-clockwise.
    pub fn neighbours(&self, v: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        self.spokes(v).map(|(_, n)| n)
    }

    /// Returns the half-edge from `a` to `b`, or else the one from `b` to `a`.
    pub fn edge_between(&self, a: VertexId, b: VertexId) -> Option<HalfEdgeId> {
        self.ring(a)
            .find_map(|h| if self.target(h) == b { Some(h) } else { (self.opposite(h) == b).then_some(h.previous()) })
    }

    pub fn add_vertex(&mut self) -> VertexId {
        if let Some(v) = self.dead_vertices.pop() {
            return v;
        }
        self.outgoing.push(HalfEdgeId::NONE);
        VertexId::new(self.outgoing.len() - 1)
    }

    pub fn remove_vertex(&mut self, v: VertexId) {
        self.outgoing[v.index()] = HalfEdgeId::NONE;
        self.dead_vertices.push(v);
    }

    pub fn add_face(&mut self, corners: [VertexId; 3]) -> FaceId {
        let f = self.dead_faces.pop().unwrap_or_else(|| {
            self.origins.extend([VertexId::NONE; 3]);
            self.twins.extend([HalfEdgeId::NONE; 3]);
            FaceId::new(self.origins.len() / 3 - 1)
        });
        for (h, v) in f.half_edges().into_iter().zip(corners) {
            self.origins[h.index()] = v;
            self.twins[h.index()] = HalfEdgeId::NONE;
        }
        f
    }

    /// Removes the face. The caller must link the twins of its neighbours.
    pub fn remove_face(&mut self, f: FaceId) {
        for h in f.half_edges() {
            self.origins[h.index()] = VertexId::NONE;
            self.twins[h.index()] = HalfEdgeId::NONE;
        }
        self.dead_faces.push(f);
    }

    #[inline]
    pub fn set_origin(&mut self, h: HalfEdgeId, v: VertexId) {
        self.origins[h.index()] = v;
    }

    pub fn link(&mut self, h: HalfEdgeId, t: HalfEdgeId) {
        self.twins[h.index()] = t;
        self.twins[t.index()] = h;
    }

    /// Makes `h` and `t` twins, or makes `h` a border half-edge.
    pub fn link_or_open(&mut self, h: HalfEdgeId, t: Option<HalfEdgeId>) {
        match t {
            Some(t) => self.link(h, t),
            None => self.twins[h.index()] = HalfEdgeId::NONE,
        }
    }

    /// Sets the outgoing half-edge of `v`, given any half-edge `h` that starts there.
    pub fn anchor(&mut self, v: VertexId, h: HalfEdgeId) {
        let mut first = h;
        while let Some(previous) = self.clockwise(first) {
            first = previous;
            if first == h {
                break;
            }
        }
        self.outgoing[v.index()] = first;
    }

    /// Checks every invariant; for tests.
    #[cfg(test)]
    pub fn check(&self) {
        for f in self.faces() {
            let [a, b, c] = self.corners(f);
            assert!(a != b && b != c && c != a, "face {f:?} is degenerate");
            for h in f.half_edges() {
                if let Some(t) = self.twin(h) {
                    assert_eq!(self.twin(t), Some(h));
                    assert_eq!(self.origin(t), self.target(h));
                    assert_eq!(self.target(t), self.origin(h));
                }
                assert!(self.ring(self.origin(h)).any(|r| r == h), "vertex {:?} has two fans", self.origin(h));
            }
        }
        let mut edges: Vec<_> = self.edges().map(|h| (self.origin(h), self.target(h))).collect();
        edges.iter_mut().for_each(|e| *e = (e.0.min(e.1), e.0.max(e.1)));
        edges.sort_unstable();
        assert!(edges.windows(2).all(|w| w[0] != w[1]), "two edges join the same vertices");
        for v in (0..self.vertex_slots()).map(VertexId::new) {
            if let Some(h) = self.outgoing(v) {
                assert_eq!(self.origin(h), v);
                assert!(self.twin(h).is_none() || self.ring(v).all(|h| self.twin(h).is_some()));
            }
        }
    }
}
