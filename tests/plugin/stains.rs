//! Stains in an app are those of the simulation; wind, gravity, rain and sun turn with the prop.

use std::time::Duration;

use bevy::{prelude::*, time::TimeUpdateStrategy};
use bevy_coating::{
    FilmPace,
    prelude::*,
    sim::FilmState,
    stain::{Environment, Exposure},
};

use crate::{common::*, sky::*};

fn environment(app: &App, film: Entity) -> Environment {
    app.world().get::<FilmPace>(film).expect("a film").environment
}

fn settings_of(coating: &Coating) -> CoatingSettings {
    match &coating.settings {
        SettingsSource::Inline(settings) => settings.clone(),
        SettingsSource::Asset(_) => panic!("inline settings"),
    }
}

#[test]
fn stains_in_an_app_are_those_of_the_simulation_to_the_bit() {
    let weather = CoatingWeather {
        wind: Vec3::new(0.4, 0.0, 0.0),
        gusts: 0.1,
        rain: Vec3::new(0.2, -0.7, -0.4),
        sun: Vec3::new(-0.3, -0.5, -0.2),
    };
    let coating = wet_coating();
    let mut app = app();
    let film = spawn_plate(&mut app, 16, coating.clone());
    wait_for_films(&mut app, 1);
    let mut expected = film_state(&app, film);
    app.insert_resource(weather);
    take_steps_held(&mut app, 60);
    take_steps_held(&mut app, 40);
    let environment = Environment {
        gravity: Vec3::NEG_Y,
        wind: weather.wind,
        gusts: weather.gusts,
        rain: weather.rain,
        sun: weather.sun,
    };
    expected.age_to(1.0, &settings_of(&coating), &environment);
    let aged = film_state(&app, film);
    assert_eq!(aged.clock.steps, 100);
    assert_eq!(aged.stains, expected.stains);
    assert_eq!(aged.digest(), expected.digest());
    let m = aged.measure();
    assert!(m.sources > 0 && m.rust_stained > 0.0 && m.dust_mean > Some(0.01) && m.moisture_mean > Some(0.01), "{m:?}");
}

#[test]
fn the_start_age_is_reached_under_the_same_sky() {
    let coating = wet_coating();
    let mut app = app();
    let rain = CoatingWeather { rain: Vec3::new(0.0, -0.8, -0.6), ..RAIN };
    app.insert_resource(rain);
    spawn_roof(&mut app);
    let stood = spawn_lying(&mut app, 14, coating.clone());
    let appeared = spawn_lying(&mut app, 14, coating.clone().with_start_age(0.5).with_past_weather(rain));
    wait_for_films(&mut app, 2);
    let fresh = exposure(&app, stood).clone();
    assert!(fresh.rain.contains(&0.0) && fresh.rain.contains(&1.0), "cast before the film appears");
    let aged = film_state(&app, appeared);
    assert_eq!(aged.clock.steps, 50);
    take_steps_held(&mut app, 50);
    assert_eq!(film_state(&app, stood).digest(), aged.digest());
}

#[test]
fn wind_rain_and_sun_turn_with_the_prop() {
    let mut app = app();
    let film = spawn_plate(&mut app, 6, quick_coating());
    wait_for_films(&mut app, 1);
    let weather = CoatingWeather { wind: Vec3::X * 2.0, gusts: 0.3, rain: Vec3::NEG_Y * 0.5, sun: Vec3::NEG_Z };
    app.insert_resource(weather);
    app.update();
    let upright = environment(&app, film);
    assert_eq!((upright.wind, upright.gusts), (weather.wind, weather.gusts));
    assert_eq!((upright.rain, upright.sun, upright.gravity), (weather.rain, weather.sun, Vec3::NEG_Y));
    // A quarter turn to the left, twice as large: what came from above comes from the prop's right.
    let turn =
        Transform::from_rotation(Quat::from_rotation_z(std::f32::consts::FRAC_PI_2)).with_scale(Vec3::splat(2.0));
    *app.world_mut().get_mut::<Transform>(film).expect("a prop") = turn;
    app.update();
    app.update();
    let turned = environment(&app, film);
    let near = |a: Vec3, b: Vec3| a.distance(b) < 1e-6;
    assert!(near(turned.gravity, Vec3::NEG_X) && near(turned.rain, Vec3::NEG_X * 0.5), "{turned:?}");
    assert!(near(turned.wind, Vec3::NEG_Y * 2.0) && near(turned.sun, Vec3::NEG_Z), "{turned:?}");
    assert_eq!(turned.gusts, 0.3);
}

