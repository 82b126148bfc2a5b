//! Defines [`CoatingWeather`], the weather of all films, and [`PropWeather`], that of one prop.

use bevy::{
    ecs::{
        component::Component,
        reflect::{ReflectComponent, ReflectResource},
        resource::Resource,
    },
    math::Vec3,
    reflect::prelude::*,
    transform::components::GlobalTransform,
};

use super::clock::CoatingGravity;
use crate::stain::Environment;

/// Greatest pull of the [wind](CoatingWeather::wind), in gravities.
const MAX_WIND: f32 = 100.0;
/// Greatest spread by [gusts](CoatingWeather::gusts), in metres after one metre.
const MAX_GUSTS: f32 = 100.0;

/// Wind, rain and sun in the world. By default the air is still, and there is neither rain nor sun.
///
/// All directions are in world space and are transformed into each film's space, so weather acts correctly on a prop
/// that turns. Values that are out of range are clamped, and values that are NaN or infinite count as zero; a warning
/// says so.
///
/// Meshes around a prop can shelter it from rain and sun: see [`RainShelter`](super::shelter::RainShelter) and
/// [`Shelter`](super::shelter::Shelter).
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn begin_storm(mut weather: ResMut<CoatingWeather>) {
///     *weather = CoatingWeather {
///         wind: Vec3::X * 0.8,
///         gusts: 0.1,
///         rain: Vec3::new(0.6, -0.8, 0.0),
///         ..CoatingWeather::default()
///     };
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Startup, begin_storm);
/// app.update();
/// ```
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingWeather {
    /// Direction in which the wind blows. Its length is the strength with which wind pulls at run-off: 1 pulls as hard
    /// as gravity. Length 0 to 100, default zero (still air).
    pub wind: Vec3,
    /// Spread of run-off to the sides by gusts: the standard deviation, in metres, after one metre. 0 to 100, default
    /// 0.
    pub gusts: f32,
    /// Direction in which rain falls. Its length is the strength of the rain: 0 to 1, default zero (dry weather).
    pub rain: Vec3,
    /// Direction in which sunlight falls. Its length is the strength of the sun: 0 to 1, default zero (shade).
    pub sun: Vec3,
}

/// Weather of one prop, beside its [`Coating`](super::coating::Coating), instead of the world's [`CoatingWeather`]: for
/// a cellar, a ship's hull, a rain machine.
///
/// It may be changed at any time, and removed. It holds for all films of the coating, for time that is
/// [skipped](super::clock::CoatingClock::skip), and since the prop was
/// [painted](super::coating::Coating::painted): the calendar tells the world's weather only. Ranges, and what becomes
/// of values out of range, are those of [`CoatingWeather`]. Sheltering meshes keep rain and sun off as they do
/// elsewhere.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// /// It rains everywhere, but not in the cellar.
/// fn spawn_boiler(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut weather: ResMut<CoatingWeather>) {
///     weather.rain = Vec3::NEG_Y;
///     let boiler = meshes.add(Cylinder::new(0.4, 1.2));
///     commands.spawn((Mesh3d(boiler), Coating::default(), PropWeather(CoatingWeather::default())));
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Startup, spawn_boiler);
/// app.update();
/// ```
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct PropWeather(pub CoatingWeather);

impl CoatingWeather {
    /// Returns the weather with every value clamped to its range, and the names of the values that were out of range.
    pub(crate) fn checked(&self) -> (Self, Vec<&'static str>) {
        let mut faults = Vec::new();
        let mut vector = |name, value, most| {
            let valid = within(value, most);
            if valid != value {
                faults.push(name);
            }
            valid
        };
        let wind = vector("wind", self.wind, MAX_WIND);
        let rain = vector("rain", self.rain, 1.0);
        let sun = vector("sun", self.sun, 1.0);
        let gusts = if self.gusts.is_finite() { self.gusts.clamp(0.0, MAX_GUSTS) } else { 0.0 };
        if gusts != self.gusts {
            faults.push("gusts");
        }
        (Self { wind, gusts, rain, sun }, faults)
    }

    /// Returns whether there is rain or sun.
    pub(crate) fn reaches_anything(&self) -> bool {
        let (weather, _) = self.checked();
        weather.rain != Vec3::ZERO || weather.sun != Vec3::ZERO
    }

    /// Returns gravity and weather in the space of a film at `transform`. That space has the world scale applied, so
    /// only the rotation counts.
    pub(crate) fn environment(&self, gravity: CoatingGravity, transform: &GlobalTransform) -> Environment {
        let (weather, _) = self.checked();
        let turn = transform.rotation().inverse();
        // The rotation of a prop that is scaled to zero is NaN.
        let turned = |v: Vec3| Some(turn * v).filter(|v| v.is_finite()).unwrap_or(Vec3::ZERO);
        Environment {
            gravity: (turn * gravity.0).normalize_or_zero(),
            wind: turned(weather.wind),
            gusts: weather.gusts,
            rain: turned(weather.rain),
            sun: turned(weather.sun),
        }
    }
}

/// Returns `v` shortened to the length `most`, or zero if it is not finite.
fn within(v: Vec3, most: f32) -> Vec3 {
    if !v.is_finite() {
        return Vec3::ZERO;
    }
    // A normalised vector may be longer than 1 by a rounding error.
    if v.length() <= most * (1.0 + 1e-5) { v } else { v.normalize_or_zero() * most }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weather_out_of_range_is_brought_into_it() {
        let (valid, faults) = CoatingWeather {
            wind: Vec3::new(f32::NAN, 0.0, 0.0),
            gusts: -1.0,
            rain: Vec3::new(0.0, -3.0, 0.0),
            sun: Vec3::new(0.0, f32::NEG_INFINITY, 1.0),
        }
        .checked();
        assert_eq!(valid, CoatingWeather { rain: Vec3::NEG_Y, ..CoatingWeather::default() });
        assert_eq!(faults, ["wind", "rain", "sun", "gusts"]);
        // Too long to be measured, and a gale.
        let (valid, faults) = CoatingWeather { wind: Vec3::MAX, rain: Vec3::X * 400.0, ..valid }.checked();
        assert!(valid.wind.length() <= MAX_WIND && valid.rain == Vec3::X, "{valid:?}");
        assert_eq!(faults, ["wind", "rain"]);
    }

    #[test]
    fn weather_in_range_is_left_alone() {
        let direction = Vec3::new(1.0, -2.0, 0.5).normalize();
        let weather = CoatingWeather { wind: direction * 3.0, gusts: 0.2, rain: direction, sun: direction * 0.5 };
        assert_eq!(weather.checked(), (weather, Vec::new()));
        assert_eq!(CoatingWeather::default().checked().1, Vec::<&str>::new());
    }

    #[test]
    fn a_prop_without_a_rotation_feels_no_weather() {
        let weather =
            CoatingWeather { wind: Vec3::X, rain: Vec3::NEG_Y, sun: Vec3::NEG_Y, ..CoatingWeather::default() };
        let flat = GlobalTransform::from_scale(Vec3::ZERO);
        let environment = weather.environment(CoatingGravity::default(), &flat);
        for v in [environment.gravity, environment.wind, environment.rain, environment.sun] {
            assert!(v.is_finite(), "{environment:?}");
        }
    }
}
