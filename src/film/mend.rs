//! Mends a film in place: faces that are gone come back, and cracks between new faces close, where they are.
//!
//! Unlike [`renew`](FilmMesh::renew), this changes only the places at the corners of the new faces, in time
//! proportional to them. Around each the faces fall into fans, as always; a fan with a new face takes the original
//! vertex, and a fan that had it takes one that is free. Vertices that are left without faces keep their numbers, as
//! those of faces that fell do.

use super::{
    handles::{FaceId, HalfEdgeId, VertexId},
    mesh::FilmMesh,
    topology::{FaceFate, Topology},
};

/// Vertex that had faces before a film was mended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Former {
    /// The vertex.
    pub vertex: VertexId,
    /// Face that it had.
    pub face: FaceId,
    /// Whether its fan has no new face, so that it is what it was, perhaps at another vertex.
    pub kept: bool,
}

/// What was mended of a film.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mend {
    /// Whether each face is new.
    pub is_new: Vec<bool>,
    /// New faces, in ascending order.
    pub faces: Vec<FaceId>,
    /// New faces that were gone.
    pub came_back: Vec<FaceId>,
    /// Original vertices at the corners of new faces, in ascending order.
    pub places: Vec<VertexId>,
    /// All faces at these places at rest, in ascending order.
    pub around: Vec<FaceId>,
    /// Edges of these faces, in ascending order.
    pub edges: Vec<HalfEdgeId>,
    /// Original vertices at their corners, in ascending order.
    pub originals: Vec<VertexId>,
    /// Edges that were torn and are whole.
    pub mended: Vec<HalfEdgeId>,
    /// Edges that were whole, between faces that were gone, and are torn as one of the two is new.
    pub torn: Vec<HalfEdgeId>,
    /// Vertices at the places that had faces before, in ascending order.
    pub before: Vec<Former>,
    /// Original of each vertex that was appended, in order.
    pub appended: Vec<VertexId>,
    /// Vertices whose fan without a new face is now at another vertex, with that.
    pub moved: Vec<[VertexId; 2]>,
    /// Vertices of fans with a new face, in ascending order. They lie at rest.
    pub fresh: Vec<VertexId>,
    /// Vertices at the places that have faces now, in ascending order.
    pub here: Vec<VertexId>,
    /// Vertices that had faces and have none any more.
    pub left: Vec<VertexId>,
}

impl Mend {
    /// Returns whether the edge of `h` is new: it joins two new faces, or is that of a new face at the border.
    pub fn is_new_edge(&self, topology: &Topology, h: HalfEdgeId) -> bool {
        let is_new = |h: HalfEdgeId| self.is_new[h.face().index()];
        is_new(h) && topology.rest_twin(h).is_none_or(is_new)
    }

    /// Returns what became of the vertex `v` as it was: where it is now, unless its fan has a new face.
    pub fn now(&self, v: VertexId) -> Option<VertexId> {
        match self.before.binary_search_by_key(&v, |former| former.vertex) {
            Ok(i) if !self.before[i].kept => None,
            Ok(_) => Some(self.moved.iter().find(|[from, _]| *from == v).map_or(v, |&[_, to]| to)),
            Err(_) => Some(v),
        }
    }
}

/// A fan of live faces at a place.
#[derive(Clone, Copy, Debug)]
struct LiveFan {
    /// First half-edge, at its clockwise end.
    first: HalfEdgeId,
    is_new: bool,
    /// Vertex that it gets.
    vertex: VertexId,
}

/// Buffers for one place after the other.
#[derive(Default)]
struct Place {
    /// Half-edges around the place at rest, counter-clockwise.
    ring: Vec<HalfEdgeId>,
    fans: Vec<LiveFan>,
    /// Vertices at which the half-edges began, each once.
    vertices: Vec<VertexId>,
    taken: Vec<VertexId>,
}

