//! Keeps the rates at which dust settles, and computes them only where something has changed (VC 6.2).

use bevy_math::{Vec3, ops};

use super::factors::{DustFactors, dust_rate};
use crate::{
    film::{FilmMesh, VertexId, words::Words},
    settings::DustSettings,
    stain::{duplicates::Duplicates, shape::Shape},
};

/// Distance, in mean edges, that a vertex may move before its rate is computed again. Its film has turned by a few
/// degrees at most then.
const STILL: f32 = 0.1;
/// Change of gravity's direction below which the rates are kept.
const SAME_GRAVITY: f32 = 1e-3;

/// Rates at which dust settles on film and metal, as they were computed last.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::stain) struct DustRates {
    /// Rate of each film vertex, per unit age.
    pub(in crate::stain) rates: Vec<f32>,
    /// Share of the clean surface of each film vertex that is still clean after a tick.
    pub(in crate::stain) left: Vec<f32>,
    /// Length of the tick that `left` and `metal` were computed for, an age.
    pub(in crate::stain) dt: f32,
    /// Openness of the metal under each original vertex and the share of its clean surface that is still clean after a
    /// tick. An openness of 0 means that the share is not known yet.
    pub(in crate::stain) metal: Vec<[f32; 2]>,
    /// Position of each film vertex when its rate was computed.
    pub(in crate::stain) seen: Vec<Vec3>,
    /// Whether the rate of each film vertex must be computed again.
    pub(in crate::stain) stale: Vec<bool>,
    /// Inputs that all rates have in common; `None` before the first tick.
    pub(in crate::stain) basis: Option<Basis>,
}

/// Inputs that the rates of all vertices have in common.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::stain) struct Basis {
    pub(in crate::stain) gravity: Vec3,
    pub(in crate::stain) settings: DustSettings,
    /// Height of the prop's lowest point against gravity.
    pub(in crate::stain) foot: f32,
    /// Height of the prop's highest point over its lowest.
    pub(in crate::stain) extent: f32,
}

impl DustRates {
    /// Marks the rate of `v` as out of date, because it was split or lost faces.
    pub fn mark_stale(&mut self, v: VertexId) {
        if let Some(stale) = self.stale.get_mut(v.index()) {
            *stale = true;
        }
    }

    /// Lets vertex `to` have the rate of `from`, whose faces it takes.
    pub fn take(&mut self, from: usize, to: usize) {
        for list in [&mut self.rates, &mut self.left] {
            if let Some(&rate) = list.get(from)
                && let Some(taken) = list.get_mut(to)
            {
                *taken = rate;
            }
        }
        if let Some(&seen) = self.seen.get(from)
            && let Some(taken) = self.seen.get_mut(to)
        {
            *taken = seen;
        }
    }

    /// Appends the rates and what they were computed for, which is kept through small changes.
    pub fn write_state(&self, to: &mut Words) {
        // The shares that are left after a tick follow from rates, basis and tick.
        let Self { rates, left: _, dt, metal: _, seen, stale, basis } = self;
        to.floats(rates);
        to.float(*dt);
        to.vectors(seen);
        to.flags(stale);
        to.list(basis.iter().flat_map(|Basis { gravity, settings, foot, extent }| {
            let DustSettings { rate, height, direction, curvature } = settings;
            let [x, y, z] = gravity.to_array();
            [x, y, z, *rate, *height, *direction, *curvature, *foot, *extent].map(f32::to_bits)
        }));
    }

    /// Brings all rates of the film up to date with its shape, `settings` and `gravity`, for a tick of `dt`. Returns
    /// their common inputs, to be returned by [`DustRates::give_back`].
    pub(super) fn update(&mut self, mesh: &FilmMesh, settings: &DustSettings, gravity: Vec3, dt: f32) -> Basis {
        let basis = self.basis.take().filter(|basis| basis.holds(settings, gravity));
        let begun = basis.is_some();
        let basis = basis.unwrap_or_else(|| Basis::new(mesh, settings, gravity));
        if !begun {
            self.stale.clear();
            self.seen.clear();
        }
        if !begun || self.dt != dt {
            self.dt = dt;
            self.left.clear();
            self.metal.clear();
            self.metal.resize(mesh.topology.original_vertex_count(), [0.0; 2]);
        }
        self.update_film(mesh, &basis);
        basis
    }

    /// Takes the common inputs back.
    pub(super) fn give_back(&mut self, basis: Basis) {
        self.basis = Some(basis);
    }

    /// Returns the share of the clean surface of each film vertex that is still clean after the tick.
    pub(super) fn left_on_film(&self) -> &[f32] {
        &self.left
    }

