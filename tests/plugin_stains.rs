//! Weather in an app: wind, gravity and turning, and what shelters from rain and sun.

mod common;

use std::time::Duration;

use bevy::{asset::RenderAssetUsages, math::Affine3A, prelude::*, time::TimeUpdateStrategy};
use bevy_coating::{
    plugin::FilmPace,
    prelude::*,
    sim::FilmState,
    stain::{Environment, Exposure, StainFields, exposure::exposure_of},
};
use common::*;

const RAIN: CoatingWeather = CoatingWeather { wind: Vec3::ZERO, gusts: 0.0, rain: Vec3::NEG_Y, sun: Vec3::ZERO };

/// Turns the plate, which faces +z, to face up.
fn lying() -> Transform {
    Transform::from_rotation(Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2))
}

/// A plate that lies on the ground, over 0 to 1 in x and -1 to 0 in z.
fn spawn_lying(app: &mut App, n: u32, coating: Coating) -> Entity {
    let mesh = add_mesh(app, plate(n));
    app.world_mut().spawn((Mesh3d(mesh), lying(), coating)).id()
}

/// A roof over half of what lies on the ground, one metre up: over x from -1.5 to 0.5.
fn spawn_roof(app: &mut App) -> Entity {
    let mesh = add_mesh(app, Plane3d::new(Vec3::Y, Vec2::new(1.0, 2.0)).mesh().build());
    app.world_mut().spawn((Mesh3d(mesh), Transform::from_xyz(-0.5, 1.0, -0.5), RainShelter)).id()
}

fn exposure(app: &App, film: Entity) -> &Exposure {
    &app.world().get::<StainFields>(film).expect("a film").exposure
}

/// Exposure to rain of the lying plate at `x`, in the middle of z.
fn rain_at(app: &App, film: Entity, x: f32) -> f32 {
    let state = film_state(app, film);
    let rest = &state.mesh.geometry.rest_positions[..state.mesh.topology.original_vertex_count()];
    let to = |p: &Vec3| p.distance_squared(Vec3::new(x, 0.5, 0.0));
    let nearest = (0..rest.len()).min_by(|&i, &j| to(&rest[i]).total_cmp(&to(&rest[j]))).expect("a vertex");
    exposure(app, film).rain.get(nearest).copied().unwrap_or(1.0)
}

fn environment(app: &App, film: Entity) -> Environment {
    app.world().get::<FilmPace>(film).expect("a film").environment
}

/// Requests `steps` steps and updates until all films that were ready have taken them.
fn take_steps_held(app: &mut App, steps: u64) {
    let clocks = |app: &mut App| {
        let world = app.world_mut();
        world.query::<&FilmClock>().iter(world).map(|clock| clock.steps).collect::<Vec<_>>()
    };
    let expected: Vec<u64> = clocks(app).iter().map(|taken| taken + steps).collect();
    app.world_mut().resource_mut::<CoatingClock>().request_steps(steps);
    update_until(app, |app| clocks(app) == expected);
}

/// Settings under which rain, sun, rust and dust all do something soon.
fn wet_coating() -> Coating {
    quick_coating().with_seed(11)
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
}

