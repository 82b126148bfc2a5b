//! Films are as fine as the grain of their settings asks for.

use bevy::prelude::*;
use bevy_coating::{film::FilmMesh, prelude::*, settings::Rules};

use crate::common::*;

/// Settings with a grain in metres, by which cracks are measured.
fn by_grain(grain: f32) -> CoatingSettings {
    let mut settings = CoatingSettings::default();
    (settings.scale.rules, settings.scale.grain) = (Rules::Grain, grain);
    settings
}

fn update(app: &mut App, frames: u32) {
    for _ in 0..frames {
        app.update();
    }
}

fn mean_edge(app: &App, film: Entity) -> f32 {
    app.world().get::<FilmMesh>(film).expect("a film").geometry.mean_edge
}

/// What was said when films became ready, of films that are too coarse for their grain: edge, grain and triangles.
fn coarse(app: &mut App) -> Vec<(f32, f32, u32)> {
    let ready = messages::<FilmReady>(app);
    let warnings = ready.into_iter().flat_map(|ready| ready.warnings);
    let told = warnings.filter_map(|warning| match warning {
        BuildWarning::CoarserThanGrain { edge, grain, triangles, .. } => Some((edge, grain, triangles)),
        _ => None,
    });
    told.collect()
}

#[test]
fn a_film_has_the_edges_that_its_settings_ask_for() {
    let mut app = app();
    let handle = app.world().resource::<Assets<CoatingSettings>>().reserve_handle();
    let coating = Coating::new(handle.clone()).with_steps_per_age(100);
    let plate = spawn_plate(&mut app, 2, coating);
    update(&mut app, 10);
    assert_eq!(app.world().resource::<CoatingStatus>().waiting, 1, "the grain is waited for");
    let insert = |app: &mut App, grain: f32| {
        let mut assets = app.world_mut().resource_mut::<Assets<CoatingSettings>>();
        assets.insert(&handle, by_grain(grain)).expect("a reserved handle");
    };
    insert(&mut app, 0.06);
    wait_for_films(&mut app, 1);
    let edge = mean_edge(&app, plate);
    assert!((0.038..0.046).contains(&edge), "{edge}");
    assert_eq!(coarse(&mut app), []);
    // Another grain changes the rules, not the triangles.
    insert(&mut app, 0.2);
    update(&mut app, 5);
    assert_eq!(mean_edge(&app, plate), edge);
    assert_eq!(app.world().get::<bevy_coating::FilmPace>(plate).expect("a film").settings.scale.grain, 0.2);
    assert!(messages::<FilmReady>(&mut app).is_empty());
}

#[test]
fn a_film_that_must_be_coarser_than_its_grain_says_so_once() {
    let mut app = app();
    let resolution = FilmResolution::Grain { share: 0.7, max_triangles: 300 };
    let coating = Coating::new(by_grain(0.05)).with_resolution(resolution).with_steps_per_age(100);
    let plate = spawn_plate(&mut app, 2, coating);
    wait_for_films(&mut app, 1);
    let [(edge, grain, triangles)] = coarse(&mut app)[..] else { panic!("one warning") };
    assert!((0.08..0.1).contains(&edge) && grain == 0.05, "{edge} {grain}");
    // A square metre in edges of 0.035 m.
    assert!((1700..2100).contains(&triangles), "{triangles}");
    take_steps(&mut app, 5);
    assert_eq!(coarse(&mut app), []);
    // The way out.
    let resolution = FilmResolution::Grain { share: 0.7, max_triangles: triangles };
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").resolution = resolution;
    update_until(&mut app, |app| mean_edge(app, plate) < 0.04);
    assert_eq!(coarse(&mut app), []);
}

#[test]
fn a_film_that_was_asked_for_by_its_edges_follows_the_grain_afterwards() {
    let mut app = app();
    let coating = Coating::new(by_grain(0.06)).with_resolution(FilmResolution::EdgeLength(0.2)).with_steps_per_age(100);
    let plate = spawn_plate(&mut app, 2, coating);
    wait_for_films(&mut app, 1);
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").resolution = FilmResolution::default();
    update_until(&mut app, |app| (0.038..0.046).contains(&mean_edge(app, plate)));
}

#[test]
fn a_share_out_of_range_is_refused_and_mended() {
    let mut app = app();
    let resolution = FilmResolution::Grain { share: f32::NAN, max_triangles: 300 };
    let plate = spawn_plate(&mut app, 2, Coating::new(by_grain(0.2)).with_resolution(resolution));
    let mut told = 0;
    update_until(&mut app, |app| {
        told += messages::<FilmFailed>(app).len();
        app.world().resource::<CoatingStatus>().refused == 1
    });
    for _ in 0..10 {
        app.update();
        told += messages::<FilmFailed>(&mut app).len();
    }
    assert_eq!(told, 1, "told once");
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").resolution = FilmResolution::default();
    wait_for_films(&mut app, 1);
}
