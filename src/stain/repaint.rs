//! Stains of new paint on a film whose connectivity stays what it is.

use super::fields::{RustSource, StainFields};
use crate::film::{FilmMesh, Repaint};

impl StainFields {
    /// Cleans and dries the corners of new faces, and the metal at each that has nothing but new paint around it. Rust
    /// that was painted over counts as [dripped](super::RustBudget::dripped).
    pub(crate) fn repaint(&mut self, mesh: &FilmMesh, repaint: &Repaint) {
        for &v in &repaint.corners {
            let i = v.index();
            self.sources[i] = RustSource::Never;
            self.budget.dripped += self.film.clean(i);
            let is_covered = self.duplicates.rest_fan(&mesh.topology, v).all(|h| repaint.is_new[h.face().index()]);
            if is_covered {
                self.budget.dripped += self.metal.clean(i);
                self.corrosion[i] = 0.0;
            }
        }
        self.revise();
    }
}
