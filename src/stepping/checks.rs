//! Warns of weather and clocks that are out of range.

use bevy::{
    ecs::{
        change_detection::DetectChanges,
        system::{Local, Res},
    },
    log::warn,
};

use crate::api::{clock::CoatingClock, weather::CoatingWeather};

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

/// Logs a warning when values of the clock are out of range, once until other values are.
pub(crate) fn check_clock(clock: Res<CoatingClock>, mut told: Local<Vec<&'static str>>) {
    if !clock.is_changed() {
        return;
    }
    let faults = clock.faults();
    if faults != *told && !faults.is_empty() {
        warn!("`CoatingClock` is out of range: {}", faults.join(", "));
    }
    *told = faults;
}
