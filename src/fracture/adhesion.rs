//! Draws the initial adhesion of a film from Perlin noise (VC 5.1).

use bevy_math::{DVec3, Vec3};
use noise::{NoiseFn, Perlin};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{
    film::{Grain, rotation::Rotation},
    settings::AdhesionSettings,
};

/// Amplitude of each further octave, relative to the octave before.
const GAIN: f64 = 0.5;
/// Frequency of each further octave, relative to the octave before.
const LACUNARITY: f64 = 2.0;
/// Least number of cycles over a prop: one much smaller than the noise would be all strong or all weak.
const LEAST_CYCLES: f32 = 2.0;
/// Standard deviation of one octave of `noise::Perlin` at arbitrary places, measured over 2,000 seeds with 500 places
/// each (a test checks it over 400 seeds). It is a constant so that films are not normalised one by one: a small film
/// may well be weak or strong everywhere.
const PERLIN_DEVIATION: f64 = 0.3103;
/// Distance from the origin, in cells of the noise, beyond which there is no noise. Numbers of cells fit 32 bits.
const FARTHEST: f64 = (1 << 30) as f64;

/// Returns the adhesion of a fresh film at each of `positions` (VC 5.1), as forces in units of the initial contraction.
///
/// The values are Perlin noise with the mean and standard deviation of `settings`; negative values become 0. The noise
/// runs through [`frequency`](AdhesionSettings::frequency) cycles over the longest side of the bounding box of
/// `positions`, so the unit of length does not matter. On a film with a `grain` its wavelength is
/// [`wavelength`](AdhesionSettings::wavelength) grains, but there are at least two cycles. `seed` rotates and shifts
/// the noise at random, so that no lattice plane of the noise (where Perlin noise is 0) lies in a flat film. If all
/// positions coincide, all values are equal.
///
/// ```
/// use bevy_coating::{fracture::adhesion_field, settings::AdhesionSettings};
/// use bevy_math::Vec3;
///
/// let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
/// let settings = AdhesionSettings::default();
/// let field = adhesion_field(&corners, &settings, None, 7);
/// assert_eq!(field.len(), corners.len());
/// assert!(field.iter().all(|&adhesion| adhesion >= 0.0));
/// assert_eq!(field, adhesion_field(&corners, &settings, None, 7), "the same seed gives the same noise");
///
/// let even = AdhesionSettings { mean: 2.0, deviation: 0.0, ..settings };
/// assert_eq!(adhesion_field(&corners, &even, None, 7), [2.0; 3]);
/// ```
pub fn adhesion_field(positions: &[Vec3], settings: &AdhesionSettings, grain: Option<Grain>, seed: u64) -> Vec<f32> {
    adhesion_at(positions, positions.iter().copied(), settings, grain, seed).collect()
}

/// Returns the same at some `places` of the film that has vertices at `positions`.
pub(super) fn adhesion_at(
    positions: &[Vec3],
    places: impl Iterator<Item = Vec3>,
    settings: &AdhesionSettings,
    grain: Option<Grain>,
    seed: u64,
) -> impl Iterator<Item = f32> {
    let (min, max) =
        positions.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), &p| (min.min(p), max.max(p)));
    let longest = (max - min).max_element();
    let cycles = match grain {
        Some(grain) => (longest / (settings.wavelength * grain.length)).max(LEAST_CYCLES),
        None => settings.frequency,
    };
    let scale = if longest > 0.0 { cycles / longest } else { 0.0 };
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let perlin = Perlin::new(rng.random());
    let rotation = random_rotation(&mut rng);
    let shift = Vec3::from_array(rng.random()) * 256.0;
    let (mean, octaves) = (settings.mean, settings.octaves);
    let amplitude = f64::from(settings.deviation) / octaves_deviation(octaves);
    places.map(move |p| {
        let q = rotation.apply((p - min) * scale).as_dvec3() + shift.as_dvec3();
        let (mut sum, mut gain, mut frequency) = (0.0, 1.0, 1.0);
        for _ in 0..octaves {
            sum += gain * noise_at(&perlin, q * frequency);
            gain *= GAIN;
            frequency *= LACUNARITY;
        }
        (mean + (amplitude * sum) as f32).max(0.0)
    })
}

