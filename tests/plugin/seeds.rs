//! Seeds of places and paths, shares of triangles, places far away, and the past.

use bevy::prelude::*;
use bevy_coating::{CoatedBy, film::FilmMesh, prelude::*, stain::StainFields};

use crate::common::*;

fn digests(app: &mut App) -> Vec<String> {
    let films: Vec<Entity> = app.world_mut().query_filtered::<Entity, With<FilmMesh>>().iter(app.world()).collect();
    let mut digests: Vec<String> = films.into_iter().map(|film| film_state(app, film).digest()).collect();
    digests.sort();
    digests
}

fn distinct(mut digests: Vec<String>) -> usize {
    digests.dedup();
    digests.len()
}

/// Spawns a car: a root with four wheels.
fn spawn_car(app: &mut App, coating: Coating, place: Vec3) -> Entity {
    let wheel = add_mesh(app, plate(5));
    let car = app.world_mut().spawn((Transform::from_translation(place), coating)).id();
    for i in 0..4 {
        let place = Transform::from_xyz(i as f32, 0.0, 0.0);
        app.world_mut().spawn((Mesh3d(wheel.clone()), Name::new("wheel"), place, ChildOf(car)));
    }
    car
}

#[test]
fn no_two_props_are_twins_unless_they_are_meant_to_be() {
    let mut app = app();
    for i in 0..10 {
        let plate = spawn_plate(&mut app, 5, quick_coating());
        app.world_mut().entity_mut(plate).insert(Transform::from_xyz(i as f32 * 0.5, 0.0, 0.0));
    }
    spawn_car(&mut app, quick_coating(), Vec3::Y * 3.0);
    wait_for_films(&mut app, 14);
    assert_eq!(distinct(digests(&mut app)), 14);

    let mut app = self::app();
    for i in 0..2 {
        spawn_car(&mut app, quick_coating().with_seed(7), Vec3::Z * i as f32 * 10.0);
    }
    wait_for_films(&mut app, 8);
    assert_eq!(distinct(digests(&mut app)), 4, "two cars of one seed are twins, but not their wheels");
}

#[test]
fn a_level_looks_the_same_each_time() {
    let level = |late: Vec3| {
        let mut app = app();
        let car = spawn_car(&mut app, quick_coating(), Vec3::new(12.0, 0.0, -7.5));
        wait_for_films(&mut app, 4);
        let seed = *app.world().get::<CoatingSeed>(car).expect("a seed");
        // The seed stays when the prop moves and is built again.
        app.world_mut().get_mut::<Transform>(car).expect("a place").translation = late;
        app.update();
        app.world_mut().get_mut::<Coating>(car).expect("a coating").start_age = 0.3;
        messages::<FilmReady>(&mut app);
        let mut ready = 0;
        update_until(&mut app, |app| {
            ready += messages::<FilmReady>(app).len();
            ready >= 4
        });
        (seed, digests(&mut app))
    };
    assert_eq!(level(Vec3::ZERO), level(Vec3::ONE * 40.0));
}

#[test]
fn the_films_of_one_coating_share_its_triangles() {
    let mut app = app();
    let wall = add_mesh(&mut app, plate(10));
    let bolt = add_mesh(&mut app, plate(10).scaled_by(Vec3::splat(0.2)));
    let root = app.world_mut().spawn((Transform::default(), quick_coating().with_triangles(2000))).id();
    let spawn = |app: &mut App, mesh: &Handle<Mesh>, x: f32| {
        let place = Transform::from_xyz(x, 0.0, 0.0);
        app.world_mut().spawn((Mesh3d(mesh.clone()), place, ChildOf(root))).id()
    };
    let wall = spawn(&mut app, &wall, 0.5);
    let bolts: Vec<Entity> = (0..25).map(|i| spawn(&mut app, &bolt, i as f32)).collect();
    wait_for_films(&mut app, 26);
    let faces = |app: &App, film| app.world().get::<FilmMesh>(film).expect("a film").topology.face_count();
    let (large, small) = (faces(&app, wall), bolts.iter().map(|&bolt| faces(&app, bolt)).sum::<usize>());
    assert!((800..1200).contains(&large), "half of the area has {large} of 2,000 triangles");
    assert!((700..1400).contains(&small), "the other half has {small} of 2,000 triangles");
    // Whoever comes later gets a share too.
    let late = spawn(&mut app, &bolt, 40.0);
    wait_for_films(&mut app, 27);
    assert!(faces(&app, late) < 100, "{}", faces(&app, late));
}

