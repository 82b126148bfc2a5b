//! Touches of props by games and brushes.

use bevy::prelude::*;
use bevy_coating::{
    FilmHistory, FilmPace,
    film::FilmMesh,
    prelude::*,
    touch::{Change, Effect},
};

use crate::common::*;

fn film(app: &App, entity: Entity) -> bevy_coating::sim::FilmState {
    let state = film_state(app, entity);
    state.validate().expect("a sound film");
    state
}

/// Returns the middle of the plate in the world.
fn middle(app: &App, plate: Entity) -> Vec3 {
    app.world().get::<GlobalTransform>(plate).expect("a place").transform_point(Vec3::new(0.5, 0.5, 0.0))
}

fn touch(app: &mut App, entity: Entity, touch: TouchAt) {
    app.world_mut().commands().entity(entity).touch_at(touch);
    app.world_mut().flush();
}

/// Waits until films have gone through their pasts.
fn wait_for_arrival(app: &mut App) {
    update_until(app, |app| !messages::<AgeReached>(app).is_empty());
    app.update();
}

#[test]
fn a_shot_chips_a_prop_where_it_hits_whatever_its_scale() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 12, quick_coating());
    let place = Transform::from_xyz(5.0, 1.0, -2.0).with_scale(Vec3::new(2.0, 1.0, 1.5));
    app.world_mut().entity_mut(plate).insert(place);
    wait_for_films(&mut app, 1);
    let whole = film(&app, plate).mesh.topology.removed_face_count();
    let at = middle(&app, plate);
    assert_eq!(at, Vec3::new(6.0, 1.5, -2.0));
    app.world_mut().commands().entity(plate).hit(at, 0.3, 20.0);
    app.update();
    let pieces = messages::<PieceFallen>(&mut app);
    assert!(!pieces.is_empty() && whole == 0);
    for piece in &pieces {
        assert!(piece.position.distance(at) < 0.5, "{}", piece.position);
    }
    let gone = film(&app, plate).mesh.topology.removed_face_count();
    assert_eq!(gone, pieces.iter().map(|piece| piece.faces as usize).sum::<usize>());
    // Far from it, through the air: nothing.
    app.world_mut().commands().entity(plate).hit(at + Vec3::Z * 9.0, 0.3, 20.0);
    app.update();
    assert_eq!(film(&app, plate).mesh.topology.removed_face_count(), gone);
    // Numbers out of range are told of, and that is all.
    touch(&mut app, plate, TouchAt::new(at, 0.3, Effect::Hit(f32::NAN)));
    touch(&mut app, plate, TouchAt::new(at, -1.0, Effect::Strip));
    assert_eq!(film(&app, plate).mesh.topology.removed_face_count(), gone);
}

#[test]
fn a_player_shoots_a_sign_paints_it_saves_and_loads_and_finds_it_as_it_was() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 12, quick_coating());
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 60);
    let at = middle(&app, plate);
    app.world_mut().commands().entity(plate).hit(at, 0.3, 20.0);
    app.world_mut().commands().entity(plate).wash(at + Vec3::X * 0.2, 0.2, 1.0);
    app.world_mut().commands().entity(plate).scratch(at, at + Vec3::X * 0.3, 0.2);
    app.update();
    take_steps(&mut app, 5);
    app.world_mut().commands().entity(plate).sand(at, 0.2, 1.0).repaint(at, 0.15);
    app.update();
    let repainted = messages::<FilmRepainted>(&mut app);
    assert!(repainted.len() == 1 && !repainted[0].is_finished(), "{repainted:?}");
    take_steps(&mut app, 5);
    let saved = film(&app, plate).digest();
    let snapshot = CoatingSnapshot::of(app.world_mut(), plate).expect("a snapshot");
    take_steps(&mut app, 20);
    assert_ne!(film(&app, plate).digest(), saved);
    app.world_mut().commands().entity(plate).restore_films(snapshot);
    wait_for_arrival(&mut app);
    assert_eq!(film(&app, plate).digest(), saved);

    // All of it anew: it cracks again as fresh paint does.
    messages::<FirstCrack>(&mut app);
    app.world_mut().commands().entity(plate).repaint(at, 50.0);
    app.update();
    let repainted = messages::<FilmRepainted>(&mut app);
    assert!(repainted[0].is_finished() && repainted[0].whole == 1.0, "{repainted:?}");
    let fresh = film(&app, plate);
    assert_eq!((fresh.mesh.topology.removed_face_count(), fresh.forces.torn_edges), (0, 0));
    take_steps(&mut app, 90);
    assert_eq!(messages::<FirstCrack>(&mut app).len(), 1, "its first crack, again");
    film(&app, plate);
}

