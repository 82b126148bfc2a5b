//! Merges corners at one vertex that have the same attributes into one mesh vertex, called a wedge.

use std::sync::Arc;

use super::{corners::CornerAttributes, face_slots::FaceSlots, seen::differences::Differences};
use crate::film::{FilmMesh, HalfEdgeId, Topology, VertexId};

/// Largest difference between attributes that count as the same. It is far too small to be seen, and larger than the
/// rounding of interpolation.
const SAME: f32 = 1e-4;

/// Entry of a corner whose face is gone.
const NONE: u32 = u32::MAX;

/// Wedges of a film at rest.
#[derive(Clone, Debug, Default)]
pub(super) struct RestWedges {
    of: Vec<u32>,
    count: usize,
}

/// Vertex of each corner in the front part of its slot.
///
/// A vertex keeps its number while any corner stands for it, however the film tears. One that nothing stands for any
/// more is free for the next that comes.
#[derive(Clone, Debug, Default)]
pub(super) struct Wedges {
    rest: Arc<RestWedges>,
    /// Current vertex of each corner.
    now: Vec<u32>,
    /// Vertices of each slot.
    slots: Vec<SlotVertices>,
    /// Corners that stand for another vertex since the last update.
    pub changed: Vec<HalfEdgeId>,
    /// Vertices (slot and number) that may be left with no corner.
    suspects: Vec<(usize, u32)>,
}

/// Vertices of one slot's front part.
#[derive(Clone, Debug, Default)]
pub(super) struct SlotVertices {
    /// A corner that stands for each vertex; `NONE` where there is none.
    pub corners: Vec<HalfEdgeId>,
    /// Vertex of the film that each vertex follows.
    pub film: Vec<VertexId>,
    /// Vertices that are new since the last update.
    pub new: Vec<u32>,
    /// Vertices that no corner stands for.
    free: Vec<u32>,
}

impl RestWedges {
    /// Finds the wedges of a film at rest; `mesh` may have torn since. Corners of different vertices, slots, windings
    /// or attributes have different wedges.
    pub fn new(mesh: &FilmMesh, attributes: &CornerAttributes, face_slots: &FaceSlots) -> Self {
        let topology = &mesh.topology;
        let mut by_vertex: Vec<HalfEdgeId> = topology.all_half_edges().collect();
        by_vertex.sort_unstable_by_key(|&h| (topology.original(topology.origin(h)), h));
        let mut of = vec![u32::MAX; by_vertex.len()];
        let mut count = 0;
        for group in
            by_vertex.chunk_by(|&a, &b| topology.original(topology.origin(a)) == topology.original(topology.origin(b)))
        {
            for (i, &h) in group.iter().enumerate() {
                let alike = |g: HalfEdgeId| face_slots.are_alike(g.face(), h.face()) && attributes.same(g, h);
                let same = group[..i].iter().find(|&&g| alike(g));
                of[h.index()] = same.map_or(count, |g| of[g.index()]);
                count += u32::from(same.is_none());
            }
        }
        Self { of, count: count as usize }
    }

    /// Returns the wedge of the corner at the start of `h`.
    #[inline]
    pub fn at(&self, h: HalfEdgeId) -> u32 {
        self.of[h.index()]
    }

    /// Returns the number of wedges.
    pub fn count(&self) -> usize {
        self.count
    }
}

impl Wedges {
    /// Returns the vertices of a film with these wedges at rest, none until they first [follow](Self::follow).
    pub fn new(rest: Arc<RestWedges>) -> Self {
        Self { rest, ..Self::default() }
    }

    /// Returns the wedges at rest.
    pub fn at_rest(&self) -> &RestWedges {
        &self.rest
    }

    /// Returns the vertices of a slot's front part.
    pub fn slot(&self, slot: usize) -> &SlotVertices {
        &self.slots[slot]
    }

    /// Returns the vertex of the corner at the start of `h` in the front part of its slot.
    pub fn vertex_of(&self, h: HalfEdgeId) -> u32 {
        self.now[h.index()]
    }

