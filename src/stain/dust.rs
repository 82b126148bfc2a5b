//! Black stains: dust and soot settle at a speed that geometry decides (VC 6.2, fig. 11).

use core::f32::consts::PI;

use bevy_math::{Vec3, ops};

use super::{Environment, StainFields, shape::Shape};
use crate::{
    film::{FilmMesh, VertexId},
    settings::DustSettings,
};

/// A vertex that has moved by less than this since its rate was found, in mean edges, keeps it: its film has turned by a
/// few degrees at most.
const STILL: f32 = 0.1;
/// A change of gravity's direction below this keeps the rates.
const SAME_GRAVITY: f32 = 1e-3;

/// What decides how fast dust settles at a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DustFactors {
    /// Height against gravity over the prop's bounding box: 0 at the foot, 1 at the top.
    pub height: f32,
    /// Cosine between the normal and gravity: 1 faces down.
    pub facing: f32,
    /// Mean dihedral angle of the edges opposite the vertex, in radians: above pi is convex.
    pub dihedral: f32,
}

/// Rate at which dust settles, per unit age: slower where higher, where facing along gravity, and where more convex,
/// each as its weight has it (VC 6.2).
pub fn dust_rate(factors: DustFactors, settings: &DustSettings) -> f32 {
    let DustFactors { height, facing, dihedral } = factors;
    let hollow = 1.0 / (1.0 + ops::exp(4.0 * (dihedral - PI)));
    settings.rate
        * (1.0 - settings.height * height)
        * (1.0 - settings.direction * 0.5 * (1.0 + facing))
        * (1.0 + settings.curvature * (hollow - 0.5))
}

/// Rates of the film's vertices as they were found last.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct DustRates {
    rates: Vec<f32>,
    /// Share of each film vertex that is clean after a tick if it was before.
    left: Vec<f32>,
    /// Tick that `left` and `metal` were found for.
    dt: f32,
    /// Of the metal under each original vertex: how open it lay, and the same share; openness 0 where it is not known.
    metal: Vec<[f32; 2]>,
    /// Where each film vertex was when its rate was found.
    seen: Vec<Vec3>,
    /// Vertices whose rates are to be found anew.
    stale: Vec<bool>,
    /// What the rates were found with.
    basis: Option<Basis>,
}

/// What all rates of a film have in common.
#[derive(Clone, Debug, PartialEq)]
struct Basis {
    gravity: Vec3,
    settings: DustSettings,
    /// Height of the prop's foot against gravity, and from there to its top.
    foot: f32,
    extent: f32,
}

/// Settles dust for a tick of `dt`. Rates are found anew only where the film has moved or been torn, or when gravity has
/// turned.
pub fn settle_dust(
    mesh: &FilmMesh,
    stains: &mut StainFields,
    settings: &DustSettings,
    environment: &Environment,
    dt: f32,
) {
    let mut rates = std::mem::take(&mut stains.dust_rates);
    let basis = rates.basis.take().filter(|basis| basis.holds(settings, environment.gravity));
    let begun = basis.is_some();
    let basis = basis.unwrap_or_else(|| Basis::new(mesh, settings, environment.gravity));
    if !begun {
        rates.stale.clear();
        rates.seen.clear();
    }
    if !begun || rates.dt != dt {
        rates.dt = dt;
        rates.left.clear();
        rates.metal.clear();
        rates.metal.resize(mesh.topology.original_vertex_count(), [0.0; 2]);
    }
    rates.find(mesh, &basis);
    if settings.rate > 0.0 {
        for (dust, left) in stains.film.dust.iter_mut().zip(&rates.left) {
            *dust = 1.0 - (1.0 - *dust) * left;
        }
        for &v in &stains.open {
            let (original, openness) = (VertexId(v), stains.openness[v as usize]);
            let [known, left] = &mut rates.metal[v as usize];
            if *known != openness {
                let shape = Shape::at_rest(mesh, original, stains.duplicates.rest_fan(&mesh.topology, original));
                // Under film that is still there less gathers.
                (*known, *left) = (openness, ops::exp(-(basis.rate(mesh, original, shape) * openness * dt)));
            }
            let dust = &mut stains.metal.dust[v as usize];
            *dust = 1.0 - (1.0 - *dust) * *left;
        }
        stains.revision = stains.revision.wrapping_add(1);
    }
    rates.basis = Some(basis);
    stains.dust_rates = rates;
}

impl DustRates {
    /// A vertex was split or lost faces.
    pub fn stale(&mut self, v: VertexId) {
        if let Some(stale) = self.stale.get_mut(v.index()) {
            *stale = true;
        }
    }

    /// Finds the rates of vertices that are new, have moved or lie beside one that has.
    fn find(&mut self, mesh: &FilmMesh, basis: &Basis) {
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

    fn holds(&self, settings: &DustSettings, gravity: Vec3) -> bool {
        self.settings == *settings && self.gravity.distance_squared(gravity) <= SAME_GRAVITY * SAME_GRAVITY
    }

    fn rate(&self, mesh: &FilmMesh, v: VertexId, shape: Shape) -> f32 {
        let height = -mesh.geometry.rest_positions[v.index()].dot(self.gravity) - self.foot;
        let height = if self.extent > 0.0 { height / self.extent } else { 0.0 };
        let factors = DustFactors { height, facing: shape.normal.dot(self.gravity), dihedral: shape.dihedral };
        dust_rate(factors, &self.settings)
    }
}
