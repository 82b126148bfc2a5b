//! Rain, shelter, drying, and the effects of moisture.

use super::*;

fn rain(x: f32, y: f32, z: f32) -> Environment {
    Environment { rain: Vec3::new(x, y, z), ..Environment::default() }
}

fn aged(settings: &CoatingSettings, environment: &Environment, age: f64) -> FilmState {
    let mut film = plate(600, settings, 100);
    film.age_to(age, settings, environment);
    film.validate().unwrap();
    film
}

#[test]
fn surfaces_that_face_the_rain_get_wet_and_others_stay_dry() {
    let settings = held();
    let moisture = |environment: &Environment| aged(&settings, environment, 0.5).measure().moisture_mean.unwrap();
    assert!(moisture(&rain(0.0, 0.0, -1.0)) > 0.7);
    assert_eq!(moisture(&rain(0.0, 0.0, 1.0)), 0.0, "from behind");
    assert_eq!(moisture(&rain(0.0, -1.0, 0.0)), 0.0, "along it");
    assert!(moisture(&rain(0.0, 0.0, -0.3)) < moisture(&rain(0.0, 0.0, -1.0)), "less rain");
    let sunny = Environment { sun: Vec3::NEG_Z, ..rain(0.0, 0.0, -1.0) };
    assert!(moisture(&sunny) < moisture(&rain(0.0, 0.0, -1.0)), "and sun");
}

#[test]
fn sheltered_film_stays_dry() {
    let settings = held();
    let mut film = plate(600, &settings, 100);
    let rest = film.mesh.geometry.rest_positions.clone();
    film.stains.exposure.rain = rest.iter().map(|p| if p.x > 0.0 { 1.0 } else { 0.0 }).collect();
    film.age_to(0.5, &settings, &rain(0.0, 0.0, -1.0));
    for (p, &moisture) in rest.iter().zip(&film.stains.film.moisture) {
        assert_eq!(p.x > 0.0, moisture > 0.5, "{p} {moisture}");
    }
}

#[test]
fn it_dries_after_the_rain_and_then_nothing_is_left_to_do() {
    let settings = held();
    let mut film = aged(&settings, &rain(0.0, 0.0, -1.0), 0.3);
    assert!(film.stains.is_damp());
    film.age_to(0.4, &settings, &Environment::default());
    let wet = film.measure().moisture_mean.unwrap();
    assert!(wet > 0.0 && wet < 0.3, "{wet}");
    film.age_to(1.5, &settings, &Environment::default());
    assert!(!film.stains.is_damp());
    assert!(film.stains.film.moisture.iter().chain(&film.stains.metal.moisture).all(|&m| m == 0.0));
}

#[test]
fn without_rain_moisture_changes_no_bit() {
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.deform.sweeps_per_age = 500.0;
    let run = |settings: &CoatingSettings| {
        let mut film = plate(600, settings, 100);
        film.age_to(1.0, settings, &Environment::default());
        (film.digest(), film.stains)
    };
    let reference = run(&settings);
    settings.moisture.wetting = 500.0;
    settings.moisture.adhesion = 9.0;
    settings.moisture.emission = 9.0;
    settings.moisture.travel = 9.0;
    settings.moisture.wash_dust = 90.0;
    settings.moisture.wash_rust = 9.0;
    assert_eq!(run(&settings), reference);
}

#[test]
fn every_effect_can_be_switched_off() {
    let mut dry = CoatingSettings::from(Preset::Paper);
    dry.deform.sweeps_per_age = 500.0;
    (dry.moisture.adhesion, dry.moisture.emission, dry.moisture.travel) = (0.0, 0.0, 0.0);
    (dry.moisture.wash_dust, dry.moisture.wash_rust) = (0.0, 0.0);
    let run = |settings: &CoatingSettings, environment: &Environment| {
        let mut film = plate(1000, settings, 100);
        film.age_to(1.0, settings, environment);
        film.validate().unwrap();
        let m = film.measure();
        (m, film.stains)
    };
    let wet = rain(0.0, 0.0, -1.0);
    let (reference, stains) = run(&dry, &Environment::default());
    let (off, off_stains) = run(&dry, &wet);
    assert!(off.moisture_mean > Some(0.3));
    assert_eq!((off_stains.film.stained, off_stains.film.dust), (stains.film.stained, stains.film.dust));
    assert_eq!(off.separated, reference.separated);
    let on = |set: fn(&mut CoatingSettings)| {
        let mut settings = dry.clone();
        set(&mut settings);
        run(&settings, &wet).0
    };
    assert!(on(|s| s.moisture.adhesion = 1.0).separated > off.separated);
    assert!(on(|s| s.moisture.emission = 1.0).rust_emitted > 1.2 * off.rust_emitted);
    assert!(on(|s| s.moisture.travel = 2.0).rust_dripped > 1.1 * off.rust_dripped);
    assert!(on(|s| s.moisture.wash_dust = 4.0).dust_mean < off.dust_mean.map(|d| 0.9 * d));
    assert!(on(|s| s.moisture.wash_rust = 4.0).rust_stained < 0.9 * off.rust_stained);
}

#[test]
fn moisture_does_not_depend_on_the_number_of_steps() {
    let mut settings = held();
    settings.moisture.wash_rust = 1.0;
    let run = |steps| {
        let mut film = plate(1000, &settings, steps);
        crack(&mut film, Vec3::new(-0.1, 0.35, 0.0), Vec3::new(0.0, 0.2, 0.0));
        film.age_to(0.6, &settings, &rain(0.3, -0.4, -0.6));
        film.age_to(0.65, &settings, &Environment::default());
        let m = film.measure();
        [m.moisture_mean.unwrap(), m.dust_mean.unwrap(), m.rust_stained, m.rust_emitted]
    };
    let reference = run(1000);
    for steps in [250, 4000] {
        for (a, b) in run(steps).into_iter().zip(reference) {
            assert!((a / b - 1.0).abs() < 0.03, "{steps} steps: {a} for {b}");
        }
    }
}
