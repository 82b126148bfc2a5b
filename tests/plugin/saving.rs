//! Films that are saved and put back, in games' own saves and in Bevy's scenes.

use bevy::{
    ecs::{entity::EntityHashMap, reflect::AppTypeRegistry},
    prelude::*,
    world_serialization::{DynamicWorldBuilder, serde::WorldDeserializer},
};
use bevy_coating::{
    CoatingPart, SaveError,
    film::FilmMesh,
    prelude::*,
    snapshot::{Snapshot, SnapshotError},
};
use serde::de::DeserializeSeed;

use crate::common::*;

fn digest(app: &App, film: Entity) -> String {
    film_state(app, film).digest()
}

fn saved(app: &App, prop: Entity) -> CoatingSnapshot {
    CoatingSnapshot::of(app.world(), prop).expect("films that can be saved")
}

#[test]
fn a_prop_that_is_spawned_as_it_was_saved_goes_on_as_if_it_had_never_been_away() {
    let mut app = app();
    // No seed: it is drawn from the place, and saved.
    let prop = spawn_plate(&mut app, 10, quick_coating());
    app.world_mut().entity_mut(prop).insert(Transform::from_xyz(3.0, 0.0, 1.0));
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 60);
    let (before, snapshot) = (digest(&app, prop), saved(&app, prop));
    take_steps(&mut app, 30);
    let after = digest(&app, prop);
    let text = ron::to_string(&snapshot).expect("text");
    let snapshot: CoatingSnapshot = ron::from_str(&text).expect("a snapshot");
    // In another app, at another place.
    let mut app = self::app();
    let mesh = add_mesh(&mut app, plate(10));
    let prop = app.world_mut().spawn((Mesh3d(mesh), quick_coating(), snapshot)).id();
    app.world_mut().entity_mut(prop).insert(CoatingHistory::default());
    wait_for_films(&mut app, 1);
    assert_eq!(digest(&app, prop), before);
    take_steps(&mut app, 30);
    assert_eq!(digest(&app, prop), after);
    assert!(messages::<RestoreFailed>(&mut app).is_empty());
    // For fresh paint the coating is taken off and put on again; what was saved goes with it.
    let coating = app.world_mut().entity_mut(prop).take::<Coating>().expect("a coating");
    app.update();
    app.world_mut().entity_mut(prop).insert(coating);
    wait_for_films(&mut app, 1);
    assert_eq!(film_state(&app, prop).clock.steps, 0);
}

#[test]
fn a_coating_that_moves_to_another_prop_takes_its_film_along_if_that_was_saved() {
    let mut app = app();
    let from = spawn_plate(&mut app, 10, quick_coating().with_seed(4));
    let mesh = add_mesh(&mut app, plate(10));
    let [with_film, without] = [0.0, 3.0].map(|x| {
        let at = Transform::from_xyz(x, 2.0, 0.0);
        app.world_mut().spawn((Mesh3d(mesh.clone()), at)).id()
    });
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 40);
    let (before, snapshot) = (digest(&app, from), saved(&app, from));
    let coating = app.world_mut().entity_mut(from).take::<Coating>().expect("a coating");
    app.world_mut().entity_mut(without).insert(coating.clone());
    app.world_mut().entity_mut(with_film).insert((coating, snapshot));
    wait_for_films(&mut app, 2);
    assert_eq!(digest(&app, with_film), before);
    assert_eq!(film_state(&app, without).clock.steps, 0);
    assert!(app.world().get::<FilmMesh>(from).is_none(), "it has its own mesh again");
}

#[test]
fn films_go_back_to_what_was_saved_while_the_game_runs() {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(8));
    let root = app.world_mut().spawn((Transform::default(), quick_coating())).id();
    let films = ["door", "door", "hood"].map(|name| {
        let at = Transform::from_xyz(1.0, 0.0, 0.0);
        app.world_mut().spawn((Name::new(name), Mesh3d(mesh.clone()), at, ChildOf(root))).id()
    });
    wait_for_films(&mut app, 3);
    take_steps(&mut app, 50);
    let before = films.map(|film| digest(&app, film));
    assert!(before[0] != before[1] && before[1] != before[2]);
    app.world_mut().commands().entity(root).save_films();
    take_steps(&mut app, 30);
    let after = films.map(|film| digest(&app, film));
    let snapshot = app.world().get::<CoatingSnapshot>(root).expect("a snapshot").clone();
    let paths: Vec<&str> = snapshot.films.iter().map(|film| film.path.as_str()).collect();
    assert_eq!(paths, ["door", "door#1", "hood"]);
    messages::<AgeReached>(&mut app);
    app.world_mut().commands().entity(root).restore_films(snapshot.clone());
    let mut reached = 0;
    update_until(&mut app, |app| {
        reached += messages::<AgeReached>(app).len();
        reached == 3
    });
    assert_eq!(films.map(|film| digest(&app, film)), before);
    take_steps(&mut app, 30);
    assert_eq!(films.map(|film| digest(&app, film)), after);

    // A film that was not saved, and one on another mesh: they stay as they are, and it is told of.
    let mut other = snapshot.clone();
    other.films.remove(1);
    let wrong = saved_plate(&mut self::app(), 5);
    other.films[1].state = wrong;
    app.world_mut().commands().entity(root).restore_films(other);
    let (mut failed, mut reached) = (Vec::new(), 0);
    update_until(&mut app, |app| {
        failed.extend(messages::<RestoreFailed>(app));
        reached += messages::<AgeReached>(app).len();
        failed.len() == 2 && reached == 1
    });
    let error = |film| &*failed.iter().find(|failed| failed.entity == film).expect("a failure").error;
    assert!(matches!(error(films[1]), SnapshotError::NoFilm { path } if path == "door#1"));
    assert!(matches!(error(films[2]), SnapshotError::OtherFilm { .. }), "{}", error(films[2]));
    assert_eq!(films.map(|film| digest(&app, film)), [&before[0], &after[1], &after[2]].map(String::clone));
    app.update();
    assert_eq!(app.world().resource::<CoatingStatus>().seeking, 0);
}

