//! A plate on which the adhesion is painted (VC fig. 16): where it was protected paint stays, where it was weakened
//! paint goes first.

use bevy_coating::{
    film::FilmMesh,
    fracture::{FilmForces, bending_force},
    sim::FilmState,
    stain::Environment,
};
use bevy_math::{Vec2, ops};
use core::f32::consts::TAU;

use super::{
    exhibit::{Beginning, Exhibit, NoFilm, Shape, paper},
    spread::{Spread, over_seeds},
};

/// A stroke of a brush: what it multiplies the adhesion by, its radius, and the places it goes through, in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    pub factor: f32,
    pub radius: f32,
    pub places: Vec<Vec2>,
}

impl Stroke {
    fn covers(&self, place: Vec2) -> bool {
        self.places.iter().any(|at| at.distance(place) < self.radius)
    }
}

/// Returns the strokes: a protected S over the plate, and a weakened corner.
pub fn strokes() -> Vec<Stroke> {
    let along = |count: usize, place: &dyn Fn(f32) -> Vec2| -> Vec<Vec2> {
        (0..=count).map(|i| place(i as f32 / count as f32)).collect()
    };
    let wave = |t: f32| Vec2::new(0.22 * ops::sin(t * TAU), 0.40 - 0.8 * t);
    let corner = |t: f32| Vec2::new(0.42, -0.42 + 0.6 * t);
    vec![
        Stroke { factor: 2.0, radius: 0.085, places: along(60, &wave) },
        Stroke { factor: 0.7, radius: 0.10, places: along(40, &corner) },
    ]
}

/// Paints strokes on a fresh film.
pub fn paint(mesh: &FilmMesh, forces: &mut FilmForces, strokes: &[Stroke]) {
    for v in mesh.topology.all_vertices() {
        let place = mesh.geometry.rest_positions[v.index()].truncate();
        for stroke in strokes.iter().filter(|stroke| stroke.covers(place)) {
            forces.scale_adhesion(v, stroke.factor);
        }
    }
}

/// Returns the painted plate.
pub fn plate(seed: u64) -> Exhibit {
    let mut settings = paper();
    // More even than by default, that one sees the brush rather than the noise.
    settings.adhesion.deviation = 0.4;
    let plate = Exhibit::new("painted", "", Shape::Plate(6_000), settings);
    Exhibit { seed, beginning: Beginning::Painted(strokes()), ..plate }
}

/// Age at which the paint is looked at.
pub const AGE: f64 = 0.95;

/// Shares of a painted plate that have let go, and how well the map of margins foretold it.
pub struct Steered {
    /// Where it was protected, where nothing was done, and where it was weakened.
    pub shares: [Spread; 3],
    /// Correlation of the ranks of the margin of adhesion over bending force at the beginning, which the map shows,
    /// with those of the age at which places let go.
    pub foretold: Spread,
}

/// Ages painted plates.
///
/// # Errors
/// [`NoFilm`] if there is no plate.
pub fn steered() -> Result<Steered, NoFilm> {
    let [a, b, c, foretold] = over_seeds(|seed| {
        let plate = plate(seed);
        let mut settings = plate.settings.clone();
        settings.deform.sweeps_per_age = 0.0;
        let mut film: FilmState = plate.film(500)?;
        let gain = settings.bending.gain;
        let margins: Vec<f32> = (film.mesh.topology.all_vertices())
            .map(|v| film.forces.adhesion(v) - bending_force(&film.mesh, &film.forces, v, gain))
            .collect();
        let strokes = strokes();
        let part = |v: usize| {
            let place = film.mesh.geometry.rest_positions[v].truncate();
            strokes.iter().position(|stroke| stroke.covers(place)).map_or(1, |stroke| 2 * stroke)
        };
        let parts: Vec<usize> = (0..margins.len()).map(part).collect();
        film.age_to(AGE, &settings, &Environment::default());
        let ages = &film.forces.separated_age;
        let mut sums = [(0.0, 0.0f64); 3];
        for (part, age) in parts.iter().zip(ages) {
            sums[*part].0 += f64::from(u8::from(age.is_finite()));
            sums[*part].1 += 1.0;
        }
        let [a, b, c] = sums.map(|(off, all)| off / all.max(1.0));
        film.age_to(2.0, &settings, &Environment::default());
        Ok([a, b, c, rank_correlation(&margins, &film.forces.separated_age[..margins.len()])])
    })?;
    Ok(Steered { shares: [a, b, c], foretold })
}

/// Returns Spearman's correlation of the ranks of two lists of one length.
fn rank_correlation(a: &[f32], b: &[f32]) -> f64 {
    let ranks = |values: &[f32]| {
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by(|&i, &j| values[i].total_cmp(&values[j]));
        let mut ranks = vec![0.0; values.len()];
        // Equal values share the mean of their ranks.
        let mut first = 0.0;
        for equal in order.chunk_by(|&i, &j| values[i] == values[j]) {
            let count = equal.len() as f64;
            equal.iter().for_each(|&i| ranks[i] = first + (count - 1.0) / 2.0);
            first += count;
        }
        ranks
    };
    let (a, b) = (ranks(a), ranks(b));
    let mean = (a.len().max(1) - 1) as f64 / 2.0;
    let product = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum::<f64>();
    product(&a, &b) / (product(&a, &a) * product(&b, &b)).sqrt()
}
