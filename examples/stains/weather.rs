//! The weather on the stage. It is the same for all films, but some rows stand in the wind and some in still air: the
//! wind blows in every other frame, and a film ages only in frames with its weather.

use crate::themes::{GUSTS, RAIN, Row, WIND};
use bevy::prelude::*;
use bevy_coating::CoatingAdvance;
use bevy_coating::prelude::*;
use bevy_coating::stain::Environment;

/// On each piece: whether it stands in the wind.
#[derive(Component, Clone, Copy, PartialEq, Eq, Debug)]
pub struct InWind(pub bool);

pub struct WeatherPlugin;

impl Plugin for WeatherPlugin {
    fn build(&self, app: &mut App) {
        app.insert_resource(weather(false)).add_systems(Update, turn.after(CoatingAdvance));
    }
}

/// From where the sun shines, a unit vector: the right, and the camera.
pub fn sun_direction() -> Vec3 {
    Vec3::new(0.55, 0.62, 0.56).normalize()
}

/// Rain, sun, and the wind if it blows.
fn weather(windy: bool) -> CoatingWeather {
    let (wind, gusts) = if windy { (WIND, GUSTS) } else { (Vec3::ZERO, 0.0) };
    CoatingWeather { wind, gusts, rain: RAIN.normalize(), sun: -sun_direction() }
}

/// The weather of a row without anything that shelters it.
pub fn environment(row: &Row) -> Environment {
    let CoatingWeather { wind, gusts, rain, sun } = weather(row.windy);
    Environment { wind, gusts, rain, sun, ..Environment::default() }
}

/// Ages a film takes in for what the clock gives out, so that it does not age slower for waiting every other frame.
pub fn rate(rows: impl Iterator<Item = bool>) -> f64 {
    let (mut windy, mut still) = (false, false);
    rows.for_each(|wind| if wind { windy = true } else { still = true });
    if windy && still { 2.0 } else { 1.0 }
}

/// Sets the weather of the next frame, and who ages in it.
fn turn(mut weather: ResMut<CoatingWeather>, mut pieces: Query<(&InWind, &mut Coating)>, mut wind: Local<bool>) {
    if pieces.iter().any(|(piece, _)| piece.0 != *wind) {
        *wind = !*wind;
    }
    weather.set_if_neq(self::weather(*wind));
    for (piece, mut coating) in &mut pieces {
        let paused = piece.0 != *wind;
        if coating.paused != paused {
            coating.paused = paused;
        }
    }
}
