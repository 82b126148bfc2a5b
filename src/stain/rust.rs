//! Lets rust run off: sources give off wet rust, which runs down, dries on and stains (VC 6.1).

use bevy_math::Vec3;

use super::{
    catchments::Catchments,
    corrosion::corrode,
    duplicates::Duplicates,
    environment::Environment,
    fields::{RustBudget, RustSource, StainFields},
    flow::{Flow, Waker},
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
    let StainFields { film, metal, sources, budget, duplicates, catchments, flow, damp, .. } = stains;
    let pace =
        Pace { rust: &settings.rust, moisture: &settings.moisture, dt, rain: environment.rain.length(), damp: *damp };
    let (gravity, stained) = (environment.gravity, 0.0);
    let mut pass = Pass { mesh, pace, gravity, film, metal, sources, duplicates, catchments, flow, budget, stained };
    let mut next = pass.flow.next_awake(0);
    while let Some((rank, original)) = next {
        pass.visit(original);
        next = pass.flow.next_awake(rank + 1);
    }
    let stained = pass.stained;
    if stained > 0.0 {
        stains.streaks += stains.flow.pull.normalize_or_zero() * stained;
    }
    if !(stains.open.is_empty() && stains.flow.is_asleep()) {
        stains.revise_if_seen();
    }
}

/// One pass over all vertices with run-off, from the highest to the lowest.
struct Pass<'a> {
    mesh: &'a FilmMesh,
    pace: Pace<'a>,
    gravity: Vec3,
    film: &'a mut StainLayer,
    metal: &'a mut StainLayer,
    sources: &'a [RustSource],
    duplicates: &'a Duplicates,
    catchments: &'a Catchments,
    flow: &'a mut Flow,
    budget: &'a mut RustBudget,
    /// Amount of rust that has stained in this pass.
    stained: f32,
}

impl Pass<'_> {
    /// Solves all vertices at one place: the upper lips of cracks first, then the lowest film, then the metal.
    fn visit(&mut self, original: VertexId) {
        let mut busy = false;
        if self.duplicates.is_split(original) {
            let lowest = self.flow.lowest(self.mesh, self.duplicates, original);
            let mut next = Some(original);
            while let Some(v) = next {
                next = self.duplicates.after(v);
                if Some(v) != lowest {
                    busy |= self.visit_film(original, v);
                }
            }
            if let Some(lowest) = lowest {
                busy |= self.visit_film(original, lowest);
            }
        } else {
            busy |= self.visit_film(original, original);
        }
        busy |= self.visit_metal(original);
        if !busy {
            self.flow.sleep(original);
        }
    }

    /// Solves film vertex `v`. Returns whether there is run-off left for the next tick.
    #[inline]
    fn visit_film(&mut self, original: VertexId, v: VertexId) -> bool {
        let i = v.index();
        let area = self.film.areas[i];
        if area <= 0.0 {
            // Rust on faces that are gone was counted when they fell.
            self.film.wet[i] = 0.0;
            return false;
        }
        let source = self.sources[i] == RustSource::Present;
        if !source && self.film.wet[i] == 0.0 {
            return false;
        }
        let mut emitted = 0.0;
        if source && is_steep(self.mesh, original, self.gravity) {
            emitted = self.pace.emission(self.catchments.length(original), self.film.moisture[i]);
            self.budget.emitted += f64::from(emitted);
        }
        let (way, waker) = self.flow.film_way(self.mesh, self.duplicates, original, v);
        let solved = self.pace.solve(self.film, i, area, emitted, way.rate);
        self.stained += solved.stained;
        share(way, waker, solved.leaving, self.film, self.metal, self.budget);
        source || solved.is_wet
    }

    /// Solves the metal under `original`. Returns whether there is run-off left for the next tick.
    #[inline]
    fn visit_metal(&mut self, original: VertexId) -> bool {
        let i = original.index();
        let area = self.metal.areas[i];
        if self.metal.wet[i] == 0.0 || area <= 0.0 {
            return false;
        }
        let (way, waker) = self.flow.metal_way(self.mesh, self.duplicates, original);
        let solved = self.pace.solve(self.metal, i, area, 0.0, way.rate);
        self.stained += solved.stained;
        share(way, waker, solved.leaving, self.film, self.metal, self.budget);
        solved.is_wet
    }
}

/// Rates of one pass.
#[derive(Clone, Copy)]
struct Pace<'a> {
    rust: &'a RustSettings,
    moisture: &'a MoistureSettings,
    dt: f32,
    /// Strength of the rain.
    rain: f32,
    /// Whether anything is wet with water.
    damp: bool,
}

/// What a vertex does with its wet rust in a pass.
struct Solved {
    /// Amount that leaves.
    leaving: f32,
    /// Amount that has dried on.
    stained: f32,
    /// Whether wet rust is left.
    is_wet: bool,
}

impl Pace<'_> {
    /// Returns the amount that a source gives off, to which `length` metres of crack drain.
    fn emission(&self, length: f32, moisture: f32) -> f32 {
        self.dt * self.rust.emission * length * (1.0 + self.moisture.emission * moisture)
    }

    /// Solves vertex `i` of `layer`, which gives off the amount `emitted`: updates its wet rust and its stain. `rate`
    /// is that of its way.
    #[inline]
    fn solve(&self, layer: &mut StainLayer, i: usize, area: f32, emitted: f32, rate: f32) -> Solved {
        let (was_wet, stain) = (&mut layer.wet[i], &mut layer.stained[i]);
        let moisture = if self.damp { layer.moisture[i] } else { 0.0 };
        if self.rain > 0.0 && moisture > 0.0 && self.moisture.wash_rust > 0.0 {
            let loosening = self.dt * self.moisture.wash_rust * moisture * self.rain;
            let loose = *stain * loosening / (1.0 + loosening);
            *stain -= loose;
            *was_wet += loose;
        }
        let going = self.dt * self.rust.speed * (1.0 + self.moisture.travel * moisture) * rate;
        let drying = self.dt * self.rust.deposit;
        let given = if emitted > 0.0 { emitted / area } else { 0.0 };
        let wet = (*was_wet + given) / (1.0 + going + drying);
        let is_wet = wet >= DRY;
        let dried = if is_wet { drying * wet } else { drying * wet + wet };
        *was_wet = if is_wet { wet } else { 0.0 };
        *stain += dried;
        Solved { leaving: going * wet * area, stained: dried * area, is_wet }
    }
}

/// Brings the amount that leaves a vertex to its targets along `way`. The rest drips off.
#[inline]
fn share(
    way: &Outflow,
    mut waker: Waker,
    amount: f32,
    film: &mut StainLayer,
    metal: &mut StainLayer,
    budget: &mut RustBudget,
) {
    if amount <= 0.0 {
        return;
    }
    let mut left = amount;
    for (target, share) in way.ways() {
        let (v, is_metal) = target.vertex();
        let layer = if is_metal { &mut *metal } else { &mut *film };
        let area = layer.areas[v.index()];
        if area > 0.0 {
            let part = amount * share;
            let wet = &mut layer.wet[v.index()];
            // A place where anything is wet is awake.
            if *wet == 0.0 {
                waker.wake(v);
            }
            *wet += part / area;
            left -= part;
        }
    }
    // Where the shares add up to 1 only rounding is left.
    if left > amount * 1e-6 {
        budget.dripped += f64::from(left);
    }
}