/// The film of a plate of `n` by `n` squares, saved.
fn saved_plate(app: &mut App, n: u32) -> Snapshot {
    let prop = spawn_plate(app, n, quick_coating());
    wait_for_films(app, 1);
    saved(app, prop).films[0].state.clone()
}

#[test]
fn what_cannot_be_saved_or_put_back_is_told() {
    let mut app = app();
    let nothing = app.world_mut().spawn_empty().id();
    let error = CoatingSnapshot::of(app.world(), nothing).expect_err("no coating");
    assert!(matches!(error, SaveError::NoCoating { .. }) && error.to_string().contains("Coating"), "{error}");
    let prop = spawn_plate(&mut app, 8, quick_coating());
    app.update();
    let error = CoatingSnapshot::of(app.world(), prop).expect_err("a film that is being built");
    assert!(matches!(error, SaveError::NotReady { .. }), "{error}");
    // The command warns, and that is all.
    app.world_mut().commands().entity(prop).save_films();
    app.update();
    assert!(app.world().get::<CoatingSnapshot>(prop).is_none());
    wait_for_films(&mut app, 1);
    // A prop that is spawned with the state of another mesh begins at its start age.
    let wrong = saved_plate(&mut self::app(), 5);
    let mut snapshot = saved(&app, prop);
    snapshot.films[0].state = wrong;
    let mesh = add_mesh(&mut app, plate(8));
    let coating = quick_coating().with_start_age(0.25);
    let other = app.world_mut().spawn((Mesh3d(mesh), coating, snapshot)).id();
    wait_for_films(&mut app, 2);
    let failed = messages::<RestoreFailed>(&mut app);
    assert_eq!(failed.iter().map(|failed| failed.entity).collect::<Vec<_>>(), [other]);
    assert!(matches!(&*failed[0].error, SnapshotError::OtherFilm { .. }), "{}", failed[0].error);
    assert_eq!(film_state(&app, other).clock.steps, 25);
}

#[test]
fn a_saved_scene_comes_back_with_its_films() {
    let mut app = app();
    let prop = spawn_plate(&mut app, 10, quick_coating());
    app.world_mut().entity_mut(prop).insert((Transform::from_xyz(1.0, 2.0, 3.0), Name::new("sign")));
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 70);
    let (before, own) = (digest(&app, prop), app.world().get::<bevy_coating::CoatedMesh>(prop).expect("own").0.clone());
    app.world_mut().commands().entity(prop).save_films();
    app.update();
    let scene = {
        let registry = app.world().resource::<AppTypeRegistry>().read();
        let children = app.world().get::<Children>(prop).into_iter().flatten().copied();
        let entities: Vec<Entity> = std::iter::once(prop).chain(children).collect();
        DynamicWorldBuilder::from_world(app.world(), &registry).extract_entities(entities.into_iter()).build()
    };
    take_steps(&mut app, 10);
    app.world_mut().entity_mut(prop).despawn();
    app.update();
    let registry = app.world().resource::<AppTypeRegistry>().clone();
    let mut map = EntityHashMap::default();
    scene.write_to_world(app.world_mut(), &mut map).expect("a world");
    let loaded = map[&prop];
    app.update();
    update_until(&mut app, |app| app.world().get::<FilmMesh>(loaded).is_some());
    assert_eq!(digest(&app, loaded), before);
    assert_eq!(app.world().get::<bevy_coating::CoatedMesh>(loaded).expect("its own mesh").0, own);
    let mut parts = app.world_mut().query_filtered::<&ChildOf, With<CoatingPart>>();
    assert!(parts.iter(app.world()).all(|parent| parent.0 == loaded));
    assert!(parts.iter(app.world()).count() <= 2, "the old parts are gone");

    // As text, without the meshes, which have no path: the game gives them.
    let text = {
        let registry = registry.read();
        let builder = DynamicWorldBuilder::from_world(app.world(), &registry).deny_all();
        let builder = builder.allow_component::<Coating>().allow_component::<CoatingSnapshot>();
        builder.extract_entity(loaded).build().serialize(&registry).expect("text")
    };
    assert!(text.contains("CoatingSnapshot") && !text.contains("FilmMesh"));
    let mut deserializer = ron::de::Deserializer::from_str(&text).expect("RON");
    let registry = registry.read();
    let mut server = app.world().resource::<AssetServer>().clone();
    let scene = WorldDeserializer { type_registry: &registry, load_from_path: &mut server };
    let scene = scene.deserialize(&mut deserializer).expect("a scene");
    drop(registry);
    let mut app = self::app();
    let mut map = EntityHashMap::default();
    scene.write_to_world(app.world_mut(), &mut map).expect("a world");
    let loaded = *map.values().next().expect("an entity");
    let mesh = add_mesh(&mut app, plate(10));
    app.world_mut().entity_mut(loaded).insert(Mesh3d(mesh));
    wait_for_films(&mut app, 1);
    assert_eq!(digest(&app, loaded), before);
}
