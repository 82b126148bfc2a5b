//! Which vertices of the fronts stand for which corners, edges and faces of the film.

use std::sync::Arc;

use super::{FINE_PIECE, base::Base, layout::Role, runs::Runs};
use crate::appearance::{face_slots::FaceSlots, part::MeshPart, seen::differences::Differences, wedges::Wedges};
use crate::{
    film::{FaceId, HalfEdgeId, Topology},
    rest::{Rest, pieces},
};

/// Vertices of the fronts of all slots.
///
/// Faces share the vertices along an edge that is bound, and those at a corner. When an edge tears, one of its faces
/// gets vertices of its own; nothing else is numbered afresh.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Skin {
    /// Wedges of each slot.
    pub wedges: Wedges,
    /// Vertex of each wedge of each slot.
    corners: Vec<Vec<u32>>,
    /// Inner vertices of each half-edge that has its own; vertices inside each face, and its triangles.
    runs: Runs,
    /// Half-edges with vertices that are new since the last update.
    pub new_edges: Vec<HalfEdgeId>,
    /// Faces with vertices inside that are new since the last update.
    pub new_faces: Vec<FaceId>,
    /// Faces whose triangles may have other corners.
    pub led: Vec<FaceId>,
    /// Faces that lost their triangles, with the indices that these had.
    pub gone: Vec<(FaceId, std::ops::Range<usize>)>,
}

impl Skin {
    /// Returns no vertices.
    pub fn new(base: &Base) -> Self {
        Self { wedges: Wedges::new(Arc::clone(base.wedges())), runs: Runs::new(&base.layout), ..Self::default() }
    }

    /// Gives what is new about the film its vertices in `parts`, and takes those of what is gone away.
    pub async fn follow(
        &mut self,
        topology: &Topology,
        face_slots: &FaceSlots,
        base: &Base,
        differences: &Differences,
        parts: &mut [MeshPart],
        rest: &mut impl Rest,
    ) {
        self.wedges.follow(topology, face_slots, differences);
        rest.rest().await;
        self.new_edges.clear();
        self.new_faces.clear();
        self.led.clear();
        self.gone.clear();
        if differences.whole {
            self.begin(topology, face_slots, base, parts, rest).await;
            return;
        }
        for &f in &differences.gone {
            let slot = face_slots.slot(f);
            if let Some(indices) = self.runs.release_face(f, slot, &mut parts[slot]) {
                self.gone.push((f, indices));
            }
        }
        let gone = differences.gone.iter().flat_map(|f| f.half_edges());
        let around = gone.flat_map(|h| [Some(h), topology.rest_twin(h)]).flatten();
        for h in around.chain(differences.tears.iter().copied()) {
            self.renew_edge(topology, face_slots, base, h, parts);
        }
        self.add_corners(parts);
        self.led.extend(self.wedges.changed.iter().chain(&self.new_edges).map(|h| h.face()));
        self.led.sort_unstable();
        self.led.dedup();
    }

    /// Forgets what was new in the last update, and the memory for it.
    pub fn forget(&mut self) {
        (self.new_edges, self.new_faces, self.led) = (Vec::new(), Vec::new(), Vec::new());
    }

    /// Gives all that is shown its vertices.
    async fn begin(
        &mut self,
        topology: &Topology,
        face_slots: &FaceSlots,
        base: &Base,
        parts: &mut [MeshPart],
        rest: &mut impl Rest,
    ) {
        let layout = &base.layout;
        self.corners.clear();
        self.corners.resize_with(parts.len(), Vec::new);
        self.runs.clear(topology.face_count(), parts.len());
        let is_shown = |f: FaceId| topology.is_live(f) && !face_slots.is_hidden(f);
        let owns = |&h: &HalfEdgeId| owner(topology, base, h) == h;
        // Counted first, so that the parts have room for no more than they hold.
        let mut counts: Vec<[usize; 2]> = (0..parts.len()).map(|slot| [self.wedges.slot(slot).film.len(), 0]).collect();
        for f in topology.all_faces().filter(|&f| is_shown(f)) {
            let [vertices, indices] = &mut counts[face_slots.slot(f)];
            *vertices +=
                layout.inner_points() + layout.edge_points() * f.half_edges().iter().filter(|h| owns(h)).count();
            *indices += 3 * layout.grid.triangles().len();
        }
        for (part, [vertices, indices]) in parts.iter_mut().zip(counts) {
            base.reserve(part, vertices, indices);
        }
        self.add_corners(parts);
        rest.rest().await;
        for piece in pieces(topology.face_count(), FINE_PIECE) {
            for f in piece.map(FaceId::new).filter(|&f| is_shown(f)) {
                let slot = face_slots.slot(f);
                for h in f.half_edges().into_iter().filter(owns) {
                    self.runs.take_edge(h, slot, &mut parts[slot]);
                    self.new_edges.push(h);
                }
                self.runs.take_face(f, slot, &mut parts[slot]);
                self.new_faces.push(f);
            }
            rest.rest().await;
        }
        self.led.extend_from_slice(&self.new_faces);
    }

