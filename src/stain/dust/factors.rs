//! Computes how fast dust settles from the three factors of the paper (VC 6.2).

use core::f32::consts::PI;

use bevy_math::ops;

use crate::settings::DustSettings;

/// Geometric factors that decide how fast dust settles at a vertex (VC 6.2).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DustFactors {
    /// Height against gravity within the prop at rest: from 0 (its lowest point) to 1 (its highest).
    pub height: f32,
    /// Cosine between the surface normal and gravity: from -1 (faces up) to 1 (faces down).
    pub facing: f32,
    /// Mean dihedral angle of the edges opposite the vertex, in radians: pi is flat, above pi is convex.
    pub dihedral: f32,
}

/// Returns the rate at which dust settles, per unit age (VC 6.2, fig. 11).
///
/// Dust settles more slowly where the surface is higher, faces along gravity, or is more convex. The rate is
/// `rate` (1 - `height` h) (1 - `direction` (1 + f) / 2) (1 + `curvature` (c - 1/2)) with the fields of `settings`,
/// where h is the height, f the facing, and c = 1 / (1 + exp(4 (dihedral - pi))).
///
/// ```
/// use std::f32::consts::PI;
///
/// use bevy_coating::{
///     settings::DustSettings,
///     stain::{DustFactors, dust_rate},
/// };
///
/// let settings = DustSettings::default();
/// let foot = DustFactors { height: 0.0, facing: -1.0, dihedral: PI };
/// assert_eq!(dust_rate(foot, &settings), settings.rate);
/// assert!(dust_rate(DustFactors { facing: 1.0, ..foot }, &settings) < settings.rate, "less settles on undersides");
/// ```
pub fn dust_rate(factors: DustFactors, settings: &DustSettings) -> f32 {
    let DustFactors { height, facing, dihedral } = factors;
    let hollow = 1.0 / (1.0 + ops::exp(4.0 * (dihedral - PI)));
    let rate = settings.rate
        * (1.0 - settings.height * height)
        * (1.0 - settings.direction * 0.5 * (1.0 + facing))
        * (1.0 + settings.curvature * (hollow - 0.5));
    // A cosine that was rounded to above 1 must not make dust go.
    if rate > 0.0 { rate } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dust_is_slower_where_higher_facing_down_and_convex() {
        let settings = DustSettings::default();
        let rate = |height, facing, dihedral| dust_rate(DustFactors { height, facing, dihedral }, &settings);
        for step in 0..20 {
            let t = step as f32 / 20.0;
            let next = t + 0.05;
            assert!(rate(next, 0.2, PI) < rate(t, 0.2, PI), "height {t}");
            assert!(rate(0.3, 2.0 * next - 1.0, PI) < rate(0.3, 2.0 * t - 1.0, PI), "facing {t}");
            assert!(rate(0.3, 0.2, 2.0 * PI * next) < rate(0.3, 0.2, 2.0 * PI * t), "curvature {t}");
        }
        // VC 6.2 with the constants of the method.
        assert!((rate(1.0, 1.0, PI) - 1.2 * 0.6 * 0.2).abs() < 1e-6);
        assert!((rate(0.0, -1.0, PI) - 1.2).abs() < 1e-6);
    }

    #[test]
    fn each_factor_can_be_seen_alone() {
        let alone = |set: fn(&mut DustSettings)| {
            let mut settings = DustSettings { height: 0.0, direction: 0.0, curvature: 0.0, ..DustSettings::default() };
            set(&mut settings);
            let rate = |height, facing, dihedral| dust_rate(DustFactors { height, facing, dihedral }, &settings);
            let reference = rate(0.2, 0.1, 3.0);
            [rate(0.9, 0.1, 3.0), rate(0.2, 0.8, 3.0), rate(0.2, 0.1, 3.5)].map(|rate| rate < reference)
        };
        assert_eq!(alone(|_| {}), [false; 3]);
        assert_eq!(alone(|s| s.height = 1.0), [true, false, false]);
        assert_eq!(alone(|s| s.direction = 1.0), [false, true, false]);
        assert_eq!(alone(|s| s.curvature = 1.0), [false, false, true]);
    }
}
