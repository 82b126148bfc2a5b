//! The constraints of a film, and the upkeep of their lists.

use bevy_math::Vec3;

use super::{BendConstraint, LengthConstraint};
use crate::film::{FilmMesh, HalfEdgeId, InvariantError, VertexId};

/// No constraint, in the slot arrays.
const NONE: u32 = u32::MAX;

/// Constraints of a film, sorted by half-edge: the order in which they are solved, which therefore does not
/// depend on the order in which they came to be.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmConstraints {
    /// Length constraints.
    pub lengths: Vec<LengthConstraint>,
    /// Bend constraints.
    pub bends: Vec<BendConstraint>,
    /// Inverse mass of each vertex: 0 attached, 1 separated.
    pub inverse_masses: Vec<f32>,
    /// Place in `lengths` of the constraint that each half-edge carries.
    length_slots: Vec<u32>,
    /// Place in `bends` of the constraint that each half-edge carries.
    bend_slots: Vec<u32>,
    /// Whether the lists need sorting and the slots renewing.
    dirty: bool,
}

impl FilmConstraints {
    /// No constraints: those of a fresh film, all of whose vertices are attached.
    pub fn new(mesh: &FilmMesh) -> Self {
        Self {
            inverse_masses: vec![0.0; mesh.topology.vertex_count()],
            length_slots: vec![NONE; mesh.topology.half_edge_count()],
            bend_slots: vec![NONE; mesh.topology.half_edge_count()],
            ..Self::default()
        }
    }

    /// The length constraint that `h` carries.
    pub fn length_of(&self, h: HalfEdgeId) -> Option<&LengthConstraint> {
        self.lengths.get(self.length_slots[h.index()] as usize)
    }

    /// The bend constraint that `h` carries.
    pub fn bend_of(&self, h: HalfEdgeId) -> Option<&BendConstraint> {
        self.bends.get(self.bend_slots[h.index()] as usize)
    }

    /// Puts a length constraint on the edge of `h`, or on `h` alone if the edge is torn; none twice.
    pub(super) fn ensure_length(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        let topology = &mesh.topology;
        let carrier = topology.bound_twin(h).map_or(h, |twin| twin.min(h));
        if self.length_slots[carrier.index()] != NONE || !topology.is_live(carrier.face()) {
            return;
        }
        self.length_slots[carrier.index()] = self.lengths.len() as u32;
        self.lengths.push(LengthConstraint {
            half_edge: carrier,
            ends: [topology.origin(carrier).0, topology.target(carrier).0],
            rest: mesh.geometry.rest_lengths[carrier.index()],
        });
        self.dirty = true;
    }

    /// Puts a bend constraint on the edge of `h`, starting at the current angle; none twice, and none on an
    /// edge that is torn or at the border.
    pub(super) fn ensure_bend(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        let Some(twin) = mesh.topology.bound_twin(h) else { return };
        let carrier = h.min(twin);
        if self.bend_slots[carrier.index()] != NONE || !mesh.topology.is_live(carrier.face()) {
            return;
        }
        let points = bend_points(mesh, carrier);
        let rest = points.map(|v| mesh.geometry.rest_positions[v as usize]);
        // A face folded to nothing has no angle now; its rest angle is what it comes from.
        let angle =
            mesh.geometry.dihedral(&mesh.topology, carrier).unwrap_or(mesh.geometry.rest_dihedrals[carrier.index()]);
        self.bend_slots[carrier.index()] = self.bends.len() as u32;
        self.bends.push(BendConstraint::new(carrier, points, rest, angle));
        self.dirty = true;
    }

    /// Takes the length constraint off `h`.
    pub(super) fn remove_length(&mut self, h: HalfEdgeId) {
        if let Some(constraint) = self.lengths.get_mut(self.length_slots[h.index()] as usize) {
            constraint.half_edge = HalfEdgeId::NONE;
            self.length_slots[h.index()] = NONE;
            self.dirty = true;
        }
    }

