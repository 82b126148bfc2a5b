//! Wedges: corners at one vertex with the same attributes are one vertex of the shown mesh.

use super::{CornerAttributes, face_slots::FaceSlots};
use crate::film::{FilmMesh, HalfEdgeId, Topology};

/// Attributes closer than this are the same. Far below what shows; above the rounding of interpolation.
const SAME: f32 = 1e-4;

/// Which corners share a shown vertex.
#[derive(Clone, Debug, Default)]
pub(super) struct Wedges {
    /// Wedge of each corner at rest; corners of different vertices, slots or attributes differ.
    rest: Vec<u32>,
    /// Vertex of each corner now, in the front part of its slot.
    now: Vec<u32>,
    /// For each slot the corners that stand for its vertices.
    corners: Vec<Vec<HalfEdgeId>>,
    rest_count: usize,
}

impl Wedges {
    /// Finds the wedges of a film. `mesh` may have torn since it was at rest.
    pub fn new(mesh: &FilmMesh, attributes: &CornerAttributes, face_slots: &FaceSlots) -> Self {
        let topology = &mesh.topology;
        let mut by_vertex: Vec<HalfEdgeId> = topology.all_half_edges().collect();
        by_vertex.sort_unstable_by_key(|&h| (topology.original(topology.origin(h)), h));
        let mut rest = vec![u32::MAX; by_vertex.len()];
        let mut count = 0;
        for group in
            by_vertex.chunk_by(|&a, &b| topology.original(topology.origin(a)) == topology.original(topology.origin(b)))
        {
            for (i, &h) in group.iter().enumerate() {
                let slot = |h: HalfEdgeId| face_slots.slot(h.face());
                let same = group[..i].iter().find(|&&g| slot(g) == slot(h) && attributes.same(g, h));
                rest[h.index()] = same.map_or(count, |g| rest[g.index()]);
                count += u32::from(same.is_none());
            }
        }
        Self { rest, rest_count: count as usize, ..Self::default() }
    }

    /// The wedge of `h` at rest.
    pub fn at_rest(&self, h: HalfEdgeId) -> u32 {
        self.rest[h.index()]
    }

    /// Number of wedges at rest.
    pub fn rest_count(&self) -> usize {
        self.rest_count
    }

    /// Gives every wedge of every live vertex a vertex of its slot, in the order of vertices and of their fans.
    pub fn renew(&mut self, topology: &Topology, face_slots: &FaceSlots) {
        let Self { rest, now, corners, .. } = self;
        corners.resize_with(face_slots.slot_count(), Vec::new);
        corners.iter_mut().for_each(Vec::clear);
        now.clear();
        now.resize(topology.half_edge_count(), u32::MAX);
        for v in topology.all_vertices() {
            let mut before = HalfEdgeId::NONE;
            for (i, h) in topology.fan(v).enumerate() {
                let wedge = rest[h.index()];
                // Mostly that of the corner before.
                let same = before
                    .get()
                    .filter(|g| rest[g.index()] == wedge)
                    .or_else(|| topology.fan(v).take(i).find(|g| rest[g.index()] == wedge));
                now[h.index()] = if let Some(g) = same {
                    now[g.index()]
                } else {
                    let corners = &mut corners[face_slots.slot(h.face())];
                    corners.push(h);
                    corners.len() as u32 - 1
                };
                before = h;
            }
        }
    }

    /// The corners that stand for the vertices of a slot's front.
    pub fn corners(&self, slot: usize) -> &[HalfEdgeId] {
        self.corners.get(slot).map_or(&[], Vec::as_slice)
    }

    /// The vertex of `h` in the front part of its slot.
    pub fn vertex_of(&self, h: HalfEdgeId) -> u32 {
        self.now[h.index()]
    }
}

impl CornerAttributes {
    /// Whether two corners look the same.
    fn same(&self, a: HalfEdgeId, b: HalfEdgeId) -> bool {
        let (a, b) = (a.index(), b.index());
        self.normals[a].abs_diff_eq(self.normals[b], SAME)
            && near(&self.uvs, a, b)
            && near(&self.uvs_1, a, b)
            && near(&self.tangents, a, b)
            && near(&self.colors, a, b)
    }
}

fn near<const N: usize, T: Copy + Into<[f32; N]>>(values: &[T], a: usize, b: usize) -> bool {
    values.is_empty() || values[a].into().iter().zip(values[b].into()).all(|(x, y)| (x - y).abs() <= SAME)
}
