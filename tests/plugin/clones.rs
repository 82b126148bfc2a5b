//! Clones of coated props, and what is saved of them.

use bevy::{ecs::entity::EntityCloner, prelude::*};
use bevy_coating::{CoatedBy, CoatingPart, film::FilmMesh, prelude::*};

use crate::common::*;

/// Clones `entity` with everything below it.
fn clone_tree(app: &mut App, entity: Entity) -> Entity {
    let mut cloner = EntityCloner::build_opt_out(app.world_mut());
    cloner.linked_cloning(true);
    let mut cloner = cloner.finish();
    cloner.spawn_clone(app.world_mut(), entity)
}

fn mesh_of(app: &App, entity: Entity) -> Handle<Mesh> {
    app.world().get::<Mesh3d>(entity).expect("a mesh").0.clone()
}

fn update(app: &mut App, frames: u32) {
    (0..frames).for_each(|_| app.update());
}

#[test]
fn a_clone_has_a_film_of_its_own_in_the_same_state() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 8, quick_coating());
    let own = mesh_of(&app, plate);
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 60);
    let (before, shown) = (film_state(&app, plate).digest(), mesh_of(&app, plate));
    messages::<FilmReady>(&mut app);
    let clone = app.world_mut().entity_mut(plate).clone_and_spawn();
    app.update();
    assert_eq!(film_state(&app, clone).digest(), before, "in the very next frame");
    assert_ne!(mesh_of(&app, clone), shown, "with a mesh of its own");
    let mut ready = messages::<FilmReady>(&mut app);
    for _ in 0..100 {
        app.update();
        ready.extend(messages::<FilmReady>(&mut app));
    }
    assert_eq!(film_state(&app, plate).digest(), before, "the original does not notice");
    assert_eq!(mesh_of(&app, plate), shown);
    drop(shown);
    assert_eq!(ready.iter().map(|ready| ready.entity).collect::<Vec<_>>(), [clone]);
    assert_eq!(app.world().resource::<CoatingStatus>().films, 2);

    // Both go on alike, and each can go without the other.
    take_steps(&mut app, 30);
    assert_eq!(film_state(&app, clone).digest(), film_state(&app, plate).digest());
    let meshes = app.world().resource::<Assets<Mesh>>().len();
    app.world_mut().entity_mut(plate).despawn();
    update(&mut app, 2);
    take_steps(&mut app, 10);
    assert_eq!(film_state(&app, clone).clock.steps, 100);
    assert_eq!(app.world().resource::<Assets<Mesh>>().len(), meshes - 1);
    app.world_mut().entity_mut(clone).remove::<Coating>();
    update(&mut app, 2);
    assert_eq!(mesh_of(&app, clone), own, "and gets the prop's own mesh back");
}

#[test]
fn a_cloned_tree_has_films_of_its_own() {
    let mut app = app();
    let (mesh, far) = (add_mesh(&mut app, plate(4)), add_mesh(&mut app, plate(4).translated_by(Vec3::X)));
    let root = app.world_mut().spawn((Transform::default(), quick_coating())).id();
    let node = app.world_mut().spawn((Transform::from_xyz(0.0, 2.0, 0.0), ChildOf(root))).id();
    let primitives = [&mesh, &far].map(|mesh| app.world_mut().spawn((Mesh3d(mesh.clone()), ChildOf(node))).id());
    let alone = app.world_mut().spawn((Mesh3d(mesh.clone()), Transform::from_xyz(0.0, 0.0, 5.0), ChildOf(root))).id();
    wait_for_films(&mut app, 2);
    take_steps(&mut app, 70);
    let digests = [node, alone].map(|film| film_state(&app, film).digest());
    let clone = clone_tree(&mut app, root);
    update(&mut app, 5);
    let mut films: Vec<_> = app
        .world_mut()
        .query_filtered::<(Entity, &CoatedBy), With<FilmMesh>>()
        .iter(app.world())
        .filter(|(_, coated_by)| coated_by.0 == clone)
        .map(|(film, _)| film)
        .collect();
    films.sort_unstable();
    let mut found: Vec<String> = films.iter().map(|&film| film_state(&app, film).digest()).collect();
    found.sort();
    let mut expected = digests.to_vec();
    expected.sort();
    assert_eq!(found, expected, "one film for the clones of both primitives, and one for the other mesh");
    assert_eq!([node, alone].map(|film| film_state(&app, film).digest()), digests);
    assert_eq!(app.world().resource::<CoatingStatus>().films, 4);
    // Every primitive shows a mesh of its own.
    let mut shown: Vec<_> =
        app.world_mut().query_filtered::<&Mesh3d, Without<CoatingPart>>().iter(app.world()).map(|m| m.0.id()).collect();
    let count = shown.len();
    shown.sort_unstable();
    shown.dedup();
    assert_eq!((shown.len(), count), (6, 6));
    let _ = primitives;
}