/// Returns the noise at `place`; 0 where it is so far out, in cells, that no number says where in its cell it lies, and
/// where it is no place: settings out of range ask for that. The noise itself has an answer in neither case.
fn noise_at(perlin: &Perlin, place: DVec3) -> f64 {
    let place = place.to_array();
    if place.iter().all(|x| x.abs() < FARTHEST) { perlin.get(place) } else { 0.0 }
}

/// Returns the standard deviation of the sum of `octaves` octaves. At arbitrary places the octaves of Perlin noise are
/// uncorrelated, so their variances add up.
fn octaves_deviation(octaves: u32) -> f64 {
    let (mut variance, mut gain) = (0.0, 1.0);
    for _ in 0..octaves.max(1) {
        variance += gain * gain;
        gain *= GAIN;
    }
    PERLIN_DEVIATION * variance.sqrt()
}

/// Draws a rotation from the uniform distribution: a quaternion from the unit ball, by rejection, so that no
/// trigonometry is needed.
fn random_rotation(rng: &mut ChaCha8Rng) -> Rotation {
    loop {
        let quaternion = rng.random::<[f32; 4]>().map(|number| number * 2.0 - 1.0);
        if (0.01..=1.0).contains(&Rotation::length_squared(quaternion)) {
            return Rotation::of(quaternion);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moments(values: impl Iterator<Item = f64>) -> (f64, f64) {
        let (mut n, mut sum, mut squares) = (0.0, 0.0, 0.0);
        for v in values {
            n += 1.0;
            sum += v;
            squares += v * v;
        }
        let mean: f64 = sum / n;
        (mean, (squares / n - mean * mean).sqrt())
    }

    fn flat(n: u32) -> Vec<Vec3> {
        (0..n * n).map(|i| Vec3::new((i % n) as f32, (i / n) as f32, 0.0) / (n - 1) as f32).collect()
    }

    #[test]
    fn no_frequency_and_no_place_is_too_large() {
        for cycles in [f32::INFINITY, f32::NAN, -1e38, 1e20, 0.0] {
            for size in [1.0, 1e-38, 1e38] {
                let positions: Vec<Vec3> = flat(3).into_iter().map(|p| p * size).collect();
                let settings =
                    AdhesionSettings { frequency: cycles, wavelength: cycles, ..AdhesionSettings::default() };
                for grain in [None, Some(Grain { length: size })] {
                    assert_eq!(adhesion_field(&positions, &settings, grain, 7).len(), 9, "{cycles} on {size} m");
                }
            }
        }
    }

    #[test]
    fn field_has_the_mean_and_deviation_asked_for_over_seeds() {
        let positions = flat(24);
        // No clamping at this mean, so the moments are those of the noise itself.
        for octaves in [1, 2, 4] {
            let settings = AdhesionSettings { mean: 10.0, octaves, ..AdhesionSettings::default() };
            let (mean, deviation) =
                moments((0..400).flat_map(|seed| adhesion_field(&positions, &settings, None, seed)).map(f64::from));
            assert!((mean - 10.0).abs() < 0.02, "{mean} with {octaves} octaves");
            assert!((deviation - 0.70).abs() < 0.03, "{deviation} with {octaves} octaves");
        }
    }

    #[test]
    fn field_is_clamped_at_zero_and_follows_the_seed() {
        let positions = flat(12);
        let settings = AdhesionSettings { mean: 0.2, deviation: 1.0, ..AdhesionSettings::default() };
        let field = adhesion_field(&positions, &settings, None, 1);
        assert!(field.iter().all(|&a| a >= 0.0));
        assert!(field.contains(&0.0) && field.iter().any(|&a| a > 0.5));
        assert_eq!(field, adhesion_field(&positions, &settings, None, 1));
        assert_ne!(field, adhesion_field(&positions, &settings, None, 2));
    }

    #[test]
    fn field_does_not_depend_on_the_size_of_the_prop() {
        let settings = AdhesionSettings::default();
        let small = adhesion_field(&flat(9), &settings, None, 3);
        let large = adhesion_field(&flat(9).iter().map(|p| p * 1024.0).collect::<Vec<_>>(), &settings, None, 3);
        assert!(small.iter().zip(&large).all(|(a, b)| (a - b).abs() < 1e-4));
    }

    #[test]
    fn a_film_without_extent_is_uniform() {
        let field = adhesion_field(&[Vec3::ONE; 3], &AdhesionSettings::default(), None, 0);
        assert!(field.iter().all(|a| a.is_finite() && *a == field[0]));
    }
}