impl FilmMesh {
    /// Makes faces new as [`renew`](Self::renew) does, but that elements keep their numbers: one entry of `is_new` for
    /// each face.
    pub(crate) fn mend(&mut self, is_new: Vec<bool>) -> Mend {
        debug_assert_eq!(is_new.len(), self.topology.face_count());
        let faces: Vec<FaceId> =
            is_new.iter().enumerate().filter(|(_, is_new)| **is_new).map(|(f, _)| FaceId::new(f)).collect();
        let mut mend = Mend { is_new, faces, ..Mend::default() };
        let topology = &mut self.topology;
        topology.mend_edges(&mut mend);
        let mut corners: Vec<(VertexId, HalfEdgeId)> = mend
            .faces
            .iter()
            .flat_map(|f| f.half_edges())
            .map(|h| (topology.original(topology.origin(h)), h))
            .collect();
        corners.sort_unstable();
        corners.dedup_by_key(|(place, _)| *place);
        let mut place = Place::default();
        for (original, h) in corners {
            mend.places.push(original);
            self.mend_place(original, h, &mut place, &mut mend);
        }
        for list in [&mut mend.fresh, &mut mend.here] {
            list.sort_unstable();
        }
        mend.before.sort_unstable();
        mend.around.sort_unstable();
        mend.around.dedup();
        let (topology, sides) = (&self.topology, mend.around.iter().flat_map(|f| f.half_edges()));
        mend.edges = sides.clone().map(|h| topology.edge(h)).collect();
        mend.edges.sort_unstable();
        mend.edges.dedup();
        mend.originals = sides.map(|h| topology.original(topology.origin(h))).collect();
        mend.originals.sort_unstable();
        mend.originals.dedup();
        for &v in &mend.fresh {
            self.geometry.positions[v.index()] = self.geometry.rest_positions[v.index()];
        }
        mend
    }

    fn mend_place(&mut self, original: VertexId, h: HalfEdgeId, place: &mut Place, mend: &mut Mend) {
        let Self { topology, geometry } = self;
        topology.ring_at_rest(h, &mut place.ring);
        mend.around.extend(place.ring.iter().map(|h| h.face()));
        place.find_fans(topology, &mend.is_new);
        place.choose_vertices(topology, original);
        place.vertices.clear();
        place.vertices.extend(place.ring.iter().map(|&h| topology.origin(h)));
        place.vertices.sort_unstable();
        place.vertices.dedup();
        let is_kept = |v: VertexId| {
            let own = place.fans.iter().find(|fan| topology.origin(fan.first) == v && topology.starts_fan(fan.first));
            own.is_some_and(|fan| !fan.is_new)
        };
        for &vertex in &place.vertices {
            if let Some(first) = topology.fans[vertex.index()].get() {
                mend.before.push(Former { vertex, face: first.face(), kept: is_kept(vertex) });
            }
        }
        for fan in &mut place.fans {
            if fan.vertex == VertexId::NONE {
                fan.vertex = topology.append_vertex(original);
                geometry.duplicate_vertex(original);
                mend.appended.push(original);
            }
            let before = topology.origin(fan.first);
            if fan.is_new {
                mend.fresh.push(fan.vertex);
            } else if before != fan.vertex {
                mend.moved.push([before, fan.vertex]);
                geometry.positions[fan.vertex.index()] = geometry.positions[before.index()];
            }
            mend.here.push(fan.vertex);
        }
        for &v in &place.vertices {
            let had_faces = std::mem::replace(&mut topology.fans[v.index()], HalfEdgeId::NONE) != HalfEdgeId::NONE;
            if had_faces && !place.fans.iter().any(|fan| fan.vertex == v) {
                mend.left.push(v);
            }
        }
        for fan in &place.fans {
            topology.give_fan(fan.first, fan.vertex);
        }
    }
}

