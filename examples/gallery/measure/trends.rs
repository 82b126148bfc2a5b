//! How the paper's plates crack: with age, and with the parameters alpha and beta.

use bevy_coating::{
    settings::CoatingSettings,
    sim::{FilmMeasures, FilmState},
    stain::Environment,
};

use super::{
    exhibit::{Exhibit, NoFilm, Shape, paper},
    spread::{SEEDS, Spread, in_parallel, spreads},
};

/// Triangles of the paper's coarse plate and of its fine one.
pub const PLATES: [u32; 2] = [3_012, 11_488];

const STEPS: u32 = 500;

/// Returns the paper's settings without bending, which changes nothing of what is measured here: fracture is judged at
/// rest.
fn unbent() -> CoatingSettings {
    let mut settings = paper();
    settings.deform.sweeps_per_age = 0.0;
    settings
}

/// Ages a plate and measures it at each of `ages`, which rise.
fn measured(triangles: u32, settings: &CoatingSettings, seed: u64, ages: &[f64]) -> Result<Vec<FilmMeasures>, NoFilm> {
    let plate = Exhibit { seed, ..Exhibit::new("plate", "", Shape::Plate(triangles), settings.clone()) };
    let mut film: FilmState = plate.film(STEPS)?;
    let at = |age: &f64| {
        film.age_to(*age, settings, &Environment::default());
        film.measure()
    };
    Ok(ages.iter().map(at).collect())
}

/// Measures plates with each of `settings` and each seed, and returns the spreads of what `of` takes from them.
fn plates_over_seeds<const N: usize>(
    triangles: u32,
    settings: &[CoatingSettings],
    ages: &[f64],
    of: impl Fn(&[FilmMeasures]) -> [f64; N] + Sync,
) -> Result<Vec<[Spread; N]>, NoFilm> {
    let seeds: Vec<u64> = SEEDS.collect();
    let runs = in_parallel(settings.len() * seeds.len(), |index| {
        let (settings, seed) = (&settings[index / seeds.len()], seeds[index % seeds.len()]);
        measured(triangles, settings, seed, ages).map(|measures| of(&measures))
    });
    let rows = runs.into_iter().collect::<Result<Vec<_>, _>>()?;
    Ok(rows.chunks(seeds.len()).map(spreads).collect())
}

/// Ages at which shares are given.
pub const AGES: [f64; 4] = [0.2, 0.4, 0.6, 1.0];

/// Returns the shares of the coarse plate that have separated, torn and been stripped, in that order, at each of
/// [`AGES`]. Loose pieces stay, as in the paper.
///
/// # Errors
/// [`NoFilm`] if there is no plate.
pub fn shares_by_age() -> Result<[[Spread; 3]; 4], NoFilm> {
    let mut settings = unbent();
    settings.stripping.fall_faces = 0;
    let rows = plates_over_seeds(PLATES[0], &[settings], &AGES, |measures| {
        let mut all = [0.0; 12];
        for (shares, m) in all.as_chunks_mut::<3>().0.iter_mut().zip(measures) {
            *shares = [m.separated, m.torn, m.stripped].map(Option::unwrap_or_default);
        }
        all
    })?;
    let all = rows.first().copied().unwrap_or_default();
    Ok(std::array::from_fn(|age| std::array::from_fn(|share| all[3 * age + share])))
}

/// Values of alpha: how straight ahead an edge must lie to tear easily, as a cosine. The paper's is 0.45.
pub const ALPHAS: [f32; 6] = [-0.5, 0.0, 0.45, 0.7, 0.9, 0.95];
/// Age at which cracks are compared: later ones meet older ones everywhere.
pub const ALPHA_AGE: f64 = 0.6;

/// Returns the straightness of cracks and their length, in sides of the plate, for each of [`ALPHAS`].
///
/// # Errors
/// [`NoFilm`] if there is no plate.
pub fn cracks_by_alpha(triangles: u32) -> Result<Vec<[Spread; 2]>, NoFilm> {
    let settings = ALPHAS.map(|alpha| {
        let mut settings = unbent();
        settings.tearing.alpha = alpha;
        settings
    });
    plates_over_seeds(triangles, &settings, &[ALPHA_AGE], |measures| {
        let m = &measures[0];
        [m.straightness.unwrap_or_default(), m.crack_length.unwrap_or_default()]
    })
}

/// Alpha that makes the fine plate crack about as densely as the coarse one.
pub const HIGH_ALPHA: f32 = 0.9;

/// Returns settings that count in metres, without stains: the defaults.
pub fn by_grain() -> CoatingSettings {
    let mut settings = CoatingSettings::default();
    settings.dust.rate = 0.0;
    settings.rust.emission = 0.0;
    settings
}

/// Returns the length of cracks, in sides of the plate, on the coarse plate and on the fine one, by rules in metres.
///
/// # Errors
/// [`NoFilm`] if there is no plate.
pub fn cracks_by_grain() -> Result<[Spread; 2], NoFilm> {
    let mut settings = by_grain();
    settings.deform.sweeps_per_age = 0.0;
    let mut found = [Spread::default(); 2];
    for (found, triangles) in found.iter_mut().zip(PLATES) {
        let rows = plates_over_seeds(triangles, &[settings.clone()], &[ALPHA_AGE], |measures| {
            [measures[0].crack_length.unwrap_or_default()]
        })?;
        [*found] = rows.first().copied().unwrap_or_default();
    }
    Ok(found)
}

/// Values of beta: the share of its binding that an edge ahead of a crack has. The paper's is 0.2.
pub const BETAS: [f32; 9] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9];

/// Returns the share of torn edges of the coarse plate at age 1 for each of [`BETAS`].
///
/// # Errors
/// [`NoFilm`] if there is no plate.
pub fn torn_by_beta() -> Result<Vec<Spread>, NoFilm> {
    let settings = BETAS.map(|beta| {
        let mut settings = unbent();
        settings.tearing.beta = beta;
        settings
    });
    let rows = plates_over_seeds(PLATES[0], &settings, &[1.0], |measures| [measures[0].torn.unwrap_or_default()])?;
    Ok(rows.into_iter().map(|[torn]| torn).collect())
}
