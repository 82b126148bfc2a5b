//! Constraints of a film of which parts were made new.

use super::{constraints::FilmConstraints, free_edges::follow_free_edges};
use crate::{
    film::{HalfEdgeId, Renewal, VertexId},
    settings::CoatingSettings,
};

impl FilmConstraints {
    /// Makes these the constraints of the film that `renewal` made out of theirs. What goes on bending bends on from
    /// the angles that it has, towards its targets; what is new begins at rest. `is_attached` says which vertices the
    /// metal holds now.
    pub(crate) fn renew(
        &mut self,
        renewal: &Renewal,
        settings: &CoatingSettings,
        is_attached: impl Fn(VertexId) -> bool,
    ) {
        let mesh = &renewal.mesh;
        let topology = &mesh.topology;
        let old = std::mem::replace(self, Self::new(&renewal.rest));
        self.settings_of(&old);
        for &duplicate in &renewal.fracture.duplicates {
            self.duplicate(topology.original(duplicate));
        }
        self.place_points(&mesh.geometry);
        for v in topology.all_vertices().filter(|&v| !is_attached(v)) {
            self.free(v);
        }
        let angles = |h: HalfEdgeId| old.angles_of(&renewal.rest.topology, h).filter(|_| !renewal.is_new_edge(h));
        for h in topology.all_half_edges().filter(|&h| topology.is_live(h.face())) {
            if !(is_attached(topology.origin(h)) && is_attached(topology.target(h))) {
                self.ensure_length(mesh, h);
            }
            if !is_attached(topology.apex(h)) {
                self.ensure_bend_at(mesh, h, angles(topology.edge(h)));
            }
        }
        self.forget(mesh, &renewal.fracture.removed);
        follow_free_edges(mesh, self, settings, &renewal.fracture);
    }
}
