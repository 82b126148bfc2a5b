//! Worlds in other units than metres.

use bevy::{mesh::VertexAttributeValues, prelude::*};
use bevy_coating::{CoatingFault, FilmEdit, film::FilmMesh, prelude::*, stain::StainFields};

use crate::common::*;

/// An app whose units are so many metres long.
fn app_of(metres: f32) -> App {
    let mut app = app();
    app.insert_resource(CoatingUnit { metres });
    app
}

/// A plate that is `scale` units wide, before its world scale.
fn large_plate(app: &mut App, scale: f32) -> Handle<Mesh> {
    let mesh = plate(8).scaled_by(Vec3::splat(scale));
    add_mesh(app, mesh)
}

/// The mesh that shows the film on `entity`.
fn shown(app: &App, entity: Entity) -> Vec<Vec3> {
    let handle = &app.world().get::<Mesh3d>(entity).expect("a mesh").0;
    let mesh = app.world().resource::<Assets<Mesh>>().get(handle).expect("an asset");
    let values = mesh.attribute(Mesh::ATTRIBUTE_POSITION).and_then(VertexAttributeValues::as_float3);
    values.expect("positions").iter().map(|&p| Vec3::from_array(p)).collect()
}

fn coating() -> Coating {
    quick_coating().with_seed(7)
}

/// A plate in an app, aged by 50 steps and damaged by hand, with the pieces that fell off.
fn aged(mut app: App, mesh: f32, scale: f32) -> (App, Entity, Vec<PieceFallen>) {
    let mesh = large_plate(&mut app, mesh);
    let place = Transform::from_xyz(3.0, 0.0, 0.0).with_scale(Vec3::splat(scale));
    let plate = app.world_mut().spawn((Mesh3d(mesh), coating(), place)).id();
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 50);
    let mut fallen = messages::<PieceFallen>(&mut app);
    // One more, knocked off by hand.
    let film = app.world().get::<FilmMesh>(plate).expect("a film");
    let face = film.topology.live_faces().nth(10).expect("a face");
    app.world_mut().commands().entity(plate).queue(FilmEdit::StripFace(face));
    app.world_mut().flush();
    fallen.extend(messages::<PieceFallen>(&mut app));
    app.update();
    (app, plate, fallen)
}

#[test]
fn a_prop_ages_alike_in_a_world_of_any_unit() {
    let (metres, plate, fallen) = aged(app(), 1.0, 1.0);
    let expected = film_state(&metres, plate).digest();
    let small = shown(&metres, plate);
    assert!(!fallen.is_empty(), "something falls");

    // A mesh of 128 units, each a 128th of a metre: not a bit differs.
    let (app, plate, pieces) = aged(app_of(1.0 / 128.0), 128.0, 1.0);
    assert_eq!(film_state(&app, plate).digest(), expected);
    assert_eq!(shown(&app, plate), small.iter().map(|p| *p * 128.0).collect::<Vec<_>>());
    assert_eq!(pieces.len(), fallen.len());
    let offset = Vec3::X * 3.0;
    for (piece, of_metres) in pieces.iter().zip(&fallen) {
        assert_eq!(piece.size, of_metres.size * 128.0);
        let position = (of_metres.position - offset) * 128.0 + offset;
        assert!(piece.position.distance(position) < 1e-2, "{piece:?} {of_metres:?}");
    }

    // A world in centimetres, in which a mesh of one unit is scaled by 100: it is 100 times as large in the world.
    let (app, plate, _) = aged(app_of(0.01), 1.0, 100.0);
    assert_eq!(film_state(&app, plate).digest(), expected);
    for (a, b) in shown(&app, plate).iter().zip(&small) {
        assert!(a.distance(*b) < 1e-6, "{a} {b}");
    }

    // In metres a plate of 128 units is another prop.
    let (app, plate, _) = aged(app_of(1.0), 128.0, 1.0);
    assert_ne!(film_state(&app, plate).digest(), expected);
}

#[test]
fn the_number_of_triangles_does_not_depend_on_the_unit() {
    let faces = |metres: f32, size: f32| {
        let mut app = app_of(metres);
        let mesh = large_plate(&mut app, size);
        let mut settings = CoatingSettings::default();
        settings.scale.grain = 0.1;
        let plate = app.world_mut().spawn((Mesh3d(mesh), Coating::new(settings).with_seed(1))).id();
        wait_for_films(&mut app, 1);
        film_state(&app, plate).mesh.topology.face_count()
    };
    assert_eq!(faces(1.0, 1.0), faces(0.125, 8.0));
}

#[test]
fn shelters_are_where_they_are_in_a_world_of_any_unit() {
    let exposure = |metres: f32, late: bool| {
        let size = 1.0 / metres;
        let mut app = app_of(metres);
        let mesh = large_plate(&mut app, size);
        let lying = Transform::from_rotation(Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2));
        let plate = app.world_mut().spawn((Mesh3d(mesh.clone()), coating(), lying)).id();
        let roof = lying.with_translation(Vec3::new(0.5, 0.3, 0.0) * size);
        app.world_mut().spawn((Mesh3d(mesh), RainShelter, roof));
        let rain = CoatingWeather { rain: Vec3::NEG_Y, ..CoatingWeather::default() };
        if late {
            wait_for_films(&mut app, 1);
        }
        app.insert_resource(rain);
        wait_for_films(&mut app, 1);
        let rain_of = |app: &App| app.world().get::<StainFields>(plate).expect("a film").exposure.rain.clone();
        update_until(&mut app, |app| !rain_of(app).is_empty());
        rain_of(&app)
    };
    let expected = exposure(1.0, false);
    assert!(expected.contains(&0.0) && expected.contains(&1.0), "{expected:?}");
    for late in [false, true] {
        for metres in [1.0 / 128.0, 16.0] {
            let found = exposure(metres, late);
            let differ = found.iter().zip(&expected).filter(|(a, b)| (*a - *b).abs() > 0.05).count();
            assert!(found.len() == expected.len() && differ == 0, "{metres} {late}: {differ} of {}", found.len());
        }
    }
}

#[test]
fn a_unit_out_of_range_is_told_and_mended() {
    let mut app = bare_app();
    // Before or after the plugin.
    app.insert_resource(CoatingUnit { metres: f32::NAN });
    app.add_plugins(CoatingWeatheringPlugin::default());
    spawn_plate(&mut app, 4, coating());
    update_until(&mut app, |app| app.world().resource::<CoatingStatus>().refused == 1);
    for metres in [0.0, -1.0, 1e5, f32::INFINITY] {
        app.insert_resource(CoatingUnit { metres });
        for _ in 0..3 {
            app.update();
        }
    }
    let failed = messages::<FilmFailed>(&mut app);
    assert!(failed.iter().all(|failed| matches!(failed.error.cause, CoatingFault::Unit(_))), "{failed:?}");
    app.insert_resource(CoatingUnit::default());
    wait_for_films(&mut app, 1);
}