    /// Takes the bend constraint off `h`.
    pub(super) fn remove_bend(&mut self, h: HalfEdgeId) {
        if let Some(constraint) = self.bends.get_mut(self.bend_slots[h.index()] as usize) {
            constraint.half_edge = HalfEdgeId::NONE;
            self.bend_slots[h.index()] = NONE;
            self.dirty = true;
        }
    }

    /// Makes the constraints that `h` carries, if any, refer to the vertices that it has now.
    pub(super) fn refresh(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        if let Some(constraint) = self.lengths.get_mut(self.length_slots[h.index()] as usize) {
            constraint.ends = [mesh.topology.origin(h).0, mesh.topology.target(h).0];
        }
        if let Some(constraint) = self.bends.get_mut(self.bend_slots[h.index()] as usize) {
            constraint.points = bend_points(mesh, h);
        }
    }

    /// Drops what was removed and restores the order.
    pub(super) fn settle(&mut self) {
        if !std::mem::take(&mut self.dirty) {
            return;
        }
        self.lengths.retain(|c| c.half_edge != HalfEdgeId::NONE);
        self.lengths.sort_unstable_by_key(|c| c.half_edge);
        for (slot, c) in self.lengths.iter().enumerate() {
            self.length_slots[c.half_edge.index()] = slot as u32;
        }
        self.bends.retain(|c| c.half_edge != HalfEdgeId::NONE);
        self.bends.sort_unstable_by_key(|c| c.half_edge);
        for (slot, c) in self.bends.iter().enumerate() {
            self.bend_slots[c.half_edge.index()] = slot as u32;
        }
    }

    /// Checks the constraints against the film from scratch: which there must be, and what they refer to.
    ///
    /// # Errors
    /// The first [`InvariantError`] found, in handle order.
    pub fn validate(&self, mesh: &FilmMesh, is_attached: impl Fn(VertexId) -> bool) -> Result<(), InvariantError> {
        let topology = &mesh.topology;
        if self.inverse_masses.len() != topology.vertex_count() {
            return Err(InvariantError::ArrayLength("inverse_masses"));
        }
        for v in topology.all_vertices().filter(|&v| topology.has_faces(v)) {
            if (self.inverse_masses[v.index()] == 0.0) != is_attached(v) {
                return Err(InvariantError::InverseMass(v));
            }
        }
        let (mut lengths, mut bends) = (0, 0);
        for h in topology.all_half_edges().filter(|&h| topology.is_live(h.face())) {
            let carries = topology.bound_twin(h).is_none_or(|twin| h < twin);
            let (a, b) = (topology.origin(h), topology.target(h));
            let length = carries && !(is_attached(a) && is_attached(b));
            let pushed = |h: HalfEdgeId| !is_attached(topology.apex(h));
            let bend = carries && topology.bound_twin(h).is_some_and(|twin| pushed(h) || pushed(twin));
            let right_length = self.length_of(h).is_some_and(|c| c.half_edge == h && c.ends == [a.0, b.0]);
            let right_bend = self.bend_of(h).is_some_and(|c| c.half_edge == h && c.points == bend_points(mesh, h));
            if self.length_of(h).is_some() != length
                || self.bend_of(h).is_some() != bend
                || length != right_length
                || bend != right_bend
            {
                return Err(InvariantError::Constraint(h));
            }
            lengths += usize::from(length);
            bends += usize::from(bend);
        }
        if (lengths, bends) != (self.lengths.len(), self.bends.len()) {
            return Err(InvariantError::ArrayLength("constraints"));
        }
        Ok(())
    }

    /// Inverse masses and positions of the given points.
    #[inline]
    pub(super) fn gather<const N: usize>(&self, positions: &[Vec3], points: [u32; N]) -> ([Vec3; N], [f32; N]) {
        (points.map(|v| positions[v as usize]), points.map(|v| self.inverse_masses[v as usize]))
    }
}

/// p1, p2, p3, p4 of the bound edge that `h` carries.
fn bend_points(mesh: &FilmMesh, h: HalfEdgeId) -> [u32; 4] {
    let t = &mesh.topology;
    let tip = t.rest_twin(h).map_or(t.apex(h), |twin| t.apex(twin));
    [t.origin(h).0, t.target(h).0, t.apex(h).0, tip.0]
}
