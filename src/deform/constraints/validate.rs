//! Checks every invariant of a film's constraints.

use super::{FilmConstraints, NONE, PARKED, bend_points};
use crate::{
    deform::packed::Motion,
    film::{FilmMesh, HalfEdgeId, InvariantError, VertexId},
};

impl FilmConstraints {
    /// Checks the constraints against the film from scratch: which there must be, what they refer to, and that no two
    /// of a pack share a point.
    ///
    /// # Errors
    /// The first [`InvariantError`] found, in handle order.
    pub fn validate(&self, mesh: &FilmMesh, is_attached: impl Fn(VertexId) -> bool) -> Result<(), InvariantError> {
        let topology = &mesh.topology;
        if self.points.len() != topology.vertex_count() {
            return Err(InvariantError::ArrayLength("points"));
        }
        for v in topology.all_vertices().filter(|&v| topology.has_faces(v)) {
            if self.is_attached(v) != is_attached(v) || self.motion(v) == Motion::Gone {
                return Err(InvariantError::InverseMass(v));
            }
            let at = mesh.geometry.positions[v.index()];
            if !self.points_outdated && self.points.position(v.index()) != at {
                return Err(InvariantError::PointElsewhere(v));
            }
        }
        let asleep = topology.all_vertices().filter(|&v| self.is_asleep(v)).count();
        if asleep != self.points.asleep_count() {
            return Err(InvariantError::ArrayLength("sleepers"));
        }
        let mut counts = [0, 0];
        let mut users = vec![Vec::new(); self.regions.len()];
        for h in topology.all_half_edges().filter(|&h| topology.is_live(h.face())) {
            let carries = topology.bound_twin(h).is_none_or(|twin| h < twin);
            let (a, b) = (topology.origin(h), topology.target(h));
            let length = carries && !(is_attached(a) && is_attached(b));
            let pushed = |h: HalfEdgeId| !is_attached(topology.apex(h));
            let bend = carries && topology.bound_twin(h).is_some_and(|twin| pushed(h) || pushed(twin));
            let (length_lane, bend_lane) = (self.length_lanes[h.index()], self.bend_lanes[h.index()]);
            if (length_lane != NONE) != length || (bend_lane != NONE) != bend {
                return Err(InvariantError::Constraint(h));
            }
            counts[0] += usize::from(length);
            counts[1] += usize::from(bend);
            let region = self.region_index(topology, h);
            let moves = |points: &[u32]| points.iter().any(|&v| self.motion(VertexId(v)) == Motion::Awake);
            let mut right = true;
            if length {
                right &= (length_lane == PARKED) != moves(&[a.0, b.0]);
            }
            if length && length_lane != PARKED {
                let lane = self.regions[region].length(length_lane, &self.points);
                right &= lane.vertices == [a.0, b.0];
                users[region].extend(lane.vertices.map(|v| (0, length_lane / 32, v)));
            }
            if bend {
                right &= (bend_lane == PARKED) != moves(&bend_points(topology, h));
            }
            if bend && bend_lane != PARKED {
                let lane = self.regions[region].bend(bend_lane, &self.points);
                right &= lane.vertices == bend_points(topology, h) && lane.start == self.angles[h.index()][0];
                users[region].extend(lane.vertices.map(|v| (1, bend_lane / 32, v)));
            }
            if !right {
                return Err(InvariantError::Constraint(h));
            }
        }
        if counts != self.counts || self.carriers().map(Iterator::count) != self.counts {
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