#[test]
fn strokes_are_taken_back_and_done_again_in_the_background() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 12, quick_coating());
    app.world_mut().entity_mut(plate).insert(CoatingHistory::default());
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 30);
    let untouched = {
        take_steps(&mut app, 20);
        let digest = film(&app, plate).digest();
        app.world_mut().get_mut::<FilmClock>(plate).expect("a clock").seek(0.3);
        wait_for_arrival(&mut app);
        digest
    };
    let at = middle(&app, plate);
    for (i, stroke) in [1, 1, 1, 2].into_iter().enumerate() {
        let weaken = Effect::Adhesion(Change::Multiply(0.2));
        touch(&mut app, plate, TouchAt::new(at + Vec3::X * (0.05 * i as f32), 0.1, weaken).in_stroke(stroke));
    }
    take_steps(&mut app, 20);
    let both = film(&app, plate).digest();
    assert_ne!(both, untouched);
    messages::<AgeReached>(&mut app);
    app.world_mut().commands().entity(plate).undo_touch();
    wait_for_arrival(&mut app);
    let first = film(&app, plate).digest();
    assert!(first != both && first != untouched);
    app.world_mut().commands().entity(plate).undo_touch();
    wait_for_arrival(&mut app);
    assert_eq!(film(&app, plate).digest(), untouched, "as if it had never been touched");
    assert_eq!(app.world().get::<FilmHistory>(plate).expect("a history").last_undone(), Some(1));
    app.world_mut().commands().entity(plate).redo_touch();
    wait_for_arrival(&mut app);
    assert_eq!(film(&app, plate).digest(), first);
    app.world_mut().commands().entity(plate).redo_touch();
    wait_for_arrival(&mut app);
    assert_eq!(film(&app, plate).digest(), both);
    // Both at once, before the first has arrived.
    app.world_mut().commands().entity(plate).undo_touch().undo_touch();
    wait_for_arrival(&mut app);
    assert_eq!(film(&app, plate).digest(), untouched);
    // Another stroke: there is nothing to do again any more.
    touch(&mut app, plate, TouchAt::new(at, 0.1, Effect::Strip).in_stroke(3));
    let history = app.world().get::<FilmHistory>(plate).expect("a history");
    assert_eq!((history.last_stroke(), history.last_undone()), (Some(3), None));
}

#[test]
fn new_paint_is_there_again_when_a_film_goes_through_its_past() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 12, quick_coating());
    app.world_mut().entity_mut(plate).insert(CoatingHistory::default());
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 70);
    let at = middle(&app, plate);
    app.world_mut().commands().entity(plate).repaint(at, 0.3);
    take_steps(&mut app, 10);
    let after = film(&app, plate).digest();
    app.world_mut().get_mut::<FilmClock>(plate).expect("a clock").seek(0.6);
    wait_for_arrival(&mut app);
    // By the clock, step by step.
    take_steps(&mut app, 20);
    assert_eq!(film(&app, plate).digest(), after);
    app.update();
    let shown = app.world().get::<Mesh3d>(plate).expect("a mesh").0.clone();
    let shown = triangles_of(app.world().resource::<Assets<Mesh>>().get(&shown).expect("an asset")).len();
    let topology = &app.world().get::<FilmMesh>(plate).expect("a film").topology;
    assert_eq!(shown, topology.live_faces().count(), "what is shown has followed");
}