    /// Gives the wedges that have no vertex yet theirs.
    fn add_corners(&mut self, parts: &mut [MeshPart]) {
        for (slot, (corners, part)) in self.corners.iter_mut().zip(parts).enumerate() {
            let new = self.wedges.slot(slot).film.len() - corners.len();
            let first = part.positions.len();
            part.grow_to(first + new);
            corners.extend((first..first + new).map(|vertex| vertex as u32));
        }
    }

    /// Gives `h` vertices of its own, or takes them away, as it should have.
    fn renew_edge(
        &mut self,
        topology: &Topology,
        face_slots: &FaceSlots,
        base: &Base,
        h: HalfEdgeId,
        parts: &mut [MeshPart],
    ) {
        let (f, slot) = (h.face(), face_slots.slot(h.face()));
        let wanted = topology.is_live(f) && !face_slots.is_hidden(f) && owner(topology, base, h) == h;
        match (wanted, self.edge(h).is_some()) {
            (true, false) => {
                self.runs.take_edge(h, slot, &mut parts[slot]);
                self.new_edges.push(h);
            }
            (false, true) => self.runs.release_edge(h, slot),
            _ => {}
        }
    }

    /// Returns the vertex of a wedge of a slot.
    #[inline]
    pub fn wedge(&self, slot: usize, wedge: usize) -> usize {
        self.corners[slot][wedge] as usize
    }

    /// Returns the vertex at the corner at the start of `h`.
    #[inline]
    pub fn corner(&self, slot: usize, h: HalfEdgeId) -> usize {
        self.wedge(slot, self.wedges.vertex_of(h) as usize)
    }

    /// Returns the inner vertices of the edge of `h`, counted along it, if it has its own.
    #[inline]
    pub fn edge(&self, h: HalfEdgeId) -> Option<std::ops::Range<usize>> {
        self.runs.edge(h)
    }

    /// Returns the vertices inside `f`, if it is shown.
    #[inline]
    pub fn inside(&self, f: FaceId) -> Option<std::ops::Range<usize>> {
        self.runs.inside(f)
    }

    /// Returns the indices of the triangles of `f`, if it is shown.
    pub fn triangles(&self, f: FaceId) -> Option<std::ops::Range<usize>> {
        self.runs.triangles(f)
    }

    /// Lists the vertices at the points of the grid of `f`, which is shown.
    pub fn list(&self, topology: &Topology, base: &Base, slot: usize, f: FaceId, vertices: &mut Vec<u32>) {
        let corner = |h| self.corner(slot, h);
        let edge = |h| self.edge(h).map_or(0, |range| range.start);
        let inside = self.inside(f).map_or(0, |range| range.start);
        list(topology, base, f, corner, edge, inside, vertices);
    }
}

/// Lists the vertices at the points of the grid of `f`, by the vertices of the corners at the starts of half-edges, the
/// first ones of the edges that own theirs, and the first one inside.
pub(super) fn list(
    topology: &Topology,
    base: &Base,
    f: FaceId,
    corner: impl Fn(HalfEdgeId) -> usize,
    edge: impl Fn(HalfEdgeId) -> usize,
    inside: usize,
    vertices: &mut Vec<u32>,
) {
    list_by(base, f, f.half_edges().map(|h| owner(topology, base, h)), corner, edge, inside, vertices);
}

/// Does the same for a film at rest.
pub(super) fn list_at_rest(
    topology: &Topology,
    base: &Base,
    f: FaceId,
    corner: impl Fn(HalfEdgeId) -> usize,
    edge: impl Fn(HalfEdgeId) -> usize,
    inside: usize,
    vertices: &mut Vec<u32>,
) {
    list_by(base, f, f.half_edges().map(|h| base.lead(topology, h)), corner, edge, inside, vertices);
}

fn list_by(
    base: &Base,
    f: FaceId,
    owners: [HalfEdgeId; 3],
    corner: impl Fn(HalfEdgeId) -> usize,
    edge: impl Fn(HalfEdgeId) -> usize,
    inside: usize,
    vertices: &mut Vec<u32>,
) {
    let last = base.layout.edge_points().saturating_sub(1);
    let half_edges = f.half_edges();
    let firsts = owners.map(edge);
    vertices.clear();
    vertices.extend(base.layout.roles.iter().map(|role| {
        let vertex = match *role {
            Role::Corner(k) => corner(half_edges[k]),
            Role::Edge(k, i) if owners[k] == half_edges[k] => firsts[k] + i,
            Role::Edge(k, i) => firsts[k] + last - i,
            Role::Inside(i) => inside + i,
        };
        vertex as u32
    }));
}

/// Returns the half-edge whose vertices stand for the edge of `h`: one of the two where both faces share them.
#[inline]
pub(super) fn owner(topology: &Topology, base: &Base, h: HalfEdgeId) -> HalfEdgeId {
    match topology.bound_twin(h) {
        Some(t) if t < h && base.is_joined(h) && topology.is_live(t.face()) => t,
        _ => h,
    }
}
