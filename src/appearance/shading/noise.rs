//! Evaluates seeded gradient noise, from which patterns finer than the mesh are made. Detail that is too fine to be
//! seen is averaged.
//!
//! Besides a hash of integers only addition, multiplication, division, square root and `exp` are used, so that the
//! shader draws the same patterns (`src/display/material/noise.wgsl`).

use bevy_math::{Vec3, ops};

/// Standard deviation of [`noise`].
const DEVIATION: f32 = 0.1887;
/// Slope of the logistic curve that is closest to the cumulative normal distribution.
const LOGISTIC: f32 = 1.702;

/// One octave of a pattern: size of its grains in metres, and weight.
pub(super) type Octave = (f32, f32);

/// Value of a pattern at one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Grain {
    /// Value, evenly distributed over 0 to 1 where the whole pattern can be seen; 0.5 where none of it can.
    pub value: f32,
    /// Share of the pattern that can be seen: 1 for all of it, 0 where all grains are smaller than the footprint.
    pub kept: f32,
}

impl Grain {
    /// Value everywhere of a pattern of which nothing can be seen.
    pub const EVEN: Self = Self { value: 0.5, kept: 0.0 };

    /// Returns the share of this place, 0 to 1, that a stain of `amount` (0 to 1) covers. The grains with the highest
    /// values are covered first, with edges of the given softness. The mean over the pattern is `amount`, and so is
    /// every place where grains are too small to be seen.
    pub fn cover(self, amount: f32, softness: f32) -> f32 {
        // Near amounts of 0 and 1 the edges are sharp, so that 0 covers nothing and 1 covers everything.
        let softness = softness.min(amount).min(1.0 - amount) + 1e-4;
        let threshold = 1.0 - self.value;
        let sharp = smoothstep(threshold - softness, threshold + softness, amount);
        mix(amount, sharp, self.kept)
    }

    /// Returns the value scaled to the range from `middle - swing` to `middle + swing`.
    pub fn around(self, middle: f32, swing: f32) -> f32 {
        middle + swing * (2.0 * self.value - 1.0)
    }
}

/// Sums three octaves of noise. `place` returns the point at which the noise is evaluated for grains of a given size in
/// metres. Octaves with grains smaller than `footprint` are left out.
pub(super) fn grain(octaves: [Octave; 3], footprint: f32, place: impl Fn(f32) -> Vec3) -> Grain {
    let (mut sum, mut kept, mut all) = (0.0, 0.0, 0.0);
    for (i, (size, weight)) in octaves.into_iter().enumerate() {
        let seen = weight * (1.0 - smoothstep(0.35, 1.0, footprint / size));
        if seen > 0.0 {
            // Octaves on a common grid would line up.
            sum += seen * noise(place(size) + Vec3::splat(19.37 * i as f32));
            kept += seen * seen;
        }
        all += weight * weight;
    }
    let deviations = sum / (DEVIATION * all.sqrt());
    Grain { value: 1.0 / (1.0 + ops::exp(-LOGISTIC * deviations)), kept: kept / all }
}

/// Returns whether grains of all octaves are smaller than `footprint`, so that nothing of the pattern can be seen.
pub(super) fn is_too_fine(octaves: [Octave; 3], footprint: f32) -> bool {
    octaves.iter().all(|&(size, _)| footprint >= size)
}

/// Returns gradient noise at `p`: smooth, with mean 0, mostly within -0.4 to 0.4, and grains of about one unit.
pub(super) fn noise(p: Vec3) -> f32 {
    let cell = p.floor();
    let f = p - cell;
    let t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let [x, y, z] = cell.as_ivec3().to_array().map(|i| i as u32);
    let at = |dx: u32, dy: u32, dz: u32| {
        let corner = Vec3::new(dx as f32, dy as f32, dz as f32);
        gradient(x.wrapping_add(dx), y.wrapping_add(dy), z.wrapping_add(dz)).dot(f - corner)
    };
    let along_x = |dy, dz| mix(at(0, dy, dz), at(1, dy, dz), t.x);
    mix(mix(along_x(0, 0), along_x(1, 0), t.y), mix(along_x(0, 1), along_x(1, 1), t.y), t.z)
}

/// Returns the gradient at a corner of the grid: each component evenly distributed over -1 to 1.
fn gradient(x: u32, y: u32, z: u32) -> Vec3 {
    let h = hash(x, y, z);
    Vec3::new((h & 1023) as f32, ((h >> 10) & 1023) as f32, ((h >> 20) & 1023) as f32) / 511.5 - 1.0
}

/// Hashes three numbers to one (murmur3's finaliser over a mix of primes).
pub(super) fn hash(x: u32, y: u32, z: u32) -> u32 {
    let mut h = x.wrapping_mul(0x9e37_79b1) ^ y.wrapping_mul(0x85eb_ca77) ^ z.wrapping_mul(0xc2b2_ae3d);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

/// Returns a random number from 0 to 1 for `level`, a whole number.
pub(super) fn of_level(level: f32) -> f32 {
    (hash(level as i32 as u32, 7, 13) & 1023) as f32 / 1023.0
}

/// Returns the linear mix of `a` (at `t` 0) and `b` (at `t` 1).
pub(super) fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// Returns a smooth step from 0 at `low` to 1 at `high`, as in WGSL.
pub(super) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> impl Iterator<Item = Vec3> {
        (0..40_000).map(|i| {
            let h = |k| (hash(i, k, 5) & 0xffff) as f32 / 4096.0 - 8.0;
            Vec3::new(h(1), h(2), h(3))
        })
    }

    #[test]
    fn noise_has_the_deviation_it_is_scaled_by() {
        let values: Vec<f32> = places().map(noise).collect();
        let mean = values.iter().sum::<f32>() / values.len() as f32;
        let deviation = (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f32>() / values.len() as f32).sqrt();
        assert!(mean.abs() < 0.01 && (deviation / DEVIATION - 1.0).abs() < 0.03, "{mean} {deviation}");
    }

    #[test]
    fn noise_is_smooth_across_cells() {
        let mut last = noise(Vec3::splat(-20.0));
        for i in 0..8000 {
            let value = noise(Vec3::new(-20.0 + 0.01 * i as f32, -20.0 + 0.007 * i as f32, -20.0));
            assert!((value - last).abs() < 0.05, "{last} to {value}");
            last = value;
        }
    }

    #[test]
    fn grains_spread_evenly_and_cover_what_they_are_given() {
        let octaves = [(1.0, 0.5), (0.4, 0.35), (0.17, 0.25)];
        let grains: Vec<Grain> = places().map(|p| grain(octaves, 0.0, |size| p / size)).collect();
        let mut values: Vec<f32> = grains.iter().map(|g| g.value).collect();
        values.sort_unstable_by(f32::total_cmp);
        for tenth in 1..10 {
            let value = values[tenth * values.len() / 10];
            assert!((value - 0.1 * tenth as f32).abs() < 0.04, "{tenth}: {value}");
        }
        for amount in [0.0, 0.1, 0.3, 0.6, 0.9] {
            let covered = grains.iter().map(|g| g.cover(amount, 0.1)).sum::<f32>() / grains.len() as f32;
            assert!((covered - amount).abs() < 0.05, "{covered} of {amount}");
        }
        let unseen = grain(octaves, 2.0, |size| Vec3::splat(0.3) / size);
        assert_eq!((unseen.kept, unseen.cover(0.37, 0.1)), (0.0, 0.37));
    }
}
