//! Forces of a film of which parts were made new.

use bevy_math::Vec3;

use super::{
    adhesion::adhesion_at,
    drawn::Contraction,
    forces::{FilmForces, Neck},
    predictions::Predictions,
};
use crate::{
    coding::Damage,
    film::{FaceId, FilmPieces, LoosePieces, Origin, PieceScratch, Renewal, Topology, VertexId},
    settings::CoatingSettings,
};

impl FilmForces {
    /// Makes these the forces of the film that `renewal` made out of theirs. What is new has the forces of fresh paint
    /// now: those that were drawn there at first. What stays keeps its own.
    ///
    /// New paint is attached at every original vertex that it has a corner at, also where it ends. At its other corners
    /// it hangs on its neighbours, and counts as separated at `age`.
    ///
    /// # Errors
    /// [`Damage`] if the settings that the forces were drawn with were changed by hand so that there are none such.
    pub(crate) fn renew(&mut self, renewal: &Renewal, age: f32) -> Result<(), Damage> {
        let topology = &renewal.mesh.topology;
        let settings = self.settings_drawn_with(&renewal.rest.geometry)?;
        let old = std::mem::take(self);
        let originals = topology.original_vertex_count();
        let kept = |v: usize| match renewal.origins[v] {
            Origin::Kept(before) => Some(before.index()),
            Origin::New => None,
        };
        let original = |v: usize| topology.original(VertexId::new(v)).index();
        let lost = old.adhesion_lost as f32;
        let vertices = 0..topology.vertex_count();
        // An attached vertex of new paint has lost nothing yet of what all have.
        let adhesion_lost_wet = vertices.clone().map(|v| kept(v).map_or(-lost, |before| old.adhesion_lost_wet[before]));
        let separated_age = vertices.clone().map(|v| match kept(v) {
            // No duplicate is ever attached: one that new paint has taken the place of lets go.
            Some(before) if v < originals || old.separated_age[before] < f32::INFINITY => old.separated_age[before],
            None if v < originals => f32::INFINITY,
            _ => age,
        });
        let rest = &renewal.rest.geometry.rest_positions;
        let places = vertices.clone().filter(|&v| kept(v).is_none()).map(|v| rest[original(v)]);
        let mut fresh = adhesion_at(rest, places, &settings.adhesion, old.drawn.grain, old.drawn.seed);
        let adhesion_drawn = vertices.clone().map(|v| match kept(v) {
            Some(before) => old.adhesion_drawn[before],
            None => fresh.next().unwrap_or_default(),
        });
        let shares = if old.adhesion_share.is_empty() { 0..0 } else { vertices.clone() };
        let adhesion_share = shares.map(|v| kept(v).map_or(1.0, |before| old.adhesion_share[before]));
        let rebound = vertices.clone().map(|v| match kept(v) {
            Some(before) => v < originals && old.rebound.get(before).copied().unwrap_or(false),
            None => v < originals,
        });
        let tips = vertices.clone().map(|v| match kept(v) {
            Some(before) if is_tip(topology, VertexId::new(v)) => old.tips[before],
            _ => Vec3::ZERO,
        });
        let mut new = Self {
            adhesion_lost_wet: adhesion_lost_wet.collect(),
            separated_age: separated_age.collect(),
            adhesion_drawn: adhesion_drawn.collect(),
            adhesion_by_hand: vertices.map(|v| kept(v).is_some_and(|before| old.adhesion_by_hand[before])).collect(),
            adhesion_share: adhesion_share.collect(),
            rebound: rebound.collect(),
            tips: tips.collect(),
            predictions: Predictions { rates: old.predictions.rates, ..Predictions::default() },
            ..old
        };
        let is_new = |f: &usize| renewal.faces[*f];
        new.renew_faces((0..renewal.faces.len()).filter(is_new).map(FaceId::new));
        new.renew_edges(renewal, &settings);
        new.renew_pieces(renewal);
        let is_separated = |age: &&f32| **age < f32::INFINITY;
        new.separations = new.separated_age.iter().take(originals).filter(is_separated).count() as u32;
        new.torn_edges = topology.all_edges().filter(|&h| topology.is_torn(h)).count() as u32;
        *self = new;
        Ok(())
    }

    /// Gives new faces the contraction of fresh paint.
    pub(super) fn renew_faces(&mut self, faces: impl Iterator<Item = FaceId>) {
        let (gained, drawn) = (self.contraction_gained as f32, self.drawn.contraction);
        self.contraction_spared.resize(self.contractions.len(), 0.0);
        for f in faces {
            self.contractions[f.index()] = Contraction { base: drawn - gained, share: 1.0, drawn };
            self.contraction_spared[f.index()] = gained;
            if let Some(since) = self.loose_since.get_mut(f.index()) {
                *since = f32::INFINITY;
            }
        }
    }

    /// Gives new edges their bindings, and has each decay by the torn edges beside it.
    fn renew_edges(&mut self, renewal: &Renewal, settings: &CoatingSettings) {
        let topology = &renewal.mesh.topology;
        let decay = self.binding_decay;
        let new = topology.all_edges().filter(|&h| renewal.is_new_edge(h));
        self.draw_fresh_bindings(&renewal.mesh, &settings.tearing, new, |forces, h, mut binding| {
            binding.set_torn_faces(if binding.decays() { topology.torn_faces(h) } else { 0 }, decay);
            forces.bindings[h.index()] = binding;
        });
        for h in topology.all_edges() {
            let binding = &mut self.bindings[h.index()];
            let faces = if binding.decays() { topology.torn_faces(h) } else { 0 };
            if binding.torn_faces() != faces {
                binding.set_torn_faces(faces, decay);
            }
        }
    }

    /// Finds connected pieces again, and the vertices of necks.
    fn renew_pieces(&mut self, renewal: &Renewal) {
        let topology = &renewal.mesh.topology;
        self.predictions.pieces = FilmPieces::new(topology, |v| self.separated_age[v.index()] == f32::INFINITY);
        let mut loose = LoosePieces::default();
        loose.find(topology, &mut PieceScratch::default(), |v| self.is_attached(v));
        self.loose = loose;
        if self.necks.is_empty() {
            return;
        }
        let mut now = vec![None; renewal.origins.len()];
        for (v, origin) in renewal.origins.iter().enumerate() {
            if let Origin::Kept(before) = origin
                && let Some(now) = now.get_mut(before.index())
            {
                *now = Some(VertexId::new(v));
            }
        }
        let vertex = |v: VertexId| now.get(v.index()).copied().flatten();
        let renamed =
            |Neck { at, held_by: [a, b] }: &Neck| Some(Neck { at: vertex(*at)?, held_by: [vertex(*a)?, vertex(*b)?] });
        self.necks = self.necks.iter().filter_map(renamed).collect();
    }
}

/// Returns whether one crack ends at `v`: it lies inside the film, and has exactly one torn edge.
fn is_tip(topology: &Topology, v: VertexId) -> bool {
    let mut fan = topology.fan(v);
    let Some(first) = fan.next() else { return false };
    let last = fan.last().unwrap_or(first);
    !topology.is_border(v) && topology.is_torn(first) && topology.rest_twin(first) == Some(last.previous())
}
