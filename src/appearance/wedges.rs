//! Merges corners at one vertex that have the same attributes into one mesh vertex, called a wedge.

use super::{corners::CornerAttributes, face_slots::FaceSlots};
use crate::film::{FilmMesh, HalfEdgeId, Topology};

/// Largest difference between attributes that count as the same. It is far too small to be seen, and larger than the
/// rounding of interpolation.
const SAME: f32 = 1e-4;

/// Mesh vertex of each corner.
#[derive(Clone, Debug, Default)]
pub(super) struct Wedges {
    /// Wedge of each corner at rest. Corners of different vertices, slots or attributes have different wedges.
    rest: Vec<u32>,
    /// Current vertex of each corner in the front part of its slot.
    now: Vec<u32>,
    /// One corner for each vertex of each slot's front part.
    corners: Vec<Vec<HalfEdgeId>>,
    /// Number of wedges at rest.
    rest_count: usize,
}

impl Wedges {
    /// Finds the wedges of a film at rest; `mesh` may have torn since.
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

    /// Returns the wedge at rest of the corner at the start of `h`.
    pub fn at_rest(&self, h: HalfEdgeId) -> u32 {
        self.rest[h.index()]
    }

    /// Returns the number of wedges at rest.
    pub fn rest_count(&self) -> usize {
        self.rest_count
    }

    /// Numbers the vertices of each slot's front part: one for each wedge of each live vertex, in the order of vertices
    /// and of their fans.
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
                // Mostly the wedge of the corner before.
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

    /// Returns one corner for each vertex of a slot's front part.
    pub fn corners(&self, slot: usize) -> &[HalfEdgeId] {
        self.corners.get(slot).map_or(&[], Vec::as_slice)
    }

    /// Returns the vertex of the corner at the start of `h` in the front part of its slot.
    pub fn vertex_of(&self, h: HalfEdgeId) -> u32 {
        self.now[h.index()]
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
    values.is_empty() || values[a].into().iter().zip(values[b].into()).all(|(x, y)| (x - y).abs() <= SAME)
}
