//! Rust run-off (VC 6.1): sources give off wet rust, which runs down, dries on and stains.

use bevy_math::Vec3;

use super::{
    Environment, RustSource, StainFields, StainLayer, corrosion::corrode, outflow::Outflow, sources::is_steep,
};
use crate::{
    film::{FilmMesh, VertexId},
    settings::{CoatingSettings, MoistureSettings, RustSettings},
};

/// Wet rust thinner than this dries on where it is.
const DRY: f32 = 1e-7;

/// Runs off for a tick of `dt`. All fracture so far must have been [followed](super::update_stains).
///
/// Wet rust w of a vertex obeys dw/dt = emission + inflow - (r + k) w, with r its speed over the length of its way and
/// k the rate of deposit; stains grow by k w. Vertices are solved in the order of their depth, each with what has come
/// down to it in this tick, by the implicit Euler scheme: nothing is lost, no tick is too long, and what stays of
/// a steady stream does not depend on its length.
pub fn run_off(
    mesh: &FilmMesh,
    stains: &mut StainFields,
    settings: &CoatingSettings,
    environment: &Environment,
    dt: f32,
) {
    corrode(stains, settings, dt);
    let RustSettings { spread, into_cracks, .. } = settings.rust;
    let spread = (spread * spread + environment.gusts * environment.gusts).sqrt();
    stains.flow.follow(mesh, environment.gravity + environment.wind, spread, into_cracks);
    let mut pass = Pass {
        mesh,
        rust: &settings.rust,
        moisture: &settings.moisture,
        gravity: environment.gravity,
        dt,
        stained: 0.0,
        rain: environment.rain.length(),
    };
    let mut next = stains.flow.next_awake(0);
    while let Some((rank, original)) = next {
        pass.visit(stains, original);
        next = stains.flow.next_awake(rank + 1);
    }
    if pass.stained > 0.0 {
        stains.streaks += stains.flow.pull.normalize_or_zero() * pass.stained;
    }
    if !(stains.open.is_empty() && stains.flow.is_still()) {
        stains.revision = stains.revision.wrapping_add(1);
    }
}

/// One pass downhill.
struct Pass<'a> {
    mesh: &'a FilmMesh,
    rust: &'a RustSettings,
    moisture: &'a MoistureSettings,
    gravity: Vec3,
    dt: f32,
    /// Rust that has stained in this pass.
    stained: f32,
    rain: f32,
}

impl Pass<'_> {
    /// Solves all that lies at one place: upper lips, the lowest film, the metal.
    fn visit(&mut self, stains: &mut StainFields, original: VertexId) {
        let mut busy = false;
        if stains.duplicates.is_split(original) {
            let lowest = stains.flow.lowest(self.mesh, &stains.duplicates, original);
            let mut next = Some(original);
            while let Some(v) = next {
                next = stains.duplicates.after(v);
                if Some(v) != lowest {
                    busy |= self.film(stains, original, v);
                }
            }
            if let Some(lowest) = lowest {
                busy |= self.film(stains, original, lowest);
            }
        } else {
            busy |= self.film(stains, original, original);
        }
        busy |= self.metal(stains, original);
        if !busy {
            stains.flow.rest(original);
        }
    }

    /// Solves film vertex `v`; answers whether there is more to come.
    fn film(&mut self, stains: &mut StainFields, original: VertexId, v: VertexId) -> bool {
        let i = v.index();
        let area = stains.film.areas[i];
        if area <= 0.0 {
            // What was on faces that are gone has been counted when they fell.
            stains.film.wet[i] = 0.0;
            return false;
        }
        let source = stains.sources[i] == RustSource::Present;
        if !source && stains.film.wet[i] == 0.0 {
            return false;
        }
        let outflow = stains.flow.film_way(self.mesh, &stains.duplicates, original, v);
        let mut emitted = 0.0;
        if source && is_steep(self.mesh, original, self.gravity) {
            let damp = 1.0 + self.moisture.emission * stains.film.moisture[i];
            emitted = self.dt * self.rust.emission * stains.catchments.length(original) * damp;
            stains.budget.emitted += f64::from(emitted);
        }
        let leaving = self.solve(&mut stains.film, i, emitted, &outflow);
        self.share(stains, leaving, &outflow);
        source || stains.film.wet[i] > 0.0
    }

    /// Solves the metal under `original`; answers whether there is more to come.
    fn metal(&mut self, stains: &mut StainFields, original: VertexId) -> bool {
        let i = original.index();
        if stains.metal.wet[i] == 0.0 || stains.metal.areas[i] <= 0.0 {
            return false;
        }
        let outflow = stains.flow.metal_way(self.mesh, &stains.duplicates, original);
        let leaving = self.solve(&mut stains.metal, i, 0.0, &outflow);
        self.share(stains, leaving, &outflow);
        stains.metal.wet[i] > 0.0
    }

    /// Takes `emitted` (an amount) in, and solves for what stays wet, what stains and what leaves, which is given as an
    /// amount.
    fn solve(&mut self, layer: &mut StainLayer, i: usize, emitted: f32, outflow: &Outflow) -> f32 {
        let (area, moisture) = (layer.areas[i], layer.moisture[i]);
        if self.rain > 0.0 && moisture > 0.0 && self.moisture.wash_rust > 0.0 {
            let loosening = self.dt * self.moisture.wash_rust * moisture * self.rain;
            let loose = layer.stained[i] * loosening / (1.0 + loosening);
            layer.stained[i] -= loose;
            layer.wet[i] += loose;
        }
        let going = self.dt * self.rust.speed * (1.0 + self.moisture.travel * moisture) * outflow.rate;
        let drying = self.dt * self.rust.deposit;
        let wet = (layer.wet[i] + emitted / area) / (1.0 + going + drying);
        let mut stain = drying * wet;
        layer.wet[i] = wet;
        if wet < DRY {
            stain += wet;
            layer.wet[i] = 0.0;
        }
        layer.stained[i] += stain;
        self.stained += stain * area;
        going * wet * area
    }

    /// Hands on what leaves a vertex; the rest drips off.
    fn share(&mut self, stains: &mut StainFields, amount: f32, outflow: &Outflow) {
        if amount <= 0.0 {
            return;
        }
        let mut left = amount;
        for (target, share) in outflow.ways() {
            let (v, metal) = target.vertex();
            let layer = if metal { &mut stains.metal } else { &mut stains.film };
            let area = layer.areas[v.index()];
            if area > 0.0 {
                let part = amount * share;
                layer.wet[v.index()] += part / area;
                left -= part;
                stains.flow.wake(self.mesh.topology.original(v));
            }
        }
        // Shares that make up the whole leave nothing but rounding.
        if left > amount * 1e-6 {
            stains.budget.dripped += f64::from(left);
        }
    }
}
