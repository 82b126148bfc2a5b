//! Warns of weather and clocks that are out of range.

use bevy::{
    ecs::{
        change_detection::{DetectChanges, Ref},
        entity::Entity,
        system::{Local, Query, Res},
    },
    log::warn,
};

use crate::api::{
    clock::CoatingClock,
    weather::{CoatingWeather, PropWeather},
};

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

/// Logs a warning when values of a prop's own weather are out of range, once until other values are.
pub(crate) fn check_weather_of_props(
    props: Query<(Entity, Ref<PropWeather>)>,
    mut told: Local<Vec<(Entity, Vec<&'static str>)>>,
) {
    for (prop, weather) in &props {
        if !weather.is_changed() {
            continue;
        }
        let (valid, faults) = weather.0.checked();
        let is_news = !faults.is_empty() && told.iter().all(|(of, before)| *of != prop || *before != faults);
        if is_news {
            warn!("`PropWeather` of entity {prop} is out of range in {}: taken as {valid:?}", faults.join(", "));
        }
        told.retain(|(of, _)| *of != prop);
        if !faults.is_empty() {
            told.push((prop, faults));
        }
    }
    told.retain(|(of, _)| props.contains(*of));
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