#[test]
fn a_paused_film_is_touched_too_and_stays_paused() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 12, quick_coating().with_rate(1.0));
    wait_for_films(&mut app, 1);
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").paused = true;
    app.update();
    let at = middle(&app, plate);
    app.world_mut().commands().entity(plate).hit(at, 0.3, 20.0);
    app.update();
    assert!(film(&app, plate).mesh.topology.removed_face_count() > 0);
    assert!(app.world().get::<FilmPace>(plate).is_some());
    assert_eq!(app.world().get::<FilmClock>(plate).expect("a clock").steps, 0);
}

#[test]
fn flakes_fall_land_and_vanish() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 12, quick_coating());
    let debris = CoatingDebris { floor: Some(-1.0), lifetime: 2.0, most: 5, ..CoatingDebris::default() };
    app.world_mut().entity_mut(plate).insert(debris);
    wait_for_films(&mut app, 1);
    app.update();
    let at = middle(&app, plate);
    app.world_mut().commands().entity(plate).hit(at, 0.4, 30.0);
    app.update();
    let flakes = |app: &mut App| -> Vec<(Flake, Transform, AssetId<Mesh>)> {
        let mut flakes = app.world_mut().query::<(&Flake, &Transform, &Mesh3d)>();
        flakes.iter(app.world()).map(|(flake, at, mesh)| (*flake, *at, mesh.0.id())).collect()
    };
    let born = flakes(&mut app);
    assert_eq!(born.len(), 5, "no more than the coating allows");
    for (flake, at_flake, mesh) in &born {
        assert!(at_flake.translation.distance(at) < 0.6 && flake.root == plate && flake.size > 0.0);
        let mesh = app.world().resource::<Assets<Mesh>>().get(*mesh).expect("a mesh of its own");
        assert!(mesh.attribute(Mesh::ATTRIBUTE_UV_0).is_some() && mesh.count_vertices() >= 3);
    }
    let (mut lowest, mut highest) = (f32::MAX, f32::MIN);
    let mut frames = 0;
    while !flakes(&mut app).is_empty() {
        for (flake, at, _) in flakes(&mut app) {
            lowest = lowest.min(at.translation.y);
            highest = highest.max(at.translation.y);
            assert!(at.translation.is_finite() && flake.velocity.is_finite());
        }
        app.update();
        frames += 1;
        assert!(frames < 10_000, "they never vanish");
    }
    assert!(lowest >= -1.0 - 1e-4 && lowest < at.y - 0.2, "{lowest} to {highest}");
    let before = app.world().resource::<Assets<Mesh>>().len();
    app.update();
    assert!(app.world().resource::<Assets<Mesh>>().len() <= before, "meshes go with their flakes");
}

#[test]
fn observers_of_a_prop_hear_what_happens_to_its_films() {
    #[derive(Resource, Default)]
    struct Heard(Vec<&'static str>);
    let mut app = app();
    app.init_resource::<Heard>();
    let root = app.world_mut().spawn((Transform::default(), Visibility::default(), quick_coating())).id();
    let mesh = add_mesh(&mut app, plate(12));
    app.world_mut().spawn((Mesh3d(mesh), ChildOf(root)));
    app.world_mut()
        .entity_mut(root)
        .observe(|_: On<FilmReady>, mut heard: ResMut<Heard>| heard.0.push("ready"))
        .observe(|_: On<PieceFallen>, mut heard: ResMut<Heard>| heard.0.push("piece"))
        .observe(|_: On<FilmRepainted>, mut heard: ResMut<Heard>| heard.0.push("painted"));
    wait_for_films(&mut app, 1);
    app.update();
    assert_eq!(app.world().resource::<Heard>().0, ["ready"]);
    app.world_mut().commands().entity(root).hit(Vec3::new(0.5, 0.5, 0.0), 0.3, 20.0);
    app.update();
    app.update();
    app.world_mut().commands().entity(root).repaint(Vec3::new(0.5, 0.5, 0.0), 9.0);
    app.update();
    app.update();
    let heard = &app.world().resource::<Heard>().0;
    assert!(heard.len() > 2 && heard[1] == "piece" && heard.last() == Some(&"painted"), "{heard:?}");
}
