//! Lets rust run off: sources give off wet rust, which runs down, dries on and stains (VC 6.1).

use bevy_math::Vec3;

use super::{
    corrosion::corrode,
    environment::Environment,
    fields::{RustSource, StainFields},
    layer::StainLayer,
    outflow::Outflow,
    slope::is_steep,
};
use crate::{
    film::{FilmMesh, VertexId},
    settings::{CoatingSettings, MoistureSettings, RustSettings},
};

/// Thickness in layers below which wet rust dries on where it is.
const DRY: f32 = 1e-7;

/// Lets rust run off for a tick of `dt`, an age (VC 6.1), and corrodes open metal.
/// [`update_stains`](super::update_stains) must have followed all fracture so far.
///
/// - A source gives off [`emission`](RustSettings::emission) for each metre of crack that drains to it.
/// - Wet rust w (layers) of a vertex obeys dw/dt = emission + inflow - (r + k) w. Here r is the speed of run-off
///   divided by the length of its way, and k the rate of [`deposit`](RustSettings::deposit); stains grow by k w.
/// - Bare metal c corrodes by dc/dt = [`corrosion`](RustSettings::corrosion) times openness times (1 - c), with an
///   openness of 1 where a face is gone and less in and beside cracks.
/// - Where it is wet, sources give off more, run-off is faster, metal corrodes faster, and rain loosens stains, as
///   [`MoistureSettings`] says.
///
/// Run-off follows the sum of gravity and wind along the surface at rest. The vertices are solved from the highest to
/// the lowest by the implicit Euler scheme, each with the rust that has come down to it in this tick. So no rust is
/// lost, a tick of any length is stable, and the stain that a steady stream leaves does not depend on the length of the
/// tick.
///
/// ```
/// use bevy_coating::{
///     film::FilmMesh,
///     settings::CoatingSettings,
///     stain::{Environment, StainFields, run_off},
/// };
/// use bevy_math::Vec3;
///
/// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
/// let mut stains = StainFields::new(&mesh);
/// run_off(&mesh, &mut stains, &CoatingSettings::default(), &Environment::default(), 0.01);
/// assert_eq!(stains.budget.emitted, 0.0, "a film without cracks gives off no rust");
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn run_off(
    mesh: &FilmMesh,
    stains: &mut StainFields,
    settings: &CoatingSettings,
    environment: &Environment,
    dt: f32,
) {
    let environment = &environment.in_range();
    corrode(stains, settings, dt);
    let RustSettings { spread, into_cracks, .. } = settings.rust;
    let spread = (spread * spread + environment.gusts * environment.gusts).sqrt();
    stains.flow.set_pull(mesh, environment.gravity + environment.wind, spread, into_cracks);
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
    if !(stains.open.is_empty() && stains.flow.is_asleep()) {
        stains.revise_if_seen();
    }
}

/// One pass over all vertices with run-off, from the highest to the lowest.
struct Pass<'a> {
    mesh: &'a FilmMesh,
    rust: &'a RustSettings,
    moisture: &'a MoistureSettings,
    gravity: Vec3,
    dt: f32,
    /// Amount of rust that has stained in this pass.
    stained: f32,
    /// Strength of the rain.
    rain: f32,
}

impl Pass<'_> {
    /// Solves all vertices at one place: the upper lips of cracks first, then the lowest film, then the metal.
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
            stains.flow.sleep(original);
        }
    }

    /// Solves film vertex `v`. Returns whether there is run-off left for the next tick.
    fn film(&mut self, stains: &mut StainFields, original: VertexId, v: VertexId) -> bool {
        let i = v.index();
        let area = stains.film.areas[i];
        if area <= 0.0 {
            // Rust on faces that are gone was counted when they fell.
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

    /// Solves the metal under `original`. Returns whether there is run-off left for the next tick.
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

    /// Solves vertex `i`, which gives off the amount `emitted`: updates its wet rust and its stain, and returns the
    /// amount that leaves it.
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

    /// Brings the amount that leaves a vertex to its targets. The rest drips off.
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
                stains.flow.wake(v);
            }
        }
        // Where the shares add up to 1 only rounding is left.
        if left > amount * 1e-6 {
            stains.budget.dripped += f64::from(left);
        }
    }
}
