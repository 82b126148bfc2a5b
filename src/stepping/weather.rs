//! Warns of weather that is out of range.

use bevy::{
    ecs::{
        change_detection::DetectChanges,
        system::{Local, Res},
    },
    log::warn,
};

use crate::api::weather::CoatingWeather;

/// Logs a warning when values of the weather are out of range, once until other values are.
pub(crate) fn check_weather(weather: Res<CoatingWeather>, mut told: Local<Vec<&'static str>>) {
    if !weather.is_changed() {
        return;
    }
    let (valid, faults) = weather.checked();
    if faults != *told && !faults.is_empty() {
        warn!("`CoatingWeather` is out of range in {}: taken as {valid:?}", faults.join(", "));
    }
    *told = faults;
}
