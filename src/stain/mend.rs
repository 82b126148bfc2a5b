//! Stains of a film that was mended in place.

use bevy_math::Vec3;

use super::{
    fields::{RustSource, StainFields},
    layer::StainLayer,
    update::openness_at,
};
use crate::film::{FilmMesh, HalfEdgeId, Mend, VertexId, direction::unit_or_zero};

impl StainFields {
    /// Makes these the stains of the film that was mended to `mesh`, as [`renew`](Self::renew) would. What is new is
    /// clean and dry, and so is the metal at each vertex that has nothing but new paint around it. Rust that was
    /// painted over counts as [dripped](super::RustBudget::dripped).
    pub(crate) fn mend(&mut self, mesh: &FilmMesh, mend: &Mend, gravity: Vec3) {
        let topology = &mesh.topology;
        for former in mend.before.iter().filter(|former| !former.kept) {
            self.budget.dripped += self.film.clean(former.vertex.index());
        }
        for &original in &mend.appended {
            self.append(original.index(), original, RustSource::Never);
        }
        for &[from, to] in &mend.moved {
            take(&mut self.film, from.index(), to.index());
            self.sources[to.index()] = self.sources[from.index()];
            self.dust_rates.take(from.index(), to.index());
        }
        for v in mend.fresh.iter().chain(&mend.left) {
            self.film.clean(v.index());
            self.sources[v.index()] = RustSource::Never;
        }
        for &place in &mend.places {
            let is_covered = self.duplicates.rest_fan(topology, place).all(|h| mend.is_new[h.face().index()]);
            if is_covered {
                self.budget.dripped += self.metal.clean(place.index());
                self.corrosion[place.index()] = 0.0;
            }
            self.measure_place(mesh, place);
            self.flow.mark_stale(&self.duplicates, place);
        }
        for &v in &mend.originals {
            let openness = openness_at(topology, &self.duplicates, v);
            let before = std::mem::replace(&mut self.openness[v.index()], openness);
            if before == 0.0 && openness > 0.0 {
                self.open.push(v.0);
            }
            if mend.places.binary_search(&v).is_err() {
                self.flow.mark_renamed(&self.duplicates, v);
            }
        }
        let openness = &self.openness;
        self.open.retain(|&v| openness[v as usize] > 0.0);
        self.connect_cracks(mesh, unit_or_zero(gravity));
        self.revise();
    }

    /// Measures the areas of the film vertices at a place again: those of a whole place as on a fresh film.
    fn measure_place(&mut self, mesh: &FilmMesh, place: VertexId) {
        let topology = &mesh.topology;
        let Self { film, duplicates, dust_rates, .. } = self;
        let area = |h: HalfEdgeId| mesh.geometry.rest_area_of(topology, h.face());
        let is_broken =
            |h: HalfEdgeId| topology.is_torn(h) || topology.is_torn(h.previous()) || !topology.is_live(h.face());
        let is_whole = !duplicates.rest_fan(topology, place).any(is_broken);
        for v in duplicates.of(place) {
            film.areas[v.index()] = if is_whole && v == place {
                let mut sides: Vec<HalfEdgeId> = topology.fan(v).collect();
                sides.sort_unstable();
                sides.into_iter().fold(0.0, |sum, h| sum + area(h) / 3.0)
            } else {
                topology.fan(v).map(area).sum::<f32>() / 3.0
            };
            dust_rates.mark_stale(v);
        }
    }

    /// Finds again where all cracks drain to: what has been added up cannot be taken apart.
    fn connect_cracks(&mut self, mesh: &FilmMesh, gravity: Vec3) {
        let topology = &mesh.topology;
        self.catchments.clear();
        // Few of all edges are torn: a pass over the flags alone.
        let torn = topology.torn().iter().enumerate().filter(|(_, torn)| **torn).map(|(h, _)| HalfEdgeId::new(h));
        for h in torn.filter(|&h| topology.edge(h) == h) {
            let ends = [topology.origin(h), topology.target(h)].map(|v| topology.original(v));
            self.catchments.drain(mesh, ends, gravity, mesh.geometry.rest_lengths[h.index()]);
        }
    }
}

/// Gives a vertex the stains of another.
fn take(layer: &mut StainLayer, from: usize, to: usize) {
    layer.wet[to] = layer.wet[from];
    layer.stained[to] = layer.stained[from];
    layer.dust[to] = layer.dust[from];
    layer.moisture[to] = layer.moisture[from];
}

#[cfg(test)]
impl StainFields {
    /// Returns the openness of the metal, and the vertices at which it is open in ascending order.
    pub(crate) fn open_metal(&self) -> (Vec<f32>, Vec<u32>) {
        let mut open = self.open.clone();
        open.sort_unstable();
        (self.openness.clone(), open)
    }

    /// Returns the lengths of the cracks that drain to each place.
    pub(crate) fn crack_lengths(&self) -> Vec<f32> {
        self.catchments.lengths.clone()
    }
}