    /// Gives the corners at vertices with other faces their own vertices.
    pub fn follow(&mut self, topology: &Topology, face_slots: &FaceSlots, differences: &Differences) {
        self.changed.clear();
        self.slots.iter_mut().for_each(|slot| slot.new.clear());
        if differences.whole {
            self.slots.clear();
            self.slots.resize_with(face_slots.slot_count(), SlotVertices::default);
            self.now.clear();
            self.now.resize(topology.half_edge_count(), NONE);
            topology.all_vertices().for_each(|v| self.number(topology, face_slots, v));
            return;
        }
        let Self { now, slots, suspects, .. } = self;
        suspects.clear();
        let gone = differences.gone.iter().flat_map(|f| f.half_edges());
        suspects.extend(gone.chain(differences.parted.iter().copied()).filter_map(|h| {
            let vertex = now[h.index()];
            (vertex != NONE).then(|| (face_slots.slot(h.face()), vertex))
        }));
        for h in differences.gone.iter().flat_map(|f| f.half_edges()) {
            now[h.index()] = NONE;
        }
        for &(slot, vertex) in suspects.iter() {
            slots[slot].corners[vertex as usize] = HalfEdgeId::NONE;
        }
        differences.vertices.iter().for_each(|&v| self.number(topology, face_slots, v));
        let Self { slots, suspects, .. } = self;
        for &(slot, vertex) in suspects.iter() {
            let SlotVertices { corners, film, free, .. } = &mut slots[slot];
            let follows = &mut film[vertex as usize];
            if corners[vertex as usize] == HalfEdgeId::NONE && *follows != VertexId::NONE {
                *follows = VertexId::NONE;
                free.push(vertex);
            }
        }
    }

    /// Gives the corners at `v` their vertices: one for each wedge, in the order of the fan. Those that follow `v`
    /// already stay.
    fn number(&mut self, topology: &Topology, face_slots: &FaceSlots, v: VertexId) {
        let Self { rest, now, slots, changed, .. } = self;
        for (i, h) in topology.fan(v).enumerate() {
            let slot = &mut slots[face_slots.slot(h.face())];
            let vertex = now[h.index()] as usize;
            if slot.film.get(vertex) != Some(&v) {
                let same = topology.fan(v).take(i).find(|&g| rest.at(g) == rest.at(h));
                now[h.index()] = same.map_or_else(|| slot.add(v), |g| now[g.index()]);
                changed.push(h);
            }
            let corner = &mut slot.corners[now[h.index()] as usize];
            if *corner == HalfEdgeId::NONE {
                *corner = h;
            }
        }
    }
}

impl SlotVertices {
    /// Adds a vertex that follows `v`, and returns its number.
    fn add(&mut self, v: VertexId) -> u32 {
        let Self { corners, film, new, free } = self;
        let vertex = free.pop().unwrap_or(film.len() as u32);
        if vertex as usize == film.len() {
            film.push(v);
            corners.push(HalfEdgeId::NONE);
        } else {
            film[vertex as usize] = v;
        }
        new.push(vertex);
        vertex
    }
}

impl CornerAttributes {
    /// Returns whether two corners have the same attributes.
    fn same(&self, a: HalfEdgeId, b: HalfEdgeId) -> bool {
        let (a, b) = (a.index(), b.index());
        self.normals[a].abs_diff_eq(self.normals[b], SAME)
            && near(&self.uvs, a, b)
            && near(&self.uvs_1, a, b)
            && near(&self.tangents, a, b)
            && near(&self.colors, a, b)
    }
}

/// Returns whether the values of corners `a` and `b` are the same; true if the prop does not have the attribute.
fn near<const N: usize, T: Copy + Into<[f32; N]>>(values: &[T], a: usize, b: usize) -> bool {
    values.is_empty() || are_same(values[a], values[b])
}

/// Returns whether two values of an attribute are the same.
pub(super) fn are_same<const N: usize, T: Into<[f32; N]>>(a: T, b: T) -> bool {
    a.into().iter().zip(b.into()).all(|(x, y)| (x - y).abs() <= SAME)
}
