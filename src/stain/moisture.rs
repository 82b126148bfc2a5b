//! Wets and dries film and metal, and lets rain wash dust and stains (beyond the paper).

use core::f32::consts::PI;

use bevy_math::{Vec3, ops};

use super::{
    environment::Environment,
    fields::{Exposure, StainFields},
    outflow::Outflow,
    shape::Shape,
};
use crate::{
    film::{FilmMesh, VertexId},
    settings::MoistureSettings,
};

/// Moisture below which a surface counts as dry.
const DRY: f32 = 1e-4;

/// Change of moisture at a vertex in a tick: an exponential approach.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Tendency {
    /// Moisture that is approached.
    towards: f32,
    /// Share of the difference from it that is left after the tick.
    left: f32,
}

impl Tendency {
    /// No change.
    const UNCHANGED: Self = Self { towards: 0.0, left: 1.0 };

    /// Solves dm/dt = wetting (1 - m) - drying m over `dt`.
    fn new(wetting: f32, drying: f32, dt: f32) -> Self {
        let both = wetting + drying;
        if both > 0.0 { Self { towards: wetting / both, left: ops::exp(-both * dt) } } else { Self::UNCHANGED }
    }

    fn apply(self, moisture: &mut f32) {
        *moisture = (self.towards + (*moisture - self.towards) * self.left).clamp(0.0, 1.0);
    }
}

/// Wets and dries film and open metal for a tick of `dt`, an age, and lets rain wash dust (beyond the paper).
///
/// Moisture m of a vertex obeys dm/dt = wetting (1 - m) - drying m.
///
/// - Wetting is [`wetting`](MoistureSettings::wetting) times the strength of the rain, the cosine between the surface
///   and the rain, the vertex's [exposure](StainFields::exposure) to rain, and on metal its openness.
/// - Drying is [`drying`](MoistureSettings::drying) times a factor from 0.5 in hollows to 1.5 on ridges, and times
///   1 + [`sun`](MoistureSettings::sun) in full sunlight. Metal that is not bare dries at the share
///   [`crevice`](MoistureSettings::crevice) of this.
/// - Rain carries dust along at [`wash_dust`](MoistureSettings::wash_dust) where it is wet, the way that run-off takes.
///
/// In dry weather, once nothing is wet any more, the call returns at once.
///
/// ```
/// use bevy_coating::{
///     film::FilmMesh,
///     settings::MoistureSettings,
///     stain::{Environment, StainFields, moisten},
/// };
/// use bevy_math::Vec3;
///
/// // A triangle that faces up, in the rain.
/// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::Z, Vec3::X], &[[0, 1, 2]])?;
/// let mut stains = StainFields::new(&mesh);
/// let rain = Environment { rain: Vec3::NEG_Y, ..Environment::default() };
/// moisten(&mesh, &mut stains, &MoistureSettings::default(), &rain, 0.1);
/// assert!(stains.film.moisture[0] > 0.7 && stains.is_damp());
///
/// for _ in 0..100 {
///     moisten(&mesh, &mut stains, &MoistureSettings::default(), &Environment::default(), 0.1);
/// }
/// assert!(stains.film.moisture[0] == 0.0 && !stains.is_damp());
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn moisten(
    mesh: &FilmMesh,
    stains: &mut StainFields,
    settings: &MoistureSettings,
    environment: &Environment,
    dt: f32,
) {
    let environment = &environment.in_range();
    let raining = environment.rain != Vec3::ZERO;
    if !raining && !stains.damp {
        return;
    }
    stains.damp = true;
    let mut wettest = 0.0;
    let mut apply = |moisture: &mut f32, tendency: Tendency| {
        tendency.apply(moisture);
        if *moisture > wettest {
            wettest = *moisture;
        }
    };
    let sky = Sky { settings, environment, exposure: &stains.exposure, dt };
    let topology = &mesh.topology;
    for v in topology.all_vertices() {
        // A vertex without faces only dries.
        let tendency = if topology.has_faces(v) {
            sky.tendency(Shape::now(mesh, v), topology.original(v), 1.0, 1.0)
        } else {
            Tendency::new(0.0, settings.drying, dt)
        };
        apply(&mut stains.film.moisture[v.index()], tendency);
    }
    for &v in &stains.open {
        let original = VertexId(v);
        let openness = stains.openness[v as usize];
        let shape = Shape::at_rest(mesh, original, stains.duplicates.rest_fan(topology, original));
        let airing = if openness < 1.0 { settings.crevice } else { 1.0 };
        apply(&mut stains.metal.moisture[v as usize], sky.tendency(shape, original, openness, airing));
    }
    if raining && settings.wash_dust > 0.0 {
        wash_dust(mesh, stains, settings.wash_dust * dt * environment.rain.length());
    }
    if raining && settings.wash_rust > 0.0 {
        wake_stains(mesh, stains);
    }
    if !raining && wettest < DRY {
        stains.damp = false;
        stains.film.moisture.fill(0.0);
        stains.metal.moisture.fill(0.0);
    }
    stains.revise_if_seen();
}