#[test]
fn a_prop_modelled_far_from_its_origin_ages_like_one_at_home() {
    // Steps of single precision at this distance are exact for the plate's coordinates, so both are the same shape.
    let far = Vec3::new(1024.0, -512.0, 2048.0);
    let snapped = |offset: Vec3| {
        let mut mesh = plate(8);
        let Some(bevy::mesh::VertexAttributeValues::Float32x3(positions)) =
            mesh.attribute_mut(Mesh::ATTRIBUTE_POSITION)
        else {
            panic!("positions")
        };
        for position in positions {
            *position = position.map(|x| (x * 1024.0).round() / 1024.0);
            *position = (Vec3::from_array(*position) + offset).to_array();
        }
        mesh
    };
    let mut app = app();
    let coating = quick_coating().with_seed(3);
    let [near, away] = [Vec3::ZERO, far].map(|offset| {
        let mesh = add_mesh(&mut app, snapped(offset));
        app.world_mut().spawn((Mesh3d(mesh), coating.clone())).id()
    });
    wait_for_films(&mut app, 2);
    take_steps(&mut app, 100);
    app.update();
    let [near_film, far_film] = [near, away].map(|film| film_state(&app, film));
    assert_eq!(far_film.measure().separated, near_film.measure().separated);
    assert_eq!(far_film.forces.torn_edges, near_film.forces.torn_edges);
    let moved = |film: &bevy_coating::sim::FilmState| -> f64 {
        let geometry = &film.mesh.geometry;
        let lifts = geometry.positions.iter().zip(&geometry.rest_positions).map(|(p, r)| f64::from(p.distance(*r)));
        lifts.sum()
    };
    let (a, b) = (moved(&near_film), moved(&far_film));
    assert!((a - b).abs() < 1e-3 * a, "{a} and {b}");
    // It is drawn where the prop is.
    let handle = &app.world().get::<Mesh3d>(away).expect("a mesh").0;
    let mesh = app.world().resource::<Assets<Mesh>>().get(handle).expect("an asset");
    let positions = mesh.attribute(Mesh::ATTRIBUTE_POSITION).and_then(|p| p.as_float3()).expect("positions");
    let off =
        positions.iter().map(|&p| Vec3::from_array(p).distance(far + Vec3::new(0.5, 0.5, 0.0))).fold(0.0, f32::max);
    assert!(off < 1.5, "{off} m from its place");
    // Pieces fall from where it is.
    let fallen = messages::<PieceFallen>(&mut app);
    assert!(fallen.iter().filter(|piece| piece.entity == away).all(|piece| piece.position.distance(far) < 3.0));
    assert!(messages::<FirstCrack>(&mut app).is_empty() || fallen.is_empty() || near_film.forces.torn_edges > 0);
}

#[test]
fn the_past_has_weather_of_its_own() {
    let storm = CoatingWeather { rain: Vec3::new(0.0, -0.6, -0.8), wind: Vec3::X, ..CoatingWeather::default() };
    let aged = |today: CoatingWeather, past: Option<CoatingWeather>| {
        let mut app = app();
        app.insert_resource(today);
        let coating = Coating { past_weather: past, ..quick_coating().with_seed(5).with_start_age(0.8) };
        let plate = spawn_plate(&mut app, 8, coating);
        wait_for_films(&mut app, 1);
        let film = film_state(&app, plate);
        let stains = app.world().get::<StainFields>(plate).expect("stains");
        (stains.film.wet.clone(), stains.film.moisture.iter().sum::<f32>(), film.forces.torn_edges)
    };
    let calm = aged(CoatingWeather::default(), None);
    assert_eq!(aged(storm, None), calm, "today's weather does not reach back");
    assert_eq!(calm.1, 0.0);
    let wet = aged(CoatingWeather::default(), Some(storm));
    assert!(wet.1 > 0.0 && wet != calm, "the past was rainy");
    assert_eq!(aged(storm, Some(storm)), wet);
}

#[test]
fn a_coating_of_its_own_has_a_root_and_the_films_know_it() {
    let mut app = app();
    let car = spawn_car(&mut app, quick_coating(), Vec3::ZERO);
    wait_for_films(&mut app, 4);
    assert!(app.world_mut().query::<&CoatedBy>().iter(app.world()).all(|coated_by| coated_by.0 == car));
}
