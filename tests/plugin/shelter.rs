//! What stands around a prop keeps rain and sun off it.

use std::time::Duration;

use bevy::{asset::RenderAssetUsages, math::Affine3A, prelude::*};
use bevy_coating::{
    FilmPace,
    prelude::*,
    stain::{Exposure, StainFields, exposure::exposure_of},
};

use crate::{common::*, sky::*};

/// Exposure to rain of the lying plate at `x`, in the middle of z.
fn rain_at(app: &App, film: Entity, x: f32) -> f32 {
    let state = film_state(app, film);
    let rest = &state.mesh.geometry.rest_positions[..state.mesh.topology.original_vertex_count()];
    let to = |p: &Vec3| p.distance_squared(Vec3::new(x, 0.5, 0.0));
    let nearest = (0..rest.len()).min_by(|&i, &j| to(&rest[i]).total_cmp(&to(&rest[j]))).expect("a vertex");
    exposure(app, film).rain.get(nearest).copied().unwrap_or(1.0)
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
fn a_prop_has_weather_of_its_own() {
    let mut app = app();
    app.insert_resource(RAIN);
    let dry = CoatingWeather::default();
    let [outside, cellar] = [1, 2].map(|seed| spawn_lying(&mut app, 8, wet_coating().with_seed(seed)));
    app.world_mut().entity_mut(cellar).insert(PropWeather(dry));
    wait_for_films(&mut app, 2);
    let wettest =
        |app: &App, film: Entity| film_state(app, film).stains.film.moisture.iter().fold(0.0f32, |m, &w| m.max(w));
    take_steps_held(&mut app, 20);
    assert!(wettest(&app, outside) > 0.1, "it rains");
    assert_eq!(wettest(&app, cellar), 0.0, "but not in the cellar");

    // A rain machine in fair weather, with a roof over half of what it rains on.
    app.insert_resource(dry);
    app.world_mut().entity_mut(cellar).insert(PropWeather(RAIN));
    spawn_roof(&mut app);
    update_until(&mut app, |app| exposure(app, cellar).rain.contains(&0.0));
    take_steps_held(&mut app, 20);
    assert!(wettest(&app, cellar) > 0.1, "it rains now");
    assert_eq!(rain_at(&app, cellar, 0.1), 0.0, "under the roof it is dry");
    assert_eq!(rain_at(&app, cellar, 0.9), 1.0);

    // Without it the prop shares the world's weather again, and values out of range are clamped.
    app.world_mut().entity_mut(cellar).insert(PropWeather(CoatingWeather { rain: Vec3::NAN, ..dry }));
    app.update();
    assert_eq!(app.world().get::<FilmPace>(cellar).expect("a film").environment.rain, Vec3::ZERO);
    app.world_mut().entity_mut(cellar).remove::<PropWeather>();
    app.insert_resource(CoatingWeather { wind: Vec3::X, ..dry });
    app.update();
    let wind = [outside, cellar].map(|film| app.world().get::<FilmPace>(film).expect("a film").environment.wind);
    assert_eq!(wind[0], wind[1]);
    assert_ne!(wind[0], Vec3::ZERO);
}

#[test]
fn a_prop_that_comes_late_has_lived_in_its_own_weather() {
    let mut app = app();
    app.insert_resource(RAIN);
    app.insert_resource(CoatingClock { age_per_second: 1.0, ..default() });
    for _ in 0..10 {
        app.update();
    }
    app.world_mut().resource_mut::<CoatingClock>().paused = true;
    let coating = || wet_coating().with_painted(0.0);
    let [outside, cellar] = [1, 2].map(|seed| spawn_lying(&mut app, 8, coating().with_seed(seed)));
    app.world_mut().entity_mut(cellar).insert(PropWeather(CoatingWeather::default()));
    wait_for_films(&mut app, 2);
    let wet = [outside, cellar].map(|film| {
        let state = film_state(&app, film);
        assert!(state.clock.age() > 0.3, "{}", state.clock.age());
        state.stains.film.moisture.iter().fold(0.0f32, |m, &w| m.max(w))
    });
    assert!(wet[0] > 0.1 && wet[1] == 0.0, "{wet:?}");
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
    let mut app = crate::common::app();
    app.insert_resource(RAIN);
    let (plate_mesh, other) = (add_mesh(&mut app, plate(10)), add_mesh(&mut app, plate(9)));
    let below = app.world_mut().spawn((Mesh3d(plate_mesh), lying(), quick_coating())).id();
    app.world_mut().spawn((Mesh3d(other), place, quick_coating()));
    wait_for_films(&mut app, 2);
    assert_eq!(*exposure(&app, below), Exposure::default(), "other props do not shelter it unless they are marked");
}

#[test]
fn shelters_that_cannot_be_read_are_passed_over_until_they_can() {
    let mut app = app();
    app.insert_resource(RAIN);
    let mut mesh = Plane3d::new(Vec3::Y, Vec2::splat(9.0)).mesh().build();
    mesh.asset_usage = RenderAssetUsages::RENDER_WORLD;
    mesh.take_gpu_data().expect("the data");
    let handle = add_mesh(&mut app, mesh);
    app.world_mut().spawn((Mesh3d(handle), Transform::from_xyz(0.0, 1.0, 0.0), RainShelter));
    // One that is still to be made.
    let coming = app.world().resource::<Assets<Mesh>>().reserve_handle();
    app.world_mut().spawn((Mesh3d(coming.clone()), Transform::from_xyz(0.0, 1.0, 0.0), RainShelter));
    let film = spawn_lying(&mut app, 6, quick_coating());
    wait_for_films(&mut app, 1);
    take_steps_held(&mut app, 5);
    assert_eq!(*exposure(&app, film), Exposure::default());
    let roof = Plane3d::new(Vec3::Y, Vec2::splat(9.0)).mesh().build();
    app.world_mut().resource_mut::<Assets<Mesh>>().insert(&coming, roof).expect("a place for it");
    update_until(&mut app, |app| *exposure(app, film) != Exposure::default());
    let mut meshes = app.world_mut().resource_mut::<Assets<Mesh>>();
    let away = Mesh::clone(meshes.get(&coming).expect("a roof")).translated_by(Vec3::X * 30.0);
    meshes.insert(&coming, away).expect("its place");
    update_until(&mut app, |app| *exposure(app, film) == Exposure::default());
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

/// Longest and mean frame of so many, in milliseconds.
fn frame_times(app: &mut App, mut frames: impl FnMut(&mut App) -> bool) -> (f64, f64, u32) {
    let (mut longest, mut sum, mut count) = (0.0f64, 0.0, 0);
    while frames(app) {
        let begin = std::time::Instant::now();
        app.update();
        let milliseconds = begin.elapsed().as_secs_f64() * 1e3;
        (longest, sum, count) = (longest.max(milliseconds), sum + milliseconds, count + 1);
        std::thread::sleep(Duration::from_millis(2));
    }
    (longest, sum / f64::from(count), count)
}

/// Prints what shelter costs with many props, each of which shelters the others. For machines that do nothing else:
/// `cargo test --test plugin thousand -- --ignored --nocapture`.
#[test]
#[ignore = "measures time"]
fn a_thousand_props_in_the_first_rain() {
    const SIDE: u32 = 32;
    let mut app = app();
    let mut roof = None;
    for i in 0..SIDE * SIDE {
        let place = Vec3::new((i % SIDE) as f32, 0.0, (i / SIDE) as f32) * 4.0;
        // Every prop has a mesh of its own, as in a level.
        let mesh = add_mesh(&mut app, plate(16));
        let transform = lying().with_translation(place);
        roof = Some(app.world_mut().spawn((Mesh3d(mesh), transform, quick_coating(), RainShelter)).id());
    }
    let films = (SIDE * SIDE) as usize;
    wait_for_films(&mut app, films);
    let (longest, mean, _) = frame_times(&mut app, {
        let mut left = 50;
        move |_| {
            left -= 1;
            left > 0
        }
    });
    println!("dry: longest frame {longest:.2} ms, mean {mean:.2} ms");
    app.insert_resource(RAIN);
    let mut request = app.world_mut().resource_mut::<CoatingClock>();
    request.request_steps(1);
    let (longest, mean, frames) = frame_times(&mut app, |app| {
        let world = app.world_mut();
        world.query::<&FilmClock>().iter(world).any(|clock| clock.steps == 0)
    });
    println!("first rain: longest frame {longest:.2} ms, mean {mean:.2} ms, {frames} frames until all are known");
    let mut left = 100;
    let (longest, mean, _) = frame_times(&mut app, |app| {
        let mut transform = app.world_mut().get_mut::<Transform>(roof.expect("props")).expect("a prop");
        transform.translation.x += 0.01;
        left -= 1;
        left > 0
    });
    println!("one prop moves: longest frame {longest:.2} ms, mean {mean:.2} ms");
}
