//! Films age in an app as they do without one, whatever the frames and threads.

use std::time::Duration;

use bevy::{
    ecs::schedule::{LogLevel, ScheduleBuildSettings, ScheduleLabel},
    prelude::*,
    time::TimeUpdateStrategy,
};
use bevy_coating::{
    prelude::*,
    remesh::{build_film, film_targets},
    sim::FilmState,
    stain::Environment,
    surface::Surface,
};

use crate::common::*;

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
    let seed = coating.seed.expect("a fixed seed");
    let target = film_targets(coating.resolution, settings.scale.grain, &[surface.area()])[0];
    let built = build_film(&surface, target, seed).expect("a film");
    let film = FilmState::new(&built, &settings, seed, coating.steps_per_age).expect("a manifold");
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
    expected.age_to(1.0, &settings, &Environment::default());
    let aged = film_state(&app, plate);
    assert_eq!(aged.clock.steps, 100);
    assert_eq!(aged.digest(), expected.digest());
    assert_eq!(aged.constraints, expected.constraints);
    let measures = aged.measure();
    assert!(measures.separated > Some(0.3) && measures.torn > Some(0.05), "{measures:?}");
    assert_eq!(aged.validate(), Ok(()));
}

#[test]
fn frames_do_not_change_a_film() {
    let digest_at = |frame: Duration| {
        let mut app = app();
        let plate = spawn_plate(&mut app, 12, quick_coating());
        wait_for_films(&mut app, 1);
        app.insert_resource(TimeUpdateStrategy::ManualDuration(frame));
        let mut clock = app.world_mut().resource_mut::<CoatingClock>();
        (clock.paused, clock.age_per_second, clock.target_age) = (false, 0.37, Some(0.7));
        update_until(&mut app, |app| app.world().resource::<CoatingStatus>().youngest >= 0.7);
        app.update();
        let film = film_state(&app, plate);
        assert_eq!(film.clock.steps, 70, "the target holds");
        film.digest()
    };
    let expected = digest_at(Duration::from_millis(16));
    for milliseconds in [7, 333] {
        assert_eq!(digest_at(Duration::from_millis(milliseconds)), expected, "frames of {milliseconds} ms");
    }
}

/// Ages four plates on as many threads as the environment says, and prints their digests.
#[test]
fn digests_for_other_processes() {
    let Some(mut app) = app_of_other_process() else { return };
    let plates: Vec<Entity> = (0..4).map(|seed| spawn_plate(&mut app, 9, quick_coating().with_seed(seed))).collect();
    wait_for_films(&mut app, 4);
    take_steps(&mut app, 70);
    for plate in plates {
        println!("digest {}", film_state(&app, plate).digest());
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    assert_same_on_any_number_of_threads("ageing::digests_for_other_processes");
}

#[test]
fn films_do_not_change_each_other() {
    let coating = |i: u64| quick_coating().with_seed(i).with_rate(0.5 + 0.25 * i as f64);
    let digests = |seeds: &[u64]| {
        let mut app = app();
        let plates: Vec<Entity> = seeds.iter().map(|&seed| spawn_plate(&mut app, 10, coating(seed))).collect();
        wait_for_films(&mut app, seeds.len());
        let mut clock = app.world_mut().resource_mut::<CoatingClock>();
        (clock.paused, clock.age_per_second, clock.target_age) = (false, 1.0, Some(0.6));
        update_until(&mut app, |app| app.world().resource::<CoatingStatus>().youngest >= 0.6);
        plates.iter().map(|&plate| film_state(&app, plate).digest()).collect::<Vec<_>>()
    };
    let together = digests(&[0, 1, 2, 3, 4, 5]);
    for seed in 0..6 {
        assert_eq!(digests(&[seed]), together[seed as usize..=seed as usize], "seed {seed}");
    }
}

#[test]
fn instances_of_one_mesh_age_apart() {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(10));
    let plates = [1.0, 2.0, 0.0]
        .map(|rate| app.world_mut().spawn((Mesh3d(mesh.clone()), quick_coating().with_seed(5).with_rate(rate))).id());
    wait_for_films(&mut app, 3);
    let shown = plates.map(|plate| app.world().get::<Mesh3d>(plate).expect("a mesh").0.clone());
    assert!(shown[0] != shown[1] && shown[1] != shown[2] && !shown.contains(&mesh), "each has a mesh of its own");
    let mut clock = app.world_mut().resource_mut::<CoatingClock>();
    (clock.paused, clock.age_per_second) = (false, 1.0);
    for _ in 0..6 {
        app.update();
    }
    app.world_mut().resource_mut::<CoatingClock>().paused = true;
    app.update();
    let films = plates.map(|plate| film_state(&app, plate));
    assert_eq!(films.each_ref().map(|film| film.clock.steps), [30, 60, 0]);
    take_steps(&mut app, 30);
    let caught_up = film_state(&app, plates[0]);
    assert_eq!(caught_up.digest(), films[1].digest(), "the same film, sooner or later");
}

