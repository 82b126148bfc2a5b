//! Codes the forces of a film for snapshots: how they differ from those of a fresh film.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use super::{
    drawn::Drawn,
    forces::{FilmForces, Neck},
};
use crate::{
    coding::{Coder, Damage, Differences, Odds, number},
    film::{FilmMesh, FilmPieces, Geometry, Grain, HalfEdgeId, LoosePieces, PieceScratch, Topology, VertexId},
    settings::{CoatingSettings, Rules},
};

/// Octaves of noise beyond which no film can have been drawn: many more than settings allow.
const MOST_OCTAVES: u32 = 64;

impl FilmForces {
    /// Codes the seed and the settings that the initial forces were drawn with: all that
    /// [`redrawn`](Self::redrawn) needs.
    pub(crate) fn code_drawn<C: Coder>(&mut self, coder: &mut C) {
        let Drawn { seed, adhesion, binding, contraction, grain } = &mut self.drawn;
        coder.plain_long(seed);
        adhesion.iter_mut().chain(binding).for_each(|word| coder.plain_word(word));
        coder.plain_float(contraction);
        let mut length = grain.map_or(0.0, |grain| grain.length);
        coder.plain_float(&mut length);
        *grain = (length != 0.0).then_some(Grain { length });
        coder.plain_float(&mut self.gamma);
    }

    /// Returns the forces of a fresh film on `rest`, drawn as these were.
    ///
    /// # Errors
    /// [`Damage`] if there are no settings with which they can have been drawn.
    pub(crate) fn redrawn(&self, rest: &FilmMesh) -> Result<Self, Damage> {
        Ok(Self::new(rest, &self.settings_drawn_with(&rest.geometry)?, self.drawn.seed))
    }

    /// Returns settings with which these forces can have been drawn on a film of this geometry.
    ///
    /// # Errors
    /// [`Damage`] if there are none.
    pub(super) fn settings_drawn_with(&self, geometry: &Geometry) -> Result<CoatingSettings, Damage> {
        let mut settings = CoatingSettings::default();
        let [mean, deviation, octaves, cycles] = self.drawn.adhesion;
        let cycles = f32::from_bits(cycles);
        let adhesion = &mut settings.adhesion;
        (adhesion.mean, adhesion.deviation) = (f32::from_bits(mean), f32::from_bits(deviation));
        adhesion.octaves = octaves;
        let tearing = &mut settings.tearing;
        [tearing.binding, tearing.weak_probability, tearing.weak_factor] = self.drawn.binding.map(f32::from_bits);
        tearing.contraction = self.drawn.contraction;
        match self.drawn.grain {
            Some(grain) => {
                adhesion.wavelength = cycles;
                (settings.scale.rules, settings.scale.grain) = (Rules::Grain, grain.length);
            }
            None => {
                adhesion.frequency = cycles;
                settings.scale.rules = Rules::Paper;
            }
        }
        settings.bending.gamma = self.gamma;
        // Settings may have been out of their ranges; but more octaves might never come to an end.
        if octaves > MOST_OCTAVES {
            return Err(Damage("the settings that it was drawn with"));
        }
        let drawn = Drawn::new(self.drawn.seed, geometry, &settings);
        if drawn == self.drawn { Ok(settings) } else { Err(Damage("the settings that it was drawn with")) }
    }

    /// Returns whether these were drawn as `other` was.
    pub(crate) fn is_drawn_like(&self, other: &Self) -> bool {
        self.drawn == other.drawn && self.gamma.to_bits() == other.gamma.to_bits()
    }

