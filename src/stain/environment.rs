//! Describes what acts on a film from outside: gravity, wind, rain and sun.

use bevy_math::Vec3;

/// Gravity, wind, rain and sun that act on a film. All vectors are in the film's own space.
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
    /// Direction of gravity: a unit vector, or zero in weightlessness, where nothing runs off.
    pub gravity: Vec3,
    /// Direction in which the wind blows. Its length is how hard the wind drags run-off along: 1 is as hard as gravity,
    /// zero is still air.
    pub wind: Vec3,
    /// Sideways spread of run-off by gusts: the standard deviation in metres after one metre, 0 or more. It adds to
    /// [`RustSettings::spread`](crate::settings::RustSettings::spread) (as variances do).
    pub gusts: f32,
    /// Direction in which rain falls. Its length is the strength of the rain, from 0 to 1. Zero is dry weather: nothing
    /// gets wet.
    pub rain: Vec3,
    /// Direction in which sunlight falls. Its length is the strength of the sunlight, from 0 to 1. Zero is shade.
    pub sun: Vec3,
}

impl Environment {
    /// Creates an environment of still air, dry weather and shade under `gravity`, a unit vector or zero.
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
}

impl Default for Environment {
    /// Returns [`Environment::still`] with gravity along -y.
    fn default() -> Self {
        Self::still(Vec3::NEG_Y)
    }
}
