//! Checks the invariants of the forces.

use super::forces::FilmForces;
use crate::film::{InvariantError, Topology};

impl FilmForces {
    /// Checks the forces against the film that they belong to. For tests and debugging: takes time proportional to the
    /// size of the film.
    ///
    /// # Errors
    /// - [`InvariantError::ArrayLength`] if a field does not have one entry for each element of the film.
    /// - [`InvariantError::Decay`] if the binding of an edge does not decay once for each of its faces that has a torn
    ///   edge.
    /// - [`InvariantError::Pieces`] if the connected pieces that are known are not those that a search of the whole
    ///   film finds.
    ///
    /// ```
    /// use bevy_coating::{film::FilmMesh, fracture::FilmForces, settings::CoatingSettings};
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let mut forces = FilmForces::new(&mesh, &CoatingSettings::default(), 7);
    /// assert!(forces.validate(&mesh.topology).is_ok());
    /// forces.tips.pop();
    /// assert!(forces.validate(&mesh.topology).is_err());
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn validate(&self, topology: &Topology) -> Result<(), InvariantError> {
        let (vertices, half_edges) = (topology.vertex_count(), topology.half_edge_count());
        for (name, found, expected) in [
            ("adhesion_drawn", self.adhesion_drawn.len(), vertices),
            ("adhesion_by_hand", self.adhesion_by_hand.len(), vertices),
            ("adhesion_lost_wet", self.adhesion_lost_wet.len(), vertices),
            ("separated_age", self.separated_age.len(), vertices),
            ("tips", self.tips.len(), vertices),
            ("contraction", self.contractions.len(), topology.face_count()),
            ("bindings", self.bindings.len(), half_edges),
            ("bend_weights", self.bend_weights.len(), half_edges),
        ] {
            if found != expected {
                return Err(InvariantError::ArrayLength(name));
            }
        }
        for (name, found) in [("adhesion_share", self.adhesion_share.len()), ("rebound", self.rebound.len())] {
            if found != 0 && found != vertices {
                return Err(InvariantError::ArrayLength(name));
            }
        }
        let spared = self.contraction_spared.len();
        if spared != 0 && spared != topology.face_count() {
            return Err(InvariantError::ArrayLength("contraction_spared"));
        }
        for h in topology.all_edges() {
            let decaying = if self.bindings[h.index()].decays() { topology.torn_faces(h) } else { 0 };
            if self.bindings[h.index()].torn_faces() != decaying {
                return Err(InvariantError::Decay(h));
            }
        }
        let known = self.predictions.pieces.fits(topology);
        if known && !self.predictions.pieces.agrees(topology, &self.loose, |v| self.is_attached(v)) {
            return Err(InvariantError::Pieces);
        }
        Ok(())
    }

    /// Returns whether `v` was attached again with new paint and has not separated since.
    pub(crate) fn is_rebound(&self, v: crate::film::VertexId) -> bool {
        self.rebound.get(v.index()).copied().unwrap_or(false)
    }
}