    /// Codes how these forces differ from `fresh`, those that they were drawn as. To read, begin with a clone of
    /// `fresh`. `topology` is that of the film as it is.
    ///
    /// # Errors
    /// [`Damage`] if a list that is read does not fit the film.
    pub(crate) fn code_state<C: Coder>(
        &mut self,
        fresh: &Self,
        topology: &Topology,
        coder: &mut C,
    ) -> Result<(), Damage> {
        if C::READS {
            for v in topology.all_vertices().skip(fresh.separated_age.len()) {
                self.duplicate_vertex(topology.original(v));
            }
        }
        let originals = topology.original_vertex_count();
        let lists = self.separated_age.split_at_mut_checked(originals);
        let (ages, later) = lists.ok_or(Damage("the ages at which it separated"))?;
        coder.few_floats(ages, "the ages at which it separated")?;
        // A vertex has separated before it is split.
        let age = |i: usize| ages.get(topology.original(VertexId::new(originals + i)).index());
        coder.floats(later, |i| age(i).copied().unwrap_or_default());
        let mut lists: [Differences; 3] = Default::default();
        let mut odds = Odds::default();
        for tip in &mut self.tips {
            let mut is_tip = *tip != bevy_math::Vec3::ZERO;
            coder.flag(&mut odds, &mut is_tip, false);
            if is_tip {
                coder.vector(&mut lists, tip, bevy_math::Vec3::ZERO);
            }
        }
        let torn = topology.all_edges().filter(|&h| topology.is_torn(h)).count();
        let mut counts = Differences::default();
        coder.word(&mut counts, &mut self.torn_edges, number(torn));
        let separated = self.separated_age.iter().take(originals).filter(|age| **age < f32::INFINITY).count();
        coder.word(&mut counts, &mut self.separations, number(separated));
        if C::READS && self.torn_edges.max(self.separations) as usize > topology.half_edge_count().max(originals) {
            return Err(Damage("a counter"));
        }
        self.code_vertices(fresh, topology, coder);
        for sum in [&mut self.adhesion_lost, &mut self.contraction_gained, &mut self.binding_decay] {
            coder.plain_double(sum);
        }
        self.code_faces(coder);
        let spared = coder.plain(u32::from(!self.contraction_spared.is_empty()), 1) != 0;
        if C::READS {
            self.contraction_spared = vec![0.0; if spared { self.contractions.len() } else { 0 }];
        }
        // All that was painted at once has the same.
        let mut list = Differences::default();
        let mut before = 0.0;
        for spared in &mut self.contraction_spared {
            coder.float(&mut list, spared, before);
            before = *spared;
        }
        self.code_bindings(fresh, topology, coder)?;
        self.code_loose(topology, coder)?;
        if C::READS {
            self.predictions.pieces = FilmPieces::new(topology, |v| self.is_attached(v));
            let mut loose = LoosePieces::default();
            loose.find(topology, &mut PieceScratch::default(), |v| self.is_attached(v));
            self.loose = loose;
        }
        Ok(())
    }

    fn code_vertices<C: Coder>(&mut self, fresh: &Self, topology: &Topology, coder: &mut C) {
        let drawn = |i: usize| fresh.adhesion_drawn.get(topology.original(VertexId::new(i)).index());
        coder.floats(&mut self.adhesion_drawn, |i| drawn(i).copied().unwrap_or_default());
        coder.floats(&mut self.adhesion_lost_wet, |_| 0.0);
        let mut odds = Odds::default();
        self.adhesion_by_hand.iter_mut().for_each(|by_hand| coder.flag(&mut odds, by_hand, false));
        let vertices = self.adhesion_drawn.len();
        let is_scaled = coder.plain(u32::from(!self.adhesion_share.is_empty()), 1) != 0;
        let was_renewed = coder.plain(u32::from(!self.rebound.is_empty()), 1) != 0;
        if C::READS {
            self.adhesion_share = vec![1.0; if is_scaled { vertices } else { 0 }];
            self.rebound = vec![false; if was_renewed { vertices } else { 0 }];
        }
        coder.floats(&mut self.adhesion_share, |_| 1.0);
        let mut odds = Odds::default();
        self.rebound.iter_mut().for_each(|rebound| coder.flag(&mut odds, rebound, false));
    }

