//! Codes the stains of a film for snapshots: how they differ from those of a fresh film. This is the only file that
//! knows what of the stains is kept and what follows from the rest.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use bevy_math::{Vec3, ops};

use super::{
    dust::rates::{Basis, DustRates},
    fields::{RustSource, StainFields},
    flow::Flow,
    shape::Shape,
};
use crate::{
    coding::{Coder, Damage, Differences, Odds},
    film::{FilmMesh, VertexId},
    settings::DustSettings,
};

impl StainFields {
    /// Codes how these stains differ from `fresh`, those of the same film at rest. To read, begin with a clone of
    /// `fresh`. `mesh` is the film as it is, and `age` its age.
    ///
    /// # Errors
    /// [`Damage`] if a list that is read does not fit the film.
    pub(crate) fn code_state<C: Coder>(
        &mut self,
        fresh: &Self,
        mesh: &FilmMesh,
        age: f32,
        coder: &mut C,
    ) -> Result<(), Damage> {
        let topology = &mesh.topology;
        let originals = topology.original_vertex_count();
        if C::READS {
            for v in topology.all_vertices().skip(originals) {
                let original = topology.original(v);
                self.film.duplicate(original.index());
                self.sources.push(RustSource::Never);
                self.duplicates.append(original);
                self.flow.append(original);
            }
        }
        self.code_open(originals, coder)?;
        self.code_areas(fresh, mesh, coder);
        self.dust_rates.code_state(mesh, coder)?;
        self.code_film(age, coder);
        self.code_metal(mesh, coder)?;
        self.code_sources(coder)?;
        self.code_catchments(coder)?;
        self.code_exposure(originals, coder)?;
        coder.plain_double(&mut self.budget.emitted);
        coder.plain_double(&mut self.budget.dripped);
        coder.plain_vector(&mut self.streaks);
        coder.plain_word(&mut self.revision);
        self.damp = coder.plain(u32::from(self.damp), 1) != 0;
        self.code_flow(mesh, coder)
    }

    fn code_open<C: Coder>(&mut self, originals: usize, coder: &mut C) -> Result<(), Damage> {
        coder.few_floats(&mut self.openness, "the openness of its metal")?;
        let count = coder.length(self.open.len(), originals, "its open metal")?;
        if C::READS {
            self.open.resize(count, 0);
        }
        let (mut list, mut before) = (Differences::default(), 0);
        for v in &mut self.open {
            coder.word(&mut list, v, before);
            before = *v;
            if before as usize >= originals {
                return Err(Damage("its open metal"));
            }
        }
        Ok(())
    }

    /// Codes areas. They follow from the film, but for the order in which they were added up.
    fn code_areas<C: Coder>(&mut self, fresh: &Self, mesh: &FilmMesh, coder: &mut C) {
        let topology = &mesh.topology;
        let mut list = Differences::default();
        for (i, area) in self.film.areas.iter_mut().enumerate() {
            let v = VertexId::new(i);
            let original = topology.original(v);
            let mut around = fresh.duplicates.rest_fan(topology, original);
            let touched =
                around.any(|h| topology.is_torn(h) || topology.is_torn(h.previous()) || !topology.is_live(h.face()));
            let expected = if touched {
                topology.fan(v).map(|h| mesh.geometry.rest_area_of(topology, h.face())).sum::<f32>() / 3.0
            } else {
                fresh.film.areas.get(original.index()).copied().unwrap_or_default()
            };
            coder.float(&mut list, area, expected);
        }
    }

    fn code_film<C: Coder>(&mut self, age: f32, coder: &mut C) {
        let rates = &self.dust_rates.rates;
        // As if the rate had been the same all the time.
        coder.floats(&mut self.film.dust, |i| 1.0 - ops::exp(-age * rates.get(i).copied().unwrap_or_default()));
        coder.floats(&mut self.film.moisture, |_| 0.0);
        coder.floats(&mut self.film.stained, |_| 0.0);
        coder.floats(&mut self.film.wet, |_| 0.0);
    }