/// Weather over one film.
struct Sky<'a> {
    settings: &'a MoistureSettings,
    environment: &'a Environment,
    exposure: &'a Exposure,
    dt: f32,
}

impl Sky<'_> {
    /// Returns the tendency of a surface of `shape`, of which rain reaches the share `reach` and air the share
    /// `airing`. Ridges dry faster than hollows, and every surface dries faster in the sun.
    fn tendency(&self, shape: Shape, original: VertexId, reach: f32, airing: f32) -> Tendency {
        let Self { settings, environment, exposure, dt } = *self;
        // Exposure may be written by a user, so its entries may be missing, out of range or not finite.
        let exposed = |exposure: &[f32]| match exposure.get(original.index()) {
            Some(x) if x.is_finite() => x.clamp(0.0, 1.0),
            _ => 1.0,
        };
        let facing = |fall: Vec3| (-shape.normal.dot(fall)).clamp(0.0, 1.0);
        let ridge = 0.5 + 1.0 / (1.0 + ops::exp(-4.0 * (shape.dihedral - PI)));
        let sunlight = facing(environment.sun) * exposed(&exposure.sun);
        let wetting = settings.wetting * facing(environment.rain) * exposed(&exposure.rain) * reach;
        Tendency::new(wetting, settings.drying * ridge * (1.0 + settings.sun * sunlight) * airing, dt)
    }
}

/// Washes dust along the ways of run-off, and off the prop. `pace` is the length in metres that fully wet dust moves on
/// a vertical surface.
fn wash_dust(mesh: &FilmMesh, stains: &mut StainFields, pace: f32) {
    for rank in 0..stains.flow.len() {
        let Some(original) = stains.flow.at(rank) else { return };
        let mut next = Some(original);
        while let Some(v) = next {
            next = stains.duplicates.after(v);
            if stains.film.moisture[v.index()] > DRY && stains.film.dust[v.index()] > 0.0 {
                let outflow = *stains.flow.film_way(mesh, &stains.duplicates, original, v).0;
                let going = pace * stains.film.moisture[v.index()] * outflow.rate;
                let dust = &mut stains.film.dust[v.index()];
                let amount = *dust * going / (1.0 + going);
                *dust -= amount;
                carry(stains, amount * stains.film.areas[v.index()], &outflow);
            }
        }
        let i = original.index();
        if stains.metal.moisture[i] > DRY && stains.metal.dust[i] > 0.0 {
            let outflow = *stains.flow.metal_way(mesh, &stains.duplicates, original).0;
            let going = pace * stains.metal.moisture[i] * outflow.rate;
            let amount = stains.metal.dust[i] * going / (1.0 + going);
            stains.metal.dust[i] -= amount;
            carry(stains, amount * stains.metal.areas[i], &outflow);
        }
    }
}

/// Brings an amount of dust to the targets of `outflow`. The dust of a surface cannot exceed 1; the rest is lost.
fn carry(stains: &mut StainFields, amount: f32, outflow: &Outflow) {
    for (target, share) in outflow.ways() {
        let (v, metal) = target.vertex();
        let layer = if metal { &mut stains.metal } else { &mut stains.film };
        let area = layer.areas[v.index()];
        if area > 0.0 {
            let dust = &mut layer.dust[v.index()];
            *dust = (*dust + amount * share / area).min(1.0);
        }
    }
}

/// Wakes run-off at every stain that is wet, so that rain can loosen it.
fn wake_stains(mesh: &FilmMesh, stains: &mut StainFields) {
    for v in mesh.topology.all_vertices() {
        if stains.film.stained[v.index()] > 0.0 && stains.film.moisture[v.index()] > DRY {
            stains.flow.wake(v);
        }
    }
    for &v in &stains.open {
        if stains.metal.stained[v as usize] > 0.0 && stains.metal.moisture[v as usize] > DRY {
            stains.flow.wake(VertexId(v));
        }
    }
}
