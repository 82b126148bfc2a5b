//! Stains of a film of which parts were made new.

use super::{
    environment::Environment,
    fields::{RustSource, StainFields},
    layer::StainLayer,
    sources::end_source,
    update::update_stains,
};
use crate::film::{FilmMesh, Origin, Renewal, VertexId};

impl StainFields {
    /// Makes these the stains of the film that `renewal` made out of theirs. What is new is clean and dry, and so is
    /// the metal at each vertex that has nothing but new paint around it. Rust that was painted over counts as
    /// [dripped](super::RustBudget::dripped).
    pub(crate) fn renew(&mut self, renewal: &Renewal, environment: &Environment) {
        let mesh = &renewal.mesh;
        let originals = mesh.topology.original_vertex_count();
        let mut new = Self::new(&renewal.rest);
        // Duplicates, areas, open metal, and where cracks drain to, as if all had torn just now.
        update_stains(mesh, &mut new, &renewal.fracture, environment.gravity);
        for (v, &origin) in renewal.origins.iter().enumerate() {
            let Origin::Kept(before) = origin else {
                new.sources[v] = RustSource::Never;
                continue;
            };
            new.sources[v] = self.sources[before.index()];
            if !mesh.topology.has_faces(VertexId::new(v)) {
                // A corner of faces that are gone. In a film that was mended, its name may be that of another fan now.
                end_source(&mut new.sources[v]);
            }
            take(&mut new.film, v, &self.film, before.index());
        }
        for v in 0..originals {
            if is_covered(renewal, &new, VertexId::new(v)) {
                continue;
            }
            take(&mut new.metal, v, &self.metal, v);
            new.corrosion[v] = self.corrosion[v];
        }
        new.exposure = std::mem::take(&mut self.exposure);
        new.streaks = self.streaks;
        new.damp = self.damp;
        new.revision = self.revision.wrapping_add(1);
        new.budget.emitted = self.budget.emitted;
        new.budget.dripped = self.budget.emitted - new.wet_amount() - new.stained_amount();
        new.budget.dripped = new.budget.dripped.max(0.0);
        new.flow_like(self, mesh);
        *self = new;
    }

    /// Begins run-off along the pull of `other`, wherever anything may run.
    fn flow_like(&mut self, other: &Self, mesh: &FilmMesh) {
        let (pull, spread, into_cracks) = (other.flow.pull, other.flow.spread, other.flow.into_cracks);
        self.flow.set_pull(mesh, pull, spread, into_cracks);
        for v in mesh.topology.all_vertices() {
            let original = mesh.topology.original(v);
            let is_wet = self.film.wet[v.index()] > 0.0 || self.metal.wet[original.index()] > 0.0;
            if is_wet || self.sources[v.index()] == RustSource::Present {
                self.flow.wake(original);
            }
        }
    }
}

/// Returns whether all faces that were ever at `original` are new.
fn is_covered(renewal: &Renewal, stains: &StainFields, original: VertexId) -> bool {
    let mut around = stains.duplicates.rest_fan(&renewal.mesh.topology, original).peekable();
    around.peek().is_some() && around.all(|h| renewal.faces[h.face().index()])
}

/// Takes the stains of a vertex over, but not its area.
fn take(to: &mut StainLayer, i: usize, from: &StainLayer, j: usize) {
    to.wet[i] = from.wet[j];
    to.stained[i] = from.stained[j];
    to.dust[i] = from.dust[j];
    to.moisture[i] = from.moisture[j];
}