    fn code_metal<C: Coder>(&mut self, mesh: &FilmMesh, coder: &mut C) -> Result<(), Damage> {
        coder.few_floats(&mut self.corrosion, "the corrosion of its metal")?;
        self.code_metal_dust(mesh, coder);
        for list in [&mut self.metal.moisture, &mut self.metal.stained, &mut self.metal.wet] {
            coder.floats(list, |_| 0.0);
        }
        Ok(())
    }

    /// Codes the dust of the metal. Like its corrosion it has grown with the time for which it has lain open, at a pace
    /// that has the same ratio to the rate everywhere.
    fn code_metal_dust<C: Coder>(&mut self, mesh: &FilmMesh, coder: &mut C) {
        let Self { metal, corrosion, dust_rates, duplicates, .. } = self;
        let (mut list, mut ratio) = (Differences::default(), 1.0);
        for ((i, dust), corrosion) in metal.dust.iter_mut().enumerate().zip(&*corrosion) {
            let v = VertexId::new(i);
            let open = -ops::ln(1.0 - corrosion);
            let mut expected = 0.0;
            let mut pace = 0.0;
            if let Some(basis) = &dust_rates.basis
                && open > 0.0
            {
                let shape = Shape::at_rest(mesh, v, duplicates.rest_fan(&mesh.topology, v));
                pace = basis.rate(mesh, v, shape) * open;
                expected = 1.0 - ops::exp(-pace * ratio);
            }
            coder.float(&mut list, dust, expected);
            let found = -ops::ln(1.0 - *dust) / pace;
            if found.is_finite() && found > 0.0 {
                ratio = found;
            }
        }
    }

    fn code_sources<C: Coder>(&mut self, coder: &mut C) -> Result<(), Damage> {
        const SOURCES: [RustSource; 3] = [RustSource::Never, RustSource::Present, RustSource::Past];
        let mut list = Differences::default();
        for source in &mut self.sources {
            let mut number = *source as u32;
            coder.word(&mut list, &mut number, 0);
            *source = *SOURCES.get(number as usize).ok_or(Damage("a source of rust"))?;
        }
        Ok(())
    }

    fn code_catchments<C: Coder>(&mut self, coder: &mut C) -> Result<(), Damage> {
        let drains = &mut self.catchments.drains;
        let mut list = Differences::default();
        for (drain, own) in drains.iter_mut().zip(0..) {
            coder.word(&mut list, drain, own);
        }
        coder.floats(&mut self.catchments.lengths, |_| 0.0);
        if C::READS && !ends_everywhere(&self.catchments.drains) {
            return Err(Damage("where its cracks drain to"));
        }
        Ok(())
    }

    fn code_exposure<C: Coder>(&mut self, originals: usize, coder: &mut C) -> Result<(), Damage> {
        for exposure in [&mut self.exposure.rain, &mut self.exposure.sun] {
            // Entries beyond the original vertices mean nothing.
            let count = coder.length(exposure.len().min(originals), originals, "its exposure")?;
            if C::READS {
                exposure.resize(count, 0.0);
            }
            coder.few_floats(exposure.get_mut(..count).unwrap_or_default(), "its exposure")?;
        }
        Ok(())
    }

    fn code_flow<C: Coder>(&mut self, mesh: &FilmMesh, coder: &mut C) -> Result<(), Damage> {
        let Flow { pull, spread, into_cracks, .. } = &self.flow;
        let (mut pull, mut spread, mut into_cracks) = (*pull, *spread, *into_cracks);
        coder.plain_vector(&mut pull);
        coder.plain_float(&mut spread);
        coder.plain_float(&mut into_cracks);
        if C::READS {
            // Sorts places as they were sorted then.
            self.flow.set_pull(mesh, pull, spread, into_cracks);
            (self.flow.pull, self.flow.spread, self.flow.into_cracks) = (pull, spread, into_cracks);
        }
        let [mut dry, mut wet] = [Odds::default(); 2];
        let Self { film, metal, sources, flow, .. } = self;
        let originals = (0..mesh.topology.original_vertex_count()).map(VertexId::new);
        for (((v, film), metal), &source) in originals.zip(&film.wet).zip(&metal.wet).zip(&*sources) {
            let is_wet = *film > 0.0 || *metal > 0.0 || source == RustSource::Present;
            let flows = flow.is_awake(v);
            if coder.bit(if is_wet { &mut wet } else { &mut dry }, flows) {
                flow.wake(v);
            }
        }
        Ok(())
    }
}

