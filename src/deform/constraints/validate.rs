//! Checks every invariant of a film's constraints.

use super::FilmConstraints;
use crate::{
    deform::{
        bend::bend_points,
        packed::{pack::LANES, points::Motion},
    },
    film::{FilmMesh, HalfEdgeId, InvariantError, VertexId},
};

impl FilmConstraints {
    /// Checks the constraints against the film from scratch: which there must be, what they refer to, and that no two
    /// of a pack share a point. `is_attached` says which vertices the metal holds.
    ///
    /// # Errors
    /// Returns the first [`InvariantError`] found, in handle order.
    pub fn validate(&self, mesh: &FilmMesh, is_attached: impl Fn(VertexId) -> bool) -> Result<(), InvariantError> {
        let (topology, points) = (&mesh.topology, self.packed.points());
        if points.len() != topology.vertex_count() {
            return Err(InvariantError::ArrayLength("points"));
        }
        for v in topology.all_vertices().filter(|&v| topology.has_faces(v)) {
            if self.is_attached(v) != is_attached(v) || self.packed.motion(v) == Motion::Gone {
                return Err(InvariantError::InverseMass(v));
            }
            let at = mesh.geometry.positions[v.index()];
            if !self.packed.is_outdated() && points.position(v.index()) != at {
                return Err(InvariantError::PointElsewhere(v));
            }
        }
        let asleep = topology.all_vertices().filter(|&v| self.is_asleep(v)).count();
        if asleep != points.asleep_count() {
            return Err(InvariantError::ArrayLength("sleepers"));
        }
        let mut counts = [0, 0];
        let mut users = vec![Vec::new(); self.packed.region_count()];
        for h in topology.all_half_edges().filter(|&h| topology.is_live(h.face())) {
            let carries = topology.bound_twin(h).is_none_or(|twin| h < twin);
            let (a, b) = (topology.origin(h), topology.target(h));
            let length = carries && !(is_attached(a) && is_attached(b));
            let pushed = |h: HalfEdgeId| !is_attached(topology.apex(h));
            let bend = carries && topology.bound_twin(h).is_some_and(|twin| pushed(h) || pushed(twin));
            let (lengths, bends) = (self.ledger.lengths(), self.ledger.bends());
            if lengths.has(h) != length || bends.has(h) != bend {
                return Err(InvariantError::Constraint(h));
            }
            counts[0] += usize::from(length);
            counts[1] += usize::from(bend);
            let region = self.packed.region_index(topology, h);
            let moves = |points: &[u32]| points.iter().any(|&v| self.packed.motion(VertexId(v)) == Motion::Awake);
            let mut right = true;
            if length {
                right &= lengths.is_parked(h) != moves(&[a.0, b.0]);
            }
            if let Some(lane) = lengths.lane(h) {
                let held = self.packed.length_in(topology, h, lane);
                right &= held.vertices == [a.0, b.0];
                users[region].extend(held.vertices.map(|v| (0, lane / LANES as u32, v)));
            }
            if bend {
                right &= bends.is_parked(h) != moves(&bend_points(topology, h));
            }
            if let Some(lane) = bends.lane(h) {
                let held = self.packed.bend_in(topology, h, lane);
                right &= held.vertices == bend_points(topology, h) && held.start == self.ledger.start(h);
                users[region].extend(held.vertices.map(|v| (1, lane / LANES as u32, v)));
            }
            if !right {
                return Err(InvariantError::Constraint(h));
            }
        }
        let (lengths, bends) = (self.ledger.lengths(), self.ledger.bends());
        if counts != [lengths.count(), bends.count()] || counts != [lengths.iter().count(), bends.iter().count()] {
            return Err(InvariantError::ArrayLength("constraints"));
        }
        for users in &mut users {
            users.sort_unstable();
            if let Some(twice) = users.windows(2).find(|pair| pair[0] == pair[1]) {
                return Err(InvariantError::SharedPoint(VertexId(twice[0].2)));
            }
        }
        Ok(())
    }
}
