//! Constraints of new paint on a film whose connectivity stays what it is.

use super::constraints::FilmConstraints;
use crate::film::{FilmMesh, VertexId};

impl FilmConstraints {
    /// Attaches vertices again, which lie at rest in `mesh`, and removes what constrains nothing any more: lengths
    /// between two vertices that are attached, and bends that no vertex beside them pushes. What is left bends on from
    /// the angles that it has, and wakes.
    pub(crate) fn attach(&mut self, mesh: &FilmMesh, attach: &[VertexId]) {
        if attach.is_empty() {
            return;
        }
        self.hold(&mesh.geometry, attach);
        let topology = &mesh.topology;
        for h in attach.iter().flat_map(|&v| topology.fan(v)) {
            for side in [h, h.previous()] {
                if self.is_attached(topology.origin(side)) && self.is_attached(topology.target(side)) {
                    self.remove_length(topology, topology.bound_twin(side).map_or(side, |twin| twin.min(side)));
                }
            }
            let opposite = h.next();
            let apexes = [Some(opposite), topology.bound_twin(opposite)].into_iter().flatten();
            if apexes.map(|side| topology.apex(side)).all(|apex| self.is_attached(apex)) {
                self.remove_bend(topology, topology.edge(opposite));
            }
        }
        for h in attach.iter().flat_map(|&v| topology.fan(v)) {
            self.wake(mesh, topology.target(h));
            self.wake(mesh, topology.apex(h));
            if let Some(twin) = topology.bound_twin(h.next()) {
                self.wake(mesh, topology.apex(twin));
            }
        }
        self.compact(topology);
    }
}
