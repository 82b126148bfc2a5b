//! Parts of the solvers on their own, for benches.

use super::FilmConstraints;
use crate::{
    deform::packed::level::SimdLevel,
    film::{FilmMesh, Geometry},
};

impl FilmConstraints {
    /// Projects every active bend constraint once, as sweeps of the packed solver do, without moving the film.
    pub fn sweep_bends(&mut self, level: SimdLevel) {
        self.packed.sweep_bends(level);
    }

    /// Projects every active length constraint once, as sweeps of the packed solver do, without moving the film.
    pub fn sweep_lengths(&mut self, level: SimdLevel) {
        self.packed.sweep_lengths(level);
    }

    /// Brings the plain solver up to date with the constraints and their targets.
    pub fn follow_plainly(&mut self, mesh: &FilmMesh) {
        self.plain.follow(mesh, &self.ledger, &self.packed);
    }

    /// Sweeps once with the plain solver, which [`follow_plainly`](Self::follow_plainly) has brought up to date. The
    /// packed solver does not learn of it.
    pub fn sweep_plainly(&self, geometry: &mut Geometry) {
        self.plain.sweep(geometry);
    }
}