    fn code_faces<C: Coder>(&mut self, coder: &mut C) {
        let drawn = self.drawn.contraction;
        let mut lists: [Differences; 3] = Default::default();
        for face in &mut self.contractions {
            coder.float(&mut lists[0], &mut face.drawn, drawn);
            coder.float(&mut lists[1], &mut face.share, 1.0);
            coder.float(&mut lists[2], &mut face.base, face.drawn);
        }
    }

    /// Codes the bindings of edges: they are at their lower half-edges.
    fn code_bindings<C: Coder>(&mut self, fresh: &Self, topology: &Topology, coder: &mut C) -> Result<(), Damage> {
        let mut lists: [Differences; 3] = Default::default();
        let mut odds = [Odds::default(); 2];
        for h in topology.all_edges() {
            let both = (self.bindings.get_mut(h.index()), fresh.bindings.get(h.index()));
            let (Some(binding), Some(fresh)) = both else { return Err(Damage("a binding")) };
            coder.float(&mut lists[0], &mut binding.drawn, fresh.drawn);
            coder.flag(&mut odds[0], &mut binding.by_hand, false);
            coder.flag(&mut odds[1], &mut binding.decays, fresh.decays);
            let mut faces = u32::from(binding.torn_faces);
            let expected = if binding.decays { u32::from(topology.torn_faces(h)) } else { 0 };
            coder.word(&mut lists[1], &mut faces, expected);
            binding.torn_faces = u8::try_from(faces).map_err(|_| Damage("a binding"))?;
            // Nothing is lost where nothing has torn for a while.
            coder.float(&mut lists[2], &mut binding.share, 1.0);
        }
        let edges: Vec<HalfEdgeId> = topology.all_edges().collect();
        let mut since: Vec<f32> = edges.iter().filter_map(|h| Some(self.bindings.get(h.index())?.since)).collect();
        // A tear counts for all edges of its two faces at once.
        let mut places = vec![0u32; topology.half_edge_count()];
        let beside = |i: usize, places: &mut Vec<u32>, before: Option<u32>| {
            let last = i.checked_sub(1).and_then(|i| places.get_mut(edges.get(i)?.index()));
            if let (Some(last), Some(place)) = (last, before) {
                *last = place;
            }
            let h = *edges.get(i)?;
            let sides = [Some(h), topology.rest_twin(h)].into_iter().flatten();
            let others = sides.flat_map(|side| [side.next(), side.previous()]).map(|other| topology.edge(other));
            others.filter(|&other| other < h).filter_map(|other| places.get(other.index()).copied()).max()
        };
        coder.few_floats_by(&mut since, |i, before| beside(i, &mut places, before), "the decay of a binding")?;
        for (&h, since) in edges.iter().zip(since) {
            if let Some(binding) = self.bindings.get_mut(h.index()) {
                binding.since = since;
            }
        }
        Ok(())
    }

    fn code_loose<C: Coder>(&mut self, topology: &Topology, coder: &mut C) -> Result<(), Damage> {
        let (faces, vertices) = (topology.face_count(), topology.vertex_count());
        let known = coder.length(self.loose_since.len(), faces, "the ages at which pieces came loose")?;
        let necks = coder.length(self.necks.len(), topology.half_edge_count(), "the number of its necks")?;
        if C::READS {
            self.loose_since.resize(known, f32::INFINITY);
            self.necks.resize(necks, Neck { at: VertexId(0), held_by: [VertexId(0); 2] });
        }
        coder.few_floats(&mut self.loose_since, "the ages at which pieces came loose")?;
        let (mut lists, mut before): ([Differences; 3], _) = (Default::default(), 0);
        for Neck { at, held_by: [a, b] } in &mut self.necks {
            let [at_list, a_list, b_list] = &mut lists;
            coder.word(at_list, &mut at.0, before);
            coder.word(a_list, &mut a.0, at.0);
            coder.word(b_list, &mut b.0, a.0);
            before = at.0;
            if [at, a, b].into_iter().any(|v| v.index() >= vertices) {
                return Err(Damage("a neck"));
            }
        }
        Ok(())
    }
}