#[test]
fn still_and_dry_weather_is_no_weather() {
    let digest = |change: fn(&mut App)| {
        let mut app = app();
        change(&mut app);
        let film = spawn_plate(&mut app, 12, wet_coating());
        spawn_roof(&mut app);
        wait_for_films(&mut app, 1);
        take_steps(&mut app, 80);
        assert_eq!(*exposure(&app, film), Exposure::default(), "nothing is cast");
        film_state(&app, film).digest()
    };
    let expected = digest(|_| {});
    let explicit = digest(|app| {
        app.insert_resource(CoatingWeather::default());
    });
    assert_eq!(explicit, expected);
    let strong = digest(|app| {
        app.insert_resource(CoatingGravity(Vec3::NEG_Y * 9.81));
    });
    assert_eq!(strong, expected, "gravity need not be of unit length");
}

#[test]
fn weather_that_is_no_number_does_no_harm() {
    let mut app = app();
    let broken = Vec3::new(f32::NAN, -1.0, 0.0);
    app.insert_resource(CoatingWeather { wind: broken, gusts: f32::NAN, rain: broken, sun: Vec3::INFINITY });
    let film = spawn_plate(&mut app, 10, wet_coating());
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 80);
    let expected = {
        let mut app = crate::common::app();
        let film = spawn_plate(&mut app, 10, wet_coating());
        wait_for_films(&mut app, 1);
        take_steps(&mut app, 80);
        film_state(&app, film).digest()
    };
    assert_eq!(film_state(&app, film).digest(), expected);
    app.insert_resource(CoatingWeather { rain: Vec3::NEG_Z * 50.0, ..CoatingWeather::default() });
    take_steps_held(&mut app, 10);
    assert_eq!(environment(&app, film).rain, Vec3::NEG_Z, "more than all rain is all rain");
}

#[test]
fn frames_do_not_change_a_film_in_the_rain() {
    let digest_at = |frame: Duration| {
        let mut app = app();
        spawn_roof(&mut app);
        let film = spawn_lying(&mut app, 12, wet_coating());
        wait_for_films(&mut app, 1);
        app.insert_resource(TimeUpdateStrategy::ManualDuration(frame));
        let until = |app: &mut App, age: f64| {
            let mut clock = app.world_mut().resource_mut::<CoatingClock>();
            (clock.paused, clock.age_per_second, clock.target_age) = (false, 0.37, Some(age));
            update_until(app, |app| app.world().resource::<CoatingStatus>().youngest >= age);
            app.update();
        };
        until(&mut app, 0.2);
        app.insert_resource(RAIN);
        until(&mut app, 0.6);
        app.insert_resource(CoatingWeather { rain: Vec3::new(0.6, -0.8, 0.0), sun: Vec3::NEG_Y, ..RAIN });
        until(&mut app, 0.8);
        let film: FilmState = film_state(&app, film);
        assert_eq!(film.clock.steps, 80, "the target holds");
        film.digest()
    };
    let expected = digest_at(Duration::from_millis(16));
    for milliseconds in [7, 333] {
        assert_eq!(digest_at(Duration::from_millis(milliseconds)), expected, "frames of {milliseconds} ms");
    }
}

/// Ages four plates in the rain under a roof on as many threads as the environment says, and prints their digests.
#[test]
fn digests_for_other_processes() {
    let Some(mut app) = app_of_other_process() else { return };
    spawn_roof(&mut app);
    let plates: Vec<Entity> = (0..4).map(|seed| spawn_lying(&mut app, 9, quick_coating().with_seed(seed))).collect();
    wait_for_films(&mut app, 4);
    take_steps(&mut app, 20);
    app.insert_resource(CoatingWeather { sun: Vec3::new(0.5, -0.5, 0.0), ..RAIN });
    take_steps_held(&mut app, 50);
    for plate in plates {
        assert!(exposure(&app, plate).rain.contains(&0.0));
        println!("digest {}", film_state(&app, plate).digest());
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    assert_same_on_any_number_of_threads("stains::digests_for_other_processes");
}