#[test]
fn the_start_age_is_reached_in_the_background() {
    let coating = quick_coating().with_seed(2).with_start_age(0.6);
    let (mut expected, settings) = reference(12, &coating);
    expected.age_to(0.6, &settings, &Environment::default());
    let mut app = app();
    let plate = spawn_plate(&mut app, 12, coating);
    wait_for_films(&mut app, 1);
    assert_eq!(film_state(&app, plate).digest(), expected.digest());
    assert_eq!(messages::<FirstCrack>(&mut app).len(), 0, "it cracked before anyone looked");
    assert_eq!(messages::<FirstSeparation>(&mut app).len(), 0, "nor did anyone see it let go");
    let ready = messages::<FilmReady>(&mut app);
    assert_eq!(ready.len(), 1);
    assert_eq!((ready[0].entity, ready[0].root, ready[0].triangles), (plate, plate, 288));
    take_steps(&mut app, 10);
    expected.age_to(0.7, &settings, &Environment::default());
    assert_eq!(film_state(&app, plate).digest(), expected.digest(), "and goes on from there");
}

#[test]
fn cracks_and_fallen_pieces_are_told_in_world_space() {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(14));
    let place = Transform::from_xyz(10.0, 0.0, 0.0).with_scale(Vec3::splat(3.0));
    let plate = app.world_mut().spawn((Mesh3d(mesh), place, quick_coating().with_seed(3))).id();
    wait_for_films(&mut app, 1);
    let mut separations = Vec::new();
    let mut cracks = Vec::new();
    let mut pieces = Vec::new();
    for _ in 0..100 {
        take_steps(&mut app, 1);
        separations.extend(messages::<FirstSeparation>(&mut app));
        cracks.extend(messages::<FirstCrack>(&mut app));
        pieces.extend(messages::<PieceFallen>(&mut app));
    }
    assert_eq!(cracks.len(), 1);
    assert!(cracks[0].entity == plate && cracks[0].age > 0.0 && cracks[0].age < 1.0, "{cracks:?}");
    let on_plate = |p: Vec3| p.x > 9.0 && p.x < 14.0 && p.y > -1.0 && p.y < 4.0 && p.z > -0.01 && p.z < 1.5;
    assert!(on_plate(cracks[0].position), "{cracks:?}");
    assert_eq!(separations.len(), 1);
    let first = separations[0];
    assert!(first.entity == plate && first.age > 0.0 && first.age <= cracks[0].age, "{first:?}");
    assert!(on_plate(first.position) && first.position.z < 0.01, "it has hardly moved yet: {first:?}");
    let film = film_state(&app, plate);
    let gone = film.mesh.topology.face_count() - film.mesh.topology.live_faces().count();
    assert!(gone > 5, "{gone}");
    assert_eq!(pieces.iter().map(|piece| piece.faces as usize).sum::<usize>(), gone);
    let edge = 3.0 / 14.0;
    for piece in &pieces {
        assert!(piece.entity == plate && on_plate(piece.position), "{piece:?}");
        let area = piece.size * piece.size / piece.faces as f32;
        assert!(area > 0.1 * edge * edge && area < 1.5 * edge * edge, "{piece:?}");
    }
}

#[test]
fn uneven_and_mirrored_scale_is_simulated_in_world_proportions() {
    let state = |transform: Transform, mesh: Mesh| {
        let mut app = app();
        let mesh = add_mesh(&mut app, mesh);
        let plate = app.world_mut().spawn((Mesh3d(mesh), transform, quick_coating().with_seed(4))).id();
        wait_for_films(&mut app, 1);
        take_steps(&mut app, 100);
        film_state(&app, plate)
    };
    let scale = Vec3::new(2.0, 0.5, 1.0);
    let stretched = plate(12).scaled_by(scale);
    let expected = state(Transform::IDENTITY, stretched);
    assert_eq!(state(Transform::from_scale(scale), plate(12)).digest(), expected.digest());
    let mirrored = state(Transform::from_scale(Vec3::new(-1.0, 1.0, 1.0)), plate(12));
    assert_eq!(mirrored.validate(), Ok(()));
    assert!(mirrored.measure().torn > Some(0.01));
    let up = mirrored.mesh.geometry.rest_normals.iter().all(|n| n.z > 0.9);
    assert!(up, "the front stays the front");
}

#[test]
fn gravity_turns_with_the_prop() {
    let digest = |turn: Quat, gravity: Vec3| {
        let mut app = app();
        app.insert_resource(CoatingGravity(gravity));
        let mesh = add_mesh(&mut app, plate(12));
        let bundle = (Mesh3d(mesh), Transform::from_rotation(turn), quick_coating().with_seed(4));
        let plate = app.world_mut().spawn(bundle).id();
        wait_for_films(&mut app, 1);
        take_steps(&mut app, 90);
        film_state(&app, plate).digest()
    };
    let half_turn = Quat::from_xyzw(0.0, 0.0, 1.0, 0.0);
    let upright = digest(Quat::IDENTITY, Vec3::NEG_Y);
    assert_eq!(digest(half_turn, Vec3::Y * 9.81), upright);
    assert_ne!(digest(half_turn, Vec3::NEG_Y), upright);
}

#[test]
fn no_order_of_systems_is_left_open() {
    let mut app = app();
    spawn_plate(&mut app, 6, quick_coating());
    // Bevy's own schedules leave some order open; ours must not add any.
    for schedule in [CoatingStep.intern(), Update.intern(), PostUpdate.intern()] {
        app.edit_schedule(schedule, |schedule| {
            let settings = ScheduleBuildSettings { ambiguity_detection: LogLevel::Error, ..default() };
            schedule.set_build_settings(settings);
        });
    }
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 5);
    assert_eq!(app.world().resource::<CoatingStatus>().stepped, 1);
}