    /// Returns the share of the clean metal under `original` that is still clean after the tick. Less dust settles on
    /// metal that is less open.
    pub(super) fn left_on_metal(
        &mut self,
        mesh: &FilmMesh,
        duplicates: &Duplicates,
        basis: &Basis,
        original: VertexId,
        openness: f32,
    ) -> f32 {
        let dt = self.dt;
        let [known, left] = &mut self.metal[original.index()];
        if *known != openness {
            let shape = Shape::at_rest(mesh, original, duplicates.rest_fan(&mesh.topology, original));
            (*known, *left) = (openness, ops::exp(-(basis.rate(mesh, original, shape) * openness * dt)));
        }
        *left
    }

    /// Computes the rates of film vertices that are new, were split, lost faces, have moved, or lie beside one that has
    /// moved.
    fn update_film(&mut self, mesh: &FilmMesh, basis: &Basis) {
        let Self { rates, left, seen, stale, dt, .. } = self;
        let dt = *dt;
        let (topology, positions) = (&mesh.topology, &mesh.geometry.positions);
        rates.resize(positions.len(), 0.0);
        stale.resize(positions.len(), true);
        let limit = STILL * mesh.geometry.mean_edge;
        for (i, (seen, &now)) in seen.iter_mut().zip(positions).enumerate() {
            if seen.distance_squared(now) > limit * limit {
                *seen = now;
                stale[i] = true;
                for h in topology.fan(VertexId::new(i)) {
                    stale[topology.target(h).index()] = true;
                    stale[topology.apex(h).index()] = true;
                }
            }
        }
        seen.extend_from_slice(positions.get(seen.len()..).unwrap_or_default());
        for (i, stale) in stale.iter_mut().enumerate().filter(|(_, stale)| **stale) {
            *stale = false;
            let v = VertexId::new(i);
            if !topology.has_faces(v) {
                // Nothing moves it any more, and a snapshot need not hold where it was.
                seen[i] = positions[i];
            }
            rates[i] = basis.rate(mesh, v, Shape::now(mesh, v));
            if let Some(left) = left.get_mut(i) {
                *left = ops::exp(-(rates[i] * dt));
            }
        }
        let known = left.len();
        left.extend(rates[known..].iter().map(|rate| ops::exp(-(rate * dt))));
    }
}

impl Basis {
    fn new(mesh: &FilmMesh, settings: &DustSettings, gravity: Vec3) -> Self {
        let heights = mesh.geometry.rest_positions.iter().map(|p| -p.dot(gravity));
        let (foot, top) =
            heights.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), height| (low.min(height), high.max(height)));
        Self { gravity, settings: settings.clone(), foot, extent: top - foot }
    }

    /// Returns whether rates of this basis are still right for `settings` and `gravity`.
    fn holds(&self, settings: &DustSettings, gravity: Vec3) -> bool {
        self.settings == *settings && self.gravity.distance_squared(gravity) <= SAME_GRAVITY * SAME_GRAVITY
    }

    /// Returns the rate at a vertex of `shape`, per unit age.
    pub(in crate::stain) fn rate(&self, mesh: &FilmMesh, v: VertexId, shape: Shape) -> f32 {
        let height = -mesh.geometry.rest_positions[v.index()].dot(self.gravity) - self.foot;
        let height = if self.extent > 0.0 { height / self.extent } else { 0.0 };
        let factors = DustFactors { height, facing: shape.normal.dot(self.gravity), dihedral: shape.dihedral };
        dust_rate(factors, &self.settings)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::words::assert_each_counts;

    #[test]
    fn every_field_of_dust_rates_counts() {
        let basis = Basis { gravity: Vec3::NEG_Y, settings: DustSettings::default(), foot: 0.0, extent: 1.0 };
        let rates = DustRates {
            rates: vec![1.0; 2],
            seen: vec![Vec3::ZERO; 2],
            stale: vec![false; 2],
            basis: Some(basis),
            ..DustRates::default()
        };
        let changes: [fn(&mut DustRates); 9] = [
            |dust| dust.rates[1] = 0.5,
            |dust| dust.dt = 0.5,
            |dust| dust.seen[1] = Vec3::X,
            |dust| dust.stale[1] = true,
            |dust| dust.basis = None,
            |dust| dust.basis.as_mut().unwrap().gravity = Vec3::X,
            |dust| dust.basis.as_mut().unwrap().settings.rate = 0.5,
            |dust| dust.basis.as_mut().unwrap().foot = 0.5,
            |dust| dust.basis.as_mut().unwrap().extent = 0.5,
        ];
        assert_each_counts(&rates, DustRates::write_state, &changes);
    }
}
