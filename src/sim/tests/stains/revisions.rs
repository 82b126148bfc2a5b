//! Stains count as changed only where a change can be seen.

use super::*;
use crate::sim::FilmClock;

/// Returns how often stains counted as changed in the next 100 ticks.
fn revisions(film: &mut FilmState, settings: &CoatingSettings, environment: &Environment) -> u32 {
    let before = film.stains.revision;
    film.age_to(film.clock.age() + 1.0, settings, environment);
    film.stains.revision - before
}

#[test]
fn saturated_stains_come_to_rest_and_fresh_ones_do_not() {
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.deform.sweeps_per_age = 200.0;
    let dry = Environment::default();
    let mut film = plate(500, &settings, 100);
    assert!(revisions(&mut film, &settings, &dry) > 50, "a fresh film gathers dust");
    film.age_to(20.0, &settings, &dry);
    // Run-off goes on: a few places more look different.
    assert!(revisions(&mut film, &settings, &dry) <= 10);
    // Dust creeps into cracks for many ages: here it may hurry.
    (settings.rust.emission, settings.rust.corrosion, settings.dust.rate) = (0.0, 100.0, 100.0);
    film.age_to(40.0, &settings, &dry);
    assert_eq!(revisions(&mut film, &settings, &dry), 0, "everything is saturated");

    // Rain makes it look wet: some changes, then none while it is as wet as it gets.
    settings.moisture.wash_dust = 0.0;
    let rain = Environment { rain: Vec3::new(0.0, -0.6, -0.8), ..dry };
    assert!(revisions(&mut film, &settings, &rain) > 0);
    assert_eq!(revisions(&mut film, &settings, &rain), 0, "it does not get any wetter");
}

#[test]
fn what_creeps_is_seen_in_the_end_and_what_trembles_is_not() {
    let settings = held();
    let mut film = plate(200, &settings, 100);
    film.age_to(0.02, &settings, &Environment::default());
    let mesh = film.mesh.clone();
    let still = crate::settings::DustSettings { rate: 1e-4, ..Default::default() };
    let mut settle = |dt: f32| {
        let before = film.stains.revision;
        crate::stain::settle_dust(&mesh, &mut film.stains, &still, &Environment::default(), dt);
        film.stains.revision != before
    };
    settle(0.0);
    let steps = (1..=1000).find(|_| settle(1.0));
    // A change of 1/255 at a rate of at most 1e-4.
    assert!(steps.is_some_and(|steps| (30..200).contains(&steps)), "{steps:?}");
    assert!(!settle(1.0), "the next is far off again");
    assert_eq!(film.clock, FilmClock { steps: 2, ..FilmClock::new(100) });
}
