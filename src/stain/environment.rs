//! Describes what acts on a film from outside: gravity, wind, rain and sun.

use bevy_math::Vec3;

use crate::film::direction::unit_or_zero;

/// Hardest wind, as a multiple of gravity.
const MOST_WIND: f32 = 100.0;
/// Largest spread by gusts, in metres after one metre.
const MOST_GUSTS: f32 = 10.0;

/// Gravity, wind, rain and sun that act on a film. All vectors are in the film's own space.
///
/// The functions that take an environment bring what is out of range into it first ([`Environment::in_range`]).
///
/// The default is [`Environment::still`] with gravity along -y.
///
/// ```
/// use bevy_coating::stain::Environment;
/// use bevy_math::Vec3;
///
/// let storm = Environment {
///     wind: Vec3::new(0.5, 0.0, 0.0),  // drags run-off half as hard as gravity
///     rain: Vec3::new(0.6, -0.8, 0.0), // full rain, driven by the wind
///     ..Environment::default()
/// };
/// assert_eq!(storm.gravity, Vec3::NEG_Y);
/// assert_eq!(storm.sun, Vec3::ZERO);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Environment {
    /// Direction of gravity, of any length, or zero in weightlessness, where nothing runs off.
    pub gravity: Vec3,
    /// Direction in which the wind blows. Its length is how hard the wind drags run-off along: 1 is as hard as gravity,
    /// zero is still air. At most 100.
    pub wind: Vec3,
    /// Sideways spread of run-off by gusts: the standard deviation in metres after one metre, 0 to 10. It adds to
    /// [`RustSettings::spread`](crate::settings::RustSettings::spread) (as variances do).
    pub gusts: f32,
    /// Direction in which rain falls. Its length is the strength of the rain, from 0 to 1. Zero is dry weather: nothing
    /// gets wet.
    pub rain: Vec3,
    /// Direction in which sunlight falls. Its length is the strength of the sunlight, from 0 to 1. Zero is shade.
    pub sun: Vec3,
}

impl Environment {
    /// Creates an environment of still air, dry weather and shade under `gravity`, a direction or zero.
    ///
    /// ```
    /// use bevy_coating::stain::Environment;
    /// use bevy_math::Vec3;
    ///
    /// let lying = Environment::still(Vec3::NEG_Z);
    /// assert_eq!((lying.gravity, lying.rain, lying.gusts), (Vec3::NEG_Z, Vec3::ZERO, 0.0));
    /// ```
    pub fn still(gravity: Vec3) -> Self {
        Self { gravity, wind: Vec3::ZERO, gusts: 0.0, rain: Vec3::ZERO, sun: Vec3::ZERO }
    }

    /// Returns this environment with everything in its range: gravity of unit length or zero, rain and sun no stronger
    /// than 1, wind and gusts within their limits. A vector that is not finite counts as zero. What is in range keeps
    /// its bits.
    ///
    /// ```
    /// use bevy_coating::stain::Environment;
    /// use bevy_math::Vec3;
    ///
    /// let odd = Environment { rain: Vec3::Y * -3.0, gusts: -1.0, ..Environment::still(Vec3::Y * -9.81) };
    /// assert_eq!(odd.in_range(), Environment { rain: Vec3::NEG_Y, ..Environment::default() });
    /// ```
    pub fn in_range(&self) -> Self {
        Self {
            gravity: unit_or_zero(self.gravity),
            wind: no_longer(self.wind, MOST_WIND),
            gusts: if self.gusts > 0.0 { self.gusts.min(MOST_GUSTS) } else { 0.0 },
            rain: no_longer(self.rain, 1.0),
            sun: no_longer(self.sun, 1.0),
        }
    }
}

impl Default for Environment {
    /// Returns [`Environment::still`] with gravity along -y.
    fn default() -> Self {
        Self::still(Vec3::NEG_Y)
    }
}

/// Returns `v`, shortened to the length `most` if it is longer; zero if it is not finite.
fn no_longer(v: Vec3, most: f32) -> Vec3 {
    // Unit vectors are a little longer than 1 by rounding.
    if v.length_squared() <= most * most * 1.001 { v } else { unit_or_zero(v) * most }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_environment_is_brought_into_range() {
        let sizes = [1e-42f32, 1e-30, 0.5, 2.0, 9.81, 1e19, 1e30, f32::MAX];
        let odd = [Vec3::NAN, Vec3::splat(f32::INFINITY), Vec3::new(f32::NAN, 0.0, 1.0)];
        let along = Vec3::new(0.6, -0.8, 0.0);
        for v in sizes.iter().map(|size| along * *size).chain(odd) {
            let environment = Environment { gravity: v, wind: v, gusts: v.x, rain: v, sun: v }.in_range();
            let Environment { gravity, wind, gusts, rain, sun } = environment;
            let right = if v.is_finite() { along } else { Vec3::ZERO };
            assert!(gravity.distance(right) < 1e-4 || v.length() < 1e-40, "{v}: {gravity}");
            assert!(gravity == Vec3::ZERO || gravity.is_normalized());
            assert!(rain.length() <= 1.001 && sun.length() <= 1.001 && wind.length() <= 100.1, "{v}: {environment:?}");
            assert!((0.0..=10.0).contains(&gusts));
            assert!(wind.is_finite() && rain.is_finite() && sun.is_finite());
        }
        let still = Environment::still(along);
        assert_eq!(still.in_range(), still, "what is in range keeps its bits");
    }
}
