//! Noise as a mask.

use bevy_math::Vec3;
use noise::{NoiseFn, Perlin};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Amplitude of the second octave, of half the wavelength.
const GAIN: f64 = 0.5;
/// Standard deviations of the noise from 0.5 to 1: what is beyond is cut off, about one place in forty.
const DEVIATIONS: f64 = 2.0;
/// Standard deviation of one octave of `noise::Perlin`: see `fracture::adhesion`.
const PERLIN_DEVIATION: f64 = 0.3103;
/// Distance from the origin, in cells of the noise, beyond which there is none. Numbers of cells fit 32 bits.
const FARTHEST: f64 = (1 << 30) as f64;

/// Returns noise from 0 to 1 at each of `places`, of a wavelength in metres.
pub(super) fn noise_at(places: &[Vec3], seed: u64, wavelength: f32) -> Vec<f32> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let perlin = Perlin::new(rng.random());
    // The noise is 0 on its lattice planes: a random shift keeps them off the planes of props.
    let shift = Vec3::from_array(rng.random()).as_dvec3() * 256.0;
    let scale = DEVIATIONS * PERLIN_DEVIATION * (1.0 + GAIN * GAIN).sqrt();
    let octave = |place: bevy_math::DVec3| {
        let place = place.to_array();
        if place.iter().all(|x| x.abs() < FARTHEST) { perlin.get(place) } else { 0.0 }
    };
    let weigh = |place: &Vec3| {
        let place = place.as_dvec3() / f64::from(wavelength) + shift;
        let value = octave(place) + GAIN * octave(place * 2.0);
        #[expect(clippy::cast_possible_truncation, reason = "it is a number from 0 to 1")]
        let weight = (0.5 + 0.5 * value / scale).clamp(0.0, 1.0) as f32;
        weight
    };
    places.iter().map(weigh).collect()
}