#[test]
fn a_cloned_primitive_does_not_take_the_other_primitives_with_it() {
    let mut app = app();
    let (mesh, far) = (add_mesh(&mut app, plate(4)), add_mesh(&mut app, plate(4).translated_by(Vec3::X)));
    let root = app.world_mut().spawn((Transform::default(), quick_coating())).id();
    let [first, _] = [&mesh, &far].map(|mesh| app.world_mut().spawn((Mesh3d(mesh.clone()), ChildOf(root))).id());
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 70);
    let digest = film_state(&app, root).digest();
    let clone = app.world_mut().entity_mut(first).clone_and_spawn();
    update(&mut app, 5);
    assert_eq!(film_state(&app, root).digest(), digest);
    assert_eq!(film_state(&app, clone).clock.steps, 70);
    let count = |entity| {
        let mesh = app.world().resource::<Assets<Mesh>>().get(&mesh_of(&app, entity)).expect("an asset");
        mesh.indices().expect("indices").len()
    };
    assert_eq!(count(clone), count(first));
}

#[test]
fn clones_during_a_build_or_without_a_coating_start_from_the_props_own_mesh() {
    let mut app = app();
    let plate_entity = spawn_plate(&mut app, 8, quick_coating());
    let own = mesh_of(&app, plate_entity);
    app.update();
    let early = app.world_mut().entity_mut(plate_entity).clone_and_spawn();
    wait_for_films(&mut app, 2);
    take_steps(&mut app, 20);
    assert_eq!(film_state(&app, early).clock.steps, 20);
    let mut cloner = EntityCloner::build_opt_out(app.world_mut());
    cloner.deny::<Coating>();
    let bare = cloner.finish().spawn_clone(app.world_mut(), plate_entity);
    update(&mut app, 5);
    assert_eq!(mesh_of(&app, bare), own);
    assert!(app.world().get::<FilmMesh>(bare).is_none() && app.world().get::<CoatedBy>(bare).is_none());
    assert_eq!(app.world().resource::<CoatingStatus>().films, 2);
}

#[test]
fn inner_components_are_not_saved_with_a_scene() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 6, quick_coating());
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 60);
    let registry = app.world().resource::<AppTypeRegistry>().read();
    let saved: Vec<&str> = app
        .world()
        .entity(plate)
        .archetype()
        .components()
        .iter()
        .filter_map(|&id| app.world().components().get_info(id)?.type_id())
        .filter_map(|id| registry.get(id).filter(|r| r.data::<ReflectComponent>().is_some()))
        .map(|registration| registration.type_info().type_path())
        .filter(|path| path.contains("coating"))
        .collect();
    let mut saved = saved;
    saved.sort_unstable();
    let expected = ["coating::Coating", "links::CoatedMesh", "seed::CoatingSeed"];
    assert_eq!(saved, expected.map(|name| format!("bevy_coating::api::{name}")));
}
