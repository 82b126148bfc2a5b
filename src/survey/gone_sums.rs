//! Adds up the places where film is gone.

use bevy_math::Vec3;

use super::{covers, ratings::size::size_class, view::FilmView};
use crate::film::{FaceId, HalfEdgeId};

/// Extents in metres up to which a bare place belongs to the size classes 1 to 4 of ISO 4628-5; larger ones are class
/// 5. No place is so small that it would be class 0.
pub(super) const BARE_SIZES: [f64; 5] = [0.0, 1e-3, 3e-3, 10e-3, 30e-3];

/// Bare places of a film, with the buffers of finding them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct GoneSums {
    /// Area of removed faces around each original vertex, a third of each, in square metres. Empty while none are gone.
    pub weights: Vec<f32>,
    /// Area of the bare places in each size class, in square metres.
    pub areas: [f64; 6],
    /// Whether each face has been found.
    found: Vec<bool>,
    /// Faces of a place whose neighbours are still to be looked at.
    open: Vec<FaceId>,
}

impl GoneSums {
    /// Finds the places where film is gone: removed faces that lie side by side.
    pub fn find(&mut self, view: FilmView) {
        self.weights.clear();
        self.areas = [0.0; 6];
        let topology = &view.mesh.topology;
        if topology.removed_face_count() == 0 {
            return;
        }
        self.weights.resize(topology.original_vertex_count(), 0.0);
        self.found.clear();
        self.found.extend(topology.all_faces().map(|f| topology.is_live(f) || view.is_hidden(f)));
        for f in topology.all_faces() {
            if !self.found[f.index()] {
                let (area, extent) = self.flood(view, f);
                if let Some(sum) = self.areas.get_mut(size_class(extent, &BARE_SIZES) as usize) {
                    *sum += area;
                }
            }
        }
    }

    /// Finds the whole place at a removed face, and returns its area and extent at rest: the diagonal of its box.
    fn flood(&mut self, view: FilmView, first: FaceId) -> (f64, f64) {
        let topology = &view.mesh.topology;
        let (mut area, mut min, mut max) = (0.0, Vec3::INFINITY, Vec3::NEG_INFINITY);
        self.found[first.index()] = true;
        self.open.push(first);
        while let Some(f) = self.open.pop() {
            let own = view.mesh.geometry.rest_area_of(topology, f);
            area += f64::from(own);
            let corners = topology.corners(f);
            for p in view.at_rest(corners) {
                (min, max) = (min.min(p), max.max(p));
            }
            for v in view.metal(corners) {
                self.weights[v.index()] += own / 3.0;
            }
            for next in f.half_edges().iter().filter_map(|&h| topology.rest_twin(h)).map(HalfEdgeId::face) {
                if !std::mem::replace(&mut self.found[next.index()], true) {
                    self.open.push(next);
                }
            }
        }
        (area, f64::from(max.distance(min)))
    }

    /// Returns the area of rusted metal on the bare places, in square metres.
    pub fn rusted(&self, corrosion: &[f32]) -> f64 {
        let places = self.weights.iter().zip(corrosion).filter(|(weight, _)| **weight > 0.0);
        places.map(|(&weight, &corrosion)| f64::from(weight * covers::rusted(corrosion))).sum()
    }
}
