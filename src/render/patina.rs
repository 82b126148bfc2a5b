//! Rust over bare metal: a colour for each vertex, from seeded noise in the film's space.

use bevy::{color::LinearRgba, math::Vec3};

/// Patches of rust over one metre, or over the prop's size where that is smaller.
const OCTAVES: [(f32, f32); 3] = [(1.0, 0.5), (2.3, 0.3), (5.1, 0.2)];

/// Colours of bare metal: `steel` where it has rusted least, `rust` where most, in patches of about `size`.
pub(super) fn patina(
    positions: &[[f32; 3]],
    steel: LinearRgba,
    rust: LinearRgba,
    size: f32,
    seed: u64,
) -> Vec<[f32; 4]> {
    let [steel, rust] = [steel, rust].map(|color| Vec3::new(color.red, color.green, color.blue));
    let seed = (seed ^ (seed >> 32)) as u32;
    positions
        .iter()
        .map(|&p| {
            let p = Vec3::from_array(p) / size;
            let noise: f32 = OCTAVES.iter().map(|&(cycles, weight)| weight * value_noise(p * cycles, seed)).sum();
            // Sums of noise keep to the middle: stretched, so that both ends show.
            let share = ((noise - 0.5) * 2.2 + 0.5).clamp(0.0, 1.0);
            // A darker film of soot over all, unlike the patches.
            let shade = 0.75 + 0.5 * value_noise(p * 3.7 + 17.0, seed ^ 0x9e37_79b9);
            (steel.lerp(rust, share) * shade).extend(1.0).to_array()
        })
        .collect()
}

/// Noise in 0 to 1 that is smooth in `p`, one cycle a unit: random values at the corners of a grid, blended.
fn value_noise(p: Vec3, seed: u32) -> f32 {
    let cell = p.floor();
    let t = p - cell;
    let t = t * t * (Vec3::splat(3.0) - 2.0 * t);
    let [x, y, z] = cell.as_ivec3().to_array().map(|i| i as u32);
    let at = |dx: u32, dy: u32, dz: u32| {
        let hash = scramble(x.wrapping_add(dx), scramble(y.wrapping_add(dy), scramble(z.wrapping_add(dz), seed)));
        // 24 bits are exact in f32.
        (hash >> 8) as f32 / 16_777_216.0
    };
    let mix = |a: f32, b: f32, t: f32| a + (b - a) * t;
    let along_x = |dy, dz| mix(at(0, dy, dz), at(1, dy, dz), t.x);
    mix(mix(along_x(0, 0), along_x(1, 0), t.y), mix(along_x(0, 1), along_x(1, 1), t.y), t.z)
}

/// Mixes `value` into `state`, so that all bits of the result depend on all bits of both (murmur3's finaliser).
fn scramble(value: u32, state: u32) -> u32 {
    let mut h = value.wrapping_mul(0xcc9e_2d51) ^ state.rotate_left(13);
    h = (h ^ (h >> 16)).wrapping_mul(0x85eb_ca6b);
    h = (h ^ (h >> 13)).wrapping_mul(0xc2b2_ae35);
    h ^ (h >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_smooth_and_spreads_over_its_range() {
        let mut values = Vec::new();
        let mut last = value_noise(Vec3::splat(-20.0), 5);
        for i in 0..4000 {
            let p = Vec3::new(-20.0 + 0.01 * i as f32, -20.0 + 0.007 * i as f32, -20.0);
            let value = value_noise(p, 5);
            assert!((0.0..=1.0).contains(&value) && (value - last).abs() < 0.05, "{last} to {value} at {p}");
            last = value;
            values.push(value);
        }
        values.sort_unstable_by(f32::total_cmp);
        assert!(values[400] < 0.35 && values[3600] > 0.65, "{} {}", values[400], values[3600]);
    }

    #[test]
    fn patches_are_the_seeds() {
        let positions: Vec<[f32; 3]> = (0..50).map(|i| [0.1 * i as f32, 0.0, 0.3]).collect();
        let colors = |seed| patina(&positions, LinearRgba::BLACK, LinearRgba::WHITE, 1.0, seed);
        assert_eq!(colors(1), colors(1));
        assert_ne!(colors(1), colors(2));
        assert!(colors(1).iter().all(|c| c.iter().all(|x| x.is_finite() && *x >= 0.0)));
    }
}
