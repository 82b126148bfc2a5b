//! What works on a film from outside: gravity, wind, rain and sun.

use bevy_math::Vec3;

/// What works on a film from outside, in the film's own space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Environment {
    /// Direction of gravity: a unit vector, or zero in weightlessness, where nothing runs off.
    pub gravity: Vec3,
    /// Direction in which the wind blows, as long as it pulls at run-off: 1 pulls as hard as gravity. Zero: still air.
    pub wind: Vec3,
    /// How far gusts spread run-off sideways: the standard deviation in metres after one metre, on top of
    /// [`RustSettings::spread`](crate::settings::RustSettings::spread). 0 or more.
    pub gusts: f32,
    /// Direction in which rain falls, as long as there is rain: 0 to 1. Zero: dry weather, and no moisture at all.
    pub rain: Vec3,
    /// Direction in which sunlight falls, as long as it is strong: 0 to 1. Zero: shade.
    pub sun: Vec3,
}

impl Environment {
    /// Still air and dry weather under `gravity`, a unit vector or zero.
    pub fn still(gravity: Vec3) -> Self {
        Self { gravity, wind: Vec3::ZERO, gusts: 0.0, rain: Vec3::ZERO, sun: Vec3::ZERO }
    }
}

impl Default for Environment {
    /// [Still](Self::still), with gravity along -y.
    fn default() -> Self {
        Self::still(Vec3::NEG_Y)
    }
}