impl Place {
    /// Finds the fans of live faces in the ring.
    fn find_fans(&mut self, topology: &Topology, is_new: &[bool]) {
        let Self { ring, fans, .. } = self;
        fans.clear();
        let any_new = |first: HalfEdgeId| topology.fan_at(first).any(|h| is_new[h.face().index()]);
        let starts = ring.iter().copied().filter(|&h| topology.bound_twin(h).is_none());
        for first in starts.filter(|h| topology.is_live(h.face())) {
            fans.push(LiveFan { first, is_new: any_new(first), vertex: VertexId::NONE });
        }
        // All faces are bound all the way round: the fan begins where it did at rest.
        if let Some(&first) = ring.iter().min()
            && ring.iter().all(|&h| topology.bound_twin(h).is_some())
        {
            fans.push(LiveFan { first, is_new: any_new(first), vertex: VertexId::NONE });
        }
    }

    /// Chooses the vertex of each fan; `NONE` for one that is yet to be made.
    fn choose_vertices(&mut self, topology: &Topology, original: VertexId) {
        let Self { ring, fans, taken, .. } = self;
        taken.clear();
        // New paint holds at the original vertex: the fan that is there already, or the one with the lowest face.
        let rank = |fan: &LiveFan| {
            let is_there = topology.fan_at(fan.first).any(|h| topology.origin(h) == original);
            (!fan.is_new, !is_there, topology.fan_at(fan.first).map(HalfEdgeId::face).min())
        };
        if let Some(first) = fans.iter_mut().min_by_key(|fan| rank(fan)) {
            first.vertex = original;
            taken.push(original);
        }
        for fan in fans.iter_mut().filter(|fan| !fan.is_new && fan.vertex == VertexId::NONE) {
            let own = topology.origin(fan.first);
            if own != original {
                fan.vertex = own;
                taken.push(own);
            }
        }
        for fan in fans.iter_mut().filter(|fan| fan.vertex == VertexId::NONE) {
            let own = topology.fan_at(fan.first).map(|h| topology.origin(h));
            let others = ring.iter().map(|&h| topology.origin(h));
            if let Some(free) = own.chain(others).find(|v| !taken.contains(v)) {
                fan.vertex = free;
                taken.push(free);
            }
        }
    }
}

impl Topology {
    /// Lets faces come back, closes the cracks between new faces, and cuts them off from faces that stay away.
    fn mend_edges(&mut self, mend: &mut Mend) {
        for &f in &mend.faces {
            if !self.is_live(f) {
                self.fates[f.index()] = FaceFate::Live;
                self.removed_faces -= 1;
                mend.came_back.push(f);
            }
        }
        for h in mend.faces.iter().flat_map(|f| f.half_edges()) {
            let Some(twin) = self.rest_twin(h) else { continue };
            let (both, is_torn) = (mend.is_new[twin.face().index()], self.is_torn(h));
            let tears = !both && !self.is_live(twin.face());
            if both && is_torn {
                mend.mended.push(self.edge(h));
            } else if tears && !is_torn {
                mend.torn.push(self.edge(h));
            } else {
                continue;
            }
            (self.torn[h.index()], self.torn[twin.index()]) = (tears, tears);
        }
    }

    /// Lists the half-edges around the origin of `h` at rest, counter-clockwise, from the border if there is one.
    fn ring_at_rest(&self, h: HalfEdgeId, ring: &mut Vec<HalfEdgeId>) {
        let mut first = h;
        while let Some(before) = self.rest_twin(first).map(HalfEdgeId::next) {
            if before == h {
                break;
            }
            first = before;
        }
        // Around an inner vertex that walk ends beside `h`, and this one takes the same faces.
        ring.clear();
        ring.extend(self.rest_fan(first));
    }

    /// Appends a vertex at the place of `original`, without faces.
    fn append_vertex(&mut self, original: VertexId) -> VertexId {
        let v = VertexId::new(self.fans.len());
        self.fans.push(HalfEdgeId::NONE);
        self.originals.push(original);
        self.border.push(true);
        v
    }

    /// Gives the fan that begins at `first` to the vertex `v`.
    fn give_fan(&mut self, first: HalfEdgeId, v: VertexId) {
        self.fans[v.index()] = first;
        let mut next = Some(first);
        while let Some(h) = next {
            self.origins[h.index()] = v;
            next = self.bound_twin(h.previous()).filter(|&next| next != first);
        }
    }
}