#[test]
fn the_start_age_is_reached_under_the_same_sky() {
    let coating = wet_coating();
    let mut app = app();
    app.insert_resource(CoatingWeather { rain: Vec3::new(0.0, -0.8, -0.6), ..RAIN });
    spawn_roof(&mut app);
    let stood = spawn_lying(&mut app, 14, coating.clone());
    let appeared = spawn_lying(&mut app, 14, coating.clone().with_start_age(0.5));
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
        let mut app = common::app();
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
fn a_roof_keeps_what_is_under_it_dry() {
    let mut app = app();
    let film = spawn_lying(&mut app, 20, wet_coating());
    spawn_roof(&mut app);
    wait_for_films(&mut app, 1);
    app.insert_resource(RAIN);
    take_steps_held(&mut app, 20);
    assert_eq!((rain_at(&app, film, 0.1), rain_at(&app, film, 0.9)), (0.0, 1.0));
    let state = film_state(&app, film);
    let moisture = |side: fn(f32) -> bool| {
        let positions = &state.mesh.geometry.rest_positions;
        let wet = state.stains.film.moisture.iter().zip(positions).filter(|(_, p)| side(p.x)).map(|(m, _)| *m);
        wet.fold(0.0f32, f32::max)
    };
    assert_eq!(moisture(|x| x < 0.4), 0.0);
    assert!(moisture(|x| x > 0.6) > 0.1, "it does rain");
}

#[test]
fn exposure_follows_shelters_props_rain_and_choice() {
    let mut app = app();
    let film = spawn_lying(&mut app, 10, wet_coating());
    let roof = spawn_roof(&mut app);
    app.insert_resource(RAIN);
    wait_for_films(&mut app, 1);
    let sides = |app: &App| (rain_at(app, film, 0.1), rain_at(app, film, 0.9));
    assert_eq!(sides(&app), (0.0, 1.0));
    let until = |app: &mut App, what: &str, expected: (f32, f32)| {
        for _ in 0..5000 {
            app.update();
            if sides(app) == expected {
                return;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        panic!("{what}: {:?}", sides(app));
    };
    app.world_mut().get_mut::<Transform>(roof).expect("a roof").translation.x += 1.0;
    until(&mut app, "the roof moves over all of it", (0.0, 0.0));
    app.world_mut().get_mut::<Transform>(film).expect("a prop").translation.x += 1.0;
    until(&mut app, "the prop moves after it", (0.0, 1.0));
    app.insert_resource(CoatingWeather { rain: Vec3::new(-1.0, -1.0, 0.0).normalize(), ..RAIN });
    until(&mut app, "rain falls aslant, in under the roof", (1.0, 1.0));
    app.insert_resource(RAIN);
    until(&mut app, "and straight down again", (0.0, 1.0));
    app.world_mut().get_mut::<Coating>(film).expect("a coating").shelter = Shelter::Open;
    until(&mut app, "nothing is to shelter it", (1.0, 1.0));
    app.world_mut().get_mut::<Coating>(film).expect("a coating").shelter = Shelter::Scene;
    until(&mut app, "but then again", (0.0, 1.0));
    app.world_mut().entity_mut(roof).remove::<RainShelter>();
    until(&mut app, "the roof is none any more", (1.0, 1.0));
    let house = app.world_mut().spawn((Transform::default(), Visibility::default(), RainShelter)).id();
    app.world_mut().entity_mut(roof).insert(ChildOf(house));
    until(&mut app, "it is part of a house", (0.0, 1.0));
    app.world_mut().despawn(house);
    until(&mut app, "which is pulled down", (1.0, 1.0));
}

#[test]
fn a_given_exposure_is_left_alone() {
    let mut app = app();
    let film = spawn_lying(&mut app, 8, wet_coating().with_shelter(Shelter::Given));
    spawn_roof(&mut app);
    app.insert_resource(RAIN);
    wait_for_films(&mut app, 1);
    assert_eq!(*exposure(&app, film), Exposure::default());
    let given = Exposure { rain: vec![0.25; 81], sun: Vec::new() };
    app.world_mut().get_mut::<StainFields>(film).expect("a film").exposure = given.clone();
    take_steps(&mut app, 10);
    assert_eq!(app.world().get::<FilmClock>(film).expect("a film").steps, 10, "there is nothing to wait for");
    assert_eq!(*exposure(&app, film), given);
}

#[test]
fn props_are_sheltered_as_tools_would_have_it() {
    let mut app = app();
    let weather = CoatingWeather { sun: Vec3::new(0.6, -0.8, 0.1), ..RAIN };
    app.insert_resource(weather);
    // Turned, stretched and mirrored, under a turned roof.
    let place = Transform::from_xyz(1.0, 2.0, 3.0)
        .with_rotation(Quat::from_euler(EulerRot::XYZ, -1.2, 0.4, 0.3))
        .with_scale(Vec3::new(-2.0, 1.5, 1.0));
    let mesh = add_mesh(&mut app, plate(20));
    let film = app.world_mut().spawn((Mesh3d(mesh), place, quick_coating())).id();
    let roof_mesh = Plane3d::new(Vec3::Y, Vec2::new(1.0, 0.6)).mesh().build();
    let roof_place = Transform::from_xyz(0.0, 5.0, 2.0).with_rotation(Quat::from_rotation_z(0.3));
    let handle = add_mesh(&mut app, roof_mesh.clone());
    app.world_mut().spawn((Mesh3d(handle), roof_place, RainShelter));
    wait_for_films(&mut app, 1);
    let found = exposure(&app, film).clone();
    // The film's space: turned and moved with the prop, but not scaled.
    let (_, rotation, translation) = GlobalTransform::from(place).to_scale_rotation_translation();
    let into = Affine3A::from_rotation_translation(rotation, translation).inverse() * roof_place.compute_affine();
    let positions = roof_mesh.attribute(Mesh::ATTRIBUTE_POSITION).and_then(|p| p.as_float3()).expect("positions");
    let corners: Vec<Vec3> = roof_mesh
        .indices()
        .expect("indices")
        .iter()
        .map(|i| into.transform_point3(Vec3::from_array(positions[i])))
        .collect();
    let turned = |v: Vec3| rotation.inverse() * v;
    let film = film_state(&app, film).mesh;
    let triangles = corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]);
    let expected = exposure_of(&film, triangles, turned(weather.rain), turned(weather.sun));
    let differ = |a: &[f32], b: &[f32]| a.iter().zip(b).filter(|(a, b)| a != b).count();
    assert!(expected.rain.contains(&0.0) && expected.rain.contains(&1.0));
    assert_eq!((found.rain.len(), found.sun.len()), (expected.rain.len(), expected.sun.len()));
    // Rounding may decide single rays at the border otherwise.
    assert!(differ(&found.rain, &expected.rain) + differ(&found.sun, &expected.sun) < 5);
}

#[test]
fn meshes_of_one_prop_shelter_each_other() {
    let mut app = app();
    app.insert_resource(RAIN);
    let (plate_mesh, other) = (add_mesh(&mut app, plate(10)), add_mesh(&mut app, plate(9)));
    let world = app.world_mut();
    let root = world.spawn((Transform::default(), Visibility::default(), quick_coating())).id();
    let below = world.spawn((Mesh3d(plate_mesh), lying(), ChildOf(root))).id();
    let place = lying().with_translation(Vec3::new(-0.5, 0.3, 0.0));
    let above = world.spawn((Mesh3d(other), place, ChildOf(root))).id();
    wait_for_films(&mut app, 2);
    assert_eq!((rain_at(&app, below, 0.1), rain_at(&app, below, 0.9)), (0.0, 1.0));
    assert_eq!(*exposure(&app, above), Exposure::default());
    let mut app = common::app();
    app.insert_resource(RAIN);
    let (plate_mesh, other) = (add_mesh(&mut app, plate(10)), add_mesh(&mut app, plate(9)));
    let below = app.world_mut().spawn((Mesh3d(plate_mesh), lying(), quick_coating())).id();
    app.world_mut().spawn((Mesh3d(other), place, quick_coating()));
    wait_for_films(&mut app, 2);
    assert_eq!(*exposure(&app, below), Exposure::default(), "other props do not shelter it unless they are marked");
}

#[test]
fn shelters_that_cannot_be_read_are_passed_over() {
    let mut app = app();
    app.insert_resource(RAIN);
    let mut mesh = Plane3d::new(Vec3::Y, Vec2::splat(9.0)).mesh().build();
    mesh.asset_usage = RenderAssetUsages::RENDER_WORLD;
    mesh.take_gpu_data().expect("the data");
    let handle = add_mesh(&mut app, mesh);
    app.world_mut().spawn((Mesh3d(handle), Transform::from_xyz(0.0, 1.0, 0.0), RainShelter));
    let film = spawn_lying(&mut app, 6, quick_coating());
    wait_for_films(&mut app, 1);
    take_steps_held(&mut app, 5);
    assert_eq!(*exposure(&app, film), Exposure::default());
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

#[test]
fn a_film_that_never_comes_to_rest_goes_on() {
    let mut app = app();
    spawn_roof(&mut app);
    let film = spawn_lying(&mut app, 8, wet_coating());
    app.insert_resource(RAIN);
    wait_for_films(&mut app, 1);
    let mut clock = app.world_mut().resource_mut::<CoatingClock>();
    (clock.paused, clock.age_per_second, clock.target_age) = (false, 1.0, Some(0.5));
    update_until(&mut app, |app| {
        let mut transform = app.world_mut().get_mut::<Transform>(film).expect("a prop");
        transform.rotate_y(0.1);
        transform.translation.x = (transform.translation.x + 0.3) % 2.0;
        app.world().resource::<CoatingStatus>().youngest >= 0.5
    });
}