impl DustRates {
    fn code_state<C: Coder>(&mut self, mesh: &FilmMesh, coder: &mut C) -> Result<(), Damage> {
        let vertices = mesh.topology.vertex_count();
        coder.plain_float(&mut self.dt);
        let is_known = coder.plain(u32::from(self.basis.is_some()), 1) != 0;
        let none = Basis { gravity: Vec3::ZERO, settings: DustSettings::default(), foot: 0.0, extent: 0.0 };
        let mut basis = self.basis.take().unwrap_or(none);
        if is_known {
            let Basis { gravity, settings, foot, extent } = &mut basis;
            let DustSettings { rate, height, direction, curvature } = settings;
            coder.plain_vector(gravity);
            for number in [rate, height, direction, curvature, foot, extent] {
                coder.plain_float(number);
            }
        }
        let rates = coder.length(self.rates.len(), vertices, "the rates of its dust")?;
        let seen = coder.length(self.seen.len(), vertices, "the rates of its dust")?;
        let stale = coder.length(self.stale.len(), vertices, "the rates of its dust")?;
        if C::READS {
            self.rates.resize(rates, 0.0);
            self.seen.resize(seen, Vec3::ZERO);
            self.stale.resize(stale, false);
        }
        let positions = &mesh.geometry.positions;
        let rests = &mesh.geometry.rest_positions;
        let mut lists = Default::default();
        let mut odds = [Odds::default(); 2];
        let bits = |p: Vec3| p.to_array().map(f32::to_bits);
        for ((seen, &position), &rest) in self.seen.iter_mut().zip(positions).zip(rests) {
            if coder.bit(&mut odds[0], bits(*seen) == bits(position)) {
                *seen = position;
            } else if coder.bit(&mut odds[1], bits(*seen) == bits(rest)) {
                *seen = rest;
            } else {
                coder.vector_along(&mut lists, seen, position, position - rest);
            }
        }
        let mut odds = Odds::default();
        self.stale.iter_mut().for_each(|stale| coder.flag(&mut odds, stale, false));
        let rate = |i: usize| basis.rate(mesh, VertexId::new(i), Shape::now(mesh, VertexId::new(i)));
        coder.floats(&mut self.rates, rate);
        if C::READS {
            // Shares that are left follow; those of metal are found when they are needed.
            let dt = self.dt;
            self.left = self.rates.iter().map(|rate| ops::exp(-(rate * dt))).collect();
            self.metal.resize(mesh.topology.original_vertex_count(), [0.0; 2]);
        }
        self.basis = is_known.then_some(basis);
        Ok(())
    }
}

/// Returns whether every way along `drains` ends: at a place that drains to itself.
fn ends_everywhere(drains: &[u32]) -> bool {
    // Whether each place has been seen to end.
    let mut ends = vec![false; drains.len()];
    let mut way = Vec::new();
    for start in 0..drains.len() {
        let mut at = start;
        way.clear();
        while ends.get(at) == Some(&false) {
            way.push(at);
            match drains.get(at).map(|&next| next as usize) {
                Some(next) if next == at => break,
                // Longer than there are places: it runs in a circle.
                Some(next) if next < drains.len() && way.len() <= drains.len() => at = next,
                _ => return false,
            }
        }
        for &place in &way {
            if let Some(end) = ends.get_mut(place) {
                *end = true;
            }
        }
    }
    true
}
