//! Films age in an app as they do without one.

mod common;

use bevy::prelude::*;
use bevy_coating::{
    film::build::{Surface, build},
    prelude::*,
    sim::FilmState,
};
use common::*;

/// The plate's film and settings, without an app.
fn reference(n: u32, coating: &Coating) -> (FilmState, CoatingSettings) {
    let mesh = plate(n);
    let positions = mesh.attribute(Mesh::ATTRIBUTE_POSITION).and_then(|p| p.as_float3()).expect("positions");
    let indices: Vec<u32> = mesh.indices().expect("indices").iter().map(|i| i as u32).collect();
    let surface = Surface {
        positions: positions.iter().map(|&p| Vec3::from_array(p)).collect(),
        triangles: indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
        ..Surface::default()
    };
    let SettingsSource::Inline(settings) = coating.settings.clone() else { panic!("inline settings") };
    let built = build(&surface, coating.resolution, coating.seed).expect("a film");
    let film = FilmState::new(&built, &settings, coating.seed, coating.steps_per_age).expect("a manifold");
    (film, settings)
}

#[test]
fn a_plate_ages_in_an_app_to_the_bits_of_the_simulation() {
    let coating = quick_coating().with_seed(7);
    let (mut expected, settings) = reference(20, &coating);
    let mut app = app();
    let plate = spawn_plate(&mut app, 20, coating);
    wait_for_films(&mut app, 1);
    assert_eq!(film_state(&app, plate).digest(), expected.digest(), "fresh");
    take_steps(&mut app, 60);
    take_steps(&mut app, 40);
    expected.age_to(1.0, &settings, Vec3::NEG_Y);
    let aged = film_state(&app, plate);
    assert_eq!(aged.clock.steps, 100);
    assert_eq!(aged.digest(), expected.digest());
    let measures = aged.measure();
    assert!(measures.separated > Some(0.3) && measures.torn > Some(0.05), "{measures:?}");
    assert_eq!(aged.validate(), Ok(()));
}
