//! Constraints of a film that was mended in place.

use super::{constraints::FilmConstraints, free_edges::mend_free_edges};
use crate::{
    film::{FilmMesh, HalfEdgeId, Mend, VertexId},
    settings::CoatingSettings,
};

impl FilmConstraints {
    /// Makes these the constraints of the film that was mended to `mesh`, as [`renew`](Self::renew) would: those on
    /// edges around the places that refer to other vertices now are made again, in the order of their edges. What goes
    /// on bending bends on from the angles that it has, towards its targets; what is new begins at rest. `is_attached`
    /// says which vertices the metal holds now.
    pub(crate) fn mend(
        &mut self,
        mesh: &FilmMesh,
        mend: &Mend,
        settings: &CoatingSettings,
        is_attached: impl Fn(VertexId) -> bool,
    ) {
        let topology = &mesh.topology;
        mend.appended.iter().for_each(|&original| self.duplicate(original));
        let is_new = |h: HalfEdgeId| mend.is_new_edge(topology, h);
        let angles: Vec<Option<[f32; 2]>> =
            mend.edges.iter().map(|&h| self.angles_of(topology, h).filter(|_| !is_new(h))).collect();
        let is_pulled = |h: HalfEdgeId| !(is_attached(topology.origin(h)) && is_attached(topology.target(h)));
        let is_pushed = |h: HalfEdgeId| !is_attached(topology.apex(h));
        for &h in &mend.edges {
            let bound = topology.bound_twin(h).filter(|_| topology.is_live(h.face()));
            for side in [Some(h), topology.rest_twin(h)].into_iter().flatten() {
                let carries = topology.is_live(side.face()) && (bound.is_none() || side == h);
                if !(carries && is_pulled(side) && self.is_length_of(topology, side)) {
                    self.remove_length(topology, side);
                }
                let bends = side == h && bound.is_some_and(|twin| is_pushed(h) || is_pushed(twin)) && !is_new(h);
                if !(bends && self.is_bend_of(topology, side)) {
                    self.remove_bend(topology, side);
                }
            }
        }
        self.mend_points(mesh, mend, &is_attached);
        // Before any constraint is placed, all around it move.
        for &f in mend.around.iter().filter(|&&f| topology.is_live(f)) {
            for v in topology.corners(f) {
                self.wake(mesh, v);
            }
        }
        // What lies beyond an edge around the places bends it as well, and may be all that the metal does not hold.
        for twin in mend.edges.iter().flat_map(|&h| [Some(h), topology.bound_twin(h)]).flatten() {
            if topology.is_live(twin.face()) {
                self.wake(mesh, topology.apex(twin));
            }
        }
        for &v in mend.here.iter().filter(|&&v| !is_attached(v)) {
            self.unpark_around(mesh, v);
        }
        for (&h, angles) in mend.edges.iter().zip(angles) {
            for side in [Some(h), topology.rest_twin(h)].into_iter().flatten() {
                if !topology.is_live(side.face()) {
                    continue;
                }
                if is_pulled(side) {
                    self.ensure_length(mesh, side);
                }
                if is_pushed(side) {
                    self.ensure_bend_at(mesh, side, angles);
                }
            }
        }
        self.compact(topology);
        mend_free_edges(mesh, self, settings, mend);
    }
}
