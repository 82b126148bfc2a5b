//! Keeps the forces in step with edits of the film mesh.

use bevy_math::Vec3;

use super::{drawn::Contraction, forces::FilmForces};
use crate::film::{FaceId, FilmPieces, HalfEdgeId, LoosePieces, Topology, VertexId};

impl FilmForces {
    /// Finds the connected pieces of the film if they are not known.
    pub(super) fn find_pieces(&mut self, topology: &Topology) {
        if !self.predictions.pieces.fits(topology) {
            self.predictions.pieces = FilmPieces::new(topology, |v| self.separated_age[v.index()] == f32::INFINITY);
            self.loose = LoosePieces::default();
        }
    }

    /// Appends a vertex with the forces of `v`. Neither of the two is a crack tip: a split vertex is a junction.
    pub(super) fn duplicate_vertex(&mut self, v: VertexId) {
        self.adhesion_drawn.push(self.adhesion_drawn[v.index()]);
        self.adhesion_by_hand.push(self.adhesion_by_hand[v.index()]);
        self.adhesion_lost_wet.push(self.adhesion_lost_wet[v.index()]);
        if !self.adhesion_share.is_empty() {
            self.adhesion_share.push(self.adhesion_share[v.index()]);
        }
        if !self.rebound.is_empty() {
            // It has separated, as its vertex has.
            self.rebound.push(false);
        }
        self.separated_age.push(self.separated_age[v.index()]);
        self.tips[v.index()] = Vec3::ZERO;
        self.tips.push(Vec3::ZERO);
    }

    /// Multiplies the contraction of `f` by `kept`.
    pub(super) fn relieve(&mut self, f: FaceId, kept: f32) {
        let (base, drawn) = (self.contraction(f) * kept - self.contraction_gained as f32, self.drawn.contraction);
        let share = self.contractions[f.index()].share * kept;
        self.contractions[f.index()] = Contraction { base, share, drawn };
    }

    /// Makes the edges at `v` due the next time that edges are judged, if both of their ends have separated.
    pub(super) fn make_edges_due(&mut self, topology: &Topology, v: VertexId) {
        // An edge that is bound lies between two faces of the fan, so one of its half-edges starts at `v`.
        for h in topology.fan(v).filter(|&h| topology.bound_twin(h).is_some()) {
            if !self.is_attached(topology.target(h)) {
                self.predictions.tears.make_due(topology.edge(h).0);
            }
        }
    }

    /// Sets how fast the binding of the edge of `h` decays, by the torn edges that its faces have now.
    pub(super) fn update_decay(&mut self, topology: &Topology, h: HalfEdgeId) {
        let edge = topology.edge(h);
        let binding = &mut self.bindings[edge.index()];
        let faces = if binding.decays() { topology.torn_faces(h) } else { 0 };
        if binding.torn_faces() != faces {
            binding.set_torn_faces(faces, self.binding_decay);
            self.predictions.tears.make_due(edge.0);
        }
    }
}
