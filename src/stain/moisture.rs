//! Moisture: rain wets what it reaches, air and sun dry it, and water washes.

use core::f32::consts::PI;

use bevy_math::{Vec3, ops};

use super::{Environment, Exposure, StainFields, outflow::Outflow, shape::Shape};
use crate::{
    film::{FilmMesh, VertexId},
    settings::MoistureSettings,
};

/// Below this everywhere, in dry weather, a film counts as dry.
const DRY: f32 = 1e-4;

/// Where moisture tends at a vertex, and which share of the way is left after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Tendency {
    towards: f32,
    left: f32,
}

impl Tendency {
    const DRY: Self = Self { towards: 0.0, left: 1.0 };

    /// dm/dt = wetting (1 - m) - drying m, over `dt`.
    fn new(wetting: f32, drying: f32, dt: f32) -> Self {
        let both = wetting + drying;
        if both > 0.0 { Self { towards: wetting / both, left: ops::exp(-both * dt) } } else { Self::DRY }
    }

    fn apply(self, moisture: &mut f32) {
        *moisture = (self.towards + (*moisture - self.towards) * self.left).clamp(0.0, 1.0);
    }
}

/// Wets and dries for a tick of `dt`, and washes. Does nothing at all while it is dry and has been for long.
pub fn moisten(
    mesh: &FilmMesh,
    stains: &mut StainFields,
    settings: &MoistureSettings,
    environment: &Environment,
    dt: f32,
) {
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
        // Where no film is left nothing is wetted any more.
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
    stains.revision = stains.revision.wrapping_add(1);
}

/// What the weather does to one film.
struct Sky<'a> {
    settings: &'a MoistureSettings,
    environment: &'a Environment,
    exposure: &'a Exposure,
    dt: f32,
}

impl Sky<'_> {
    /// Tendency of a surface of `shape`, which rain reaches to the share `reach` and air to the share `airing`. Ridges
    /// dry faster than hollows, and all surfaces in the sun.
    fn tendency(&self, shape: Shape, original: VertexId, reach: f32, airing: f32) -> Tendency {
        let Self { settings, environment, exposure, dt } = *self;
        // Exposure may be a user's own.
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

/// Washes dust along with the run-off of water and off the prop; `pace` is the way in metres that fully
/// wet dust goes straight down.
fn wash_dust(mesh: &FilmMesh, stains: &mut StainFields, pace: f32) {
    for rank in 0..stains.flow.len() {
        let Some(original) = stains.flow.at(rank) else { return };
        let mut next = Some(original);
        while let Some(v) = next {
            next = stains.duplicates.after(v);
            if stains.film.moisture[v.index()] > DRY && stains.film.dust[v.index()] > 0.0 {
                let outflow = stains.flow.film_way(mesh, &stains.duplicates, original, v);
                let going = pace * stains.film.moisture[v.index()] * outflow.rate;
                let dust = &mut stains.film.dust[v.index()];
                let amount = *dust * going / (1.0 + going);
                *dust -= amount;
                carry(stains, amount * stains.film.areas[v.index()], &outflow);
            }
        }
        let i = original.index();
        if stains.metal.moisture[i] > DRY && stains.metal.dust[i] > 0.0 {
            let outflow = stains.flow.metal_way(mesh, &stains.duplicates, original);
            let going = pace * stains.metal.moisture[i] * outflow.rate;
            let amount = stains.metal.dust[i] * going / (1.0 + going);
            stains.metal.dust[i] -= amount;
            carry(stains, amount * stains.metal.areas[i], &outflow);
        }
    }
}

/// Brings dust (an amount) to where the water goes. A surface takes no more than it can hold.
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

/// Lets run-off look at everything stained that is wet.
fn wake_stains(mesh: &FilmMesh, stains: &mut StainFields) {
    for v in mesh.topology.all_vertices() {
        if stains.film.stained[v.index()] > 0.0 && stains.film.moisture[v.index()] > DRY {
            stains.flow.wake(mesh.topology.original(v));
        }
    }
    for &v in &stains.open {
        if stains.metal.stained[v as usize] > 0.0 && stains.metal.moisture[v as usize] > DRY {
            stains.flow.wake(VertexId(v));
        }
    }
}
