//! Films of several meshes: meshes that leave, are swapped or excluded, and glass.

use bevy::prelude::*;
use bevy_coating::{CoatedBy, CoatingPart, film::FilmMesh, prelude::*};

use crate::common::*;

fn mesh_of(app: &App, entity: Entity) -> Handle<Mesh> {
    app.world().get::<Mesh3d>(entity).expect("a mesh").0.clone()
}

fn films(app: &mut App) -> Vec<Entity> {
    app.world_mut().query_filtered::<Entity, (With<FilmMesh>, With<CoatedBy>)>().iter(app.world()).collect()
}

fn update(app: &mut App, frames: u32) {
    (0..frames).for_each(|_| app.update());
}

/// Spawns a node with two primitives, side by side, and returns it with them.
fn spawn_pair(app: &mut App, coating: Coating) -> (Entity, [Entity; 2]) {
    let meshes = [plate(6), plate(6).translated_by(Vec3::X)].map(|mesh| add_mesh(app, mesh));
    let node = app.world_mut().spawn((Transform::default(), Visibility::default(), coating)).id();
    let primitives = meshes.map(|mesh| app.world_mut().spawn((Mesh3d(mesh), ChildOf(node))).id());
    (node, primitives)
}

#[test]
fn a_despawned_primitive_leaves_no_ghost_and_the_others_go_on() {
    let mut app = app();
    let (node, [first, second]) = spawn_pair(&mut app, quick_coating());
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 80);
    let shown = mesh_of(&app, second);
    app.world_mut().entity_mut(first).despawn();
    update(&mut app, 2);
    assert_eq!(films(&mut app), [node]);
    assert_eq!(film_state(&app, node).clock.steps, 80, "the film is the same");
    assert_eq!(mesh_of(&app, second), shown);
    // Nothing falls off what is not there.
    messages::<PieceFallen>(&mut app);
    take_steps(&mut app, 60);
    let fallen = messages::<PieceFallen>(&mut app);
    assert!(fallen.iter().all(|piece| piece.position.x > 0.9), "{fallen:?}");
    film_state(&app, node).validate().expect("a sound film");
    app.world_mut().entity_mut(second).despawn();
    update(&mut app, 2);
    assert!(films(&mut app).is_empty(), "a film without meshes is taken off");
    assert!(app.world().get::<CoatedBy>(node).is_none());
    assert_eq!(app.world_mut().query::<&CoatingPart>().iter(app.world()).count(), 0);
}

#[test]
fn a_primitive_despawned_during_the_build_is_left_out() {
    let mut app = app();
    let (node, [first, second]) = spawn_pair(&mut app, quick_coating());
    app.update();
    app.world_mut().entity_mut(first).despawn();
    wait_for_films(&mut app, 1);
    assert_eq!(films(&mut app), [second]);
    assert!(app.world().get::<CoatedBy>(node).is_none());
    assert_eq!(film_state(&app, second).mesh.topology.face_count(), 72);
}

#[test]
fn swapped_levels_of_detail_do_not_pile_up() {
    let mut app = app();
    let (node, mut level) = spawn_pair(&mut app, quick_coating());
    wait_for_films(&mut app, 1);
    for n in [3, 5, 4] {
        take_steps(&mut app, 20);
        level.iter().for_each(|&mesh| app.world_mut().entity_mut(mesh).despawn());
        let meshes = [plate(n), plate(n).translated_by(Vec3::X)].map(|mesh| add_mesh(&mut app, mesh));
        level = meshes.map(|mesh| app.world_mut().spawn((Mesh3d(mesh), ChildOf(node))).id());
        update_until(&mut app, |app| {
            let films = films(app);
            let faces = |&film: &Entity| app.world().get::<FilmMesh>(film).map(|film| film.topology.face_count());
            films.iter().filter_map(faces).sum::<usize>() == (4 * n * n) as usize
        });
        update(&mut app, 3);
        let films = films(&mut app);
        assert!(films == [node] || films.len() == 2, "{films:?}");
    }
}

#[test]
fn an_excluded_mesh_is_not_coated() {
    let mut app = app();
    let (node, [first, second]) = spawn_pair(&mut app, quick_coating());
    app.world_mut().entity_mut(first).insert(CoatingExclude);
    let own = mesh_of(&app, first);
    wait_for_films(&mut app, 1);
    assert_eq!(films(&mut app), [second]);
    // What is included later is coated, and what is excluded later gets its own mesh back.
    app.world_mut().entity_mut(first).remove::<CoatingExclude>();
    wait_for_films(&mut app, 2);
    assert_ne!(mesh_of(&app, first), own);
    app.world_mut().entity_mut(first).insert(CoatingExclude);
    update(&mut app, 3);
    assert_eq!(mesh_of(&app, first), own);
    assert_eq!(films(&mut app), [second]);
    // All below an excluded node is excluded, but a coating below it counts.
    app.world_mut().entity_mut(second).insert(quick_coating());
    app.world_mut().entity_mut(node).remove::<Coating>().insert((Transform::default(), CoatingExclude));
    update(&mut app, 3);
    update_until(&mut app, |app| films(app) == [second]);
    assert!(messages::<FilmFailed>(&mut app).is_empty(), "none of this is a fault");
    assert_eq!(app.world().resource::<CoatingStatus>().refused, 0);
}

#[cfg(feature = "render")]
#[test]
fn glass_is_left_alone_and_the_rest_ages() {
    let mut app = app();
    app.init_asset::<StandardMaterial>();
    let material = |app: &mut App, material: StandardMaterial| {
        app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(material)
    };
    let paint = material(&mut app, Color::srgb(0.5, 0.1, 0.1).into());
    let blended = StandardMaterial { alpha_mode: AlphaMode::Blend, ..Color::srgba(0.9, 1.0, 1.0, 0.2).into() };
    let pane = material(&mut app, blended);
    let lens = material(&mut app, StandardMaterial { specular_transmission: 0.9, ..StandardMaterial::default() });
    let (node, [first, second]) = spawn_pair(&mut app, quick_coating());
    let third = add_mesh(&mut app, plate(6).translated_by(Vec3::X * 2.0));
    let third = app.world_mut().spawn((Mesh3d(third), MeshMaterial3d(lens), ChildOf(node))).id();
    app.world_mut().entity_mut(first).insert(MeshMaterial3d(paint));
    app.world_mut().entity_mut(second).insert(MeshMaterial3d(pane.clone()));
    let own = [second, third].map(|glass| mesh_of(&app, glass));
    wait_for_films(&mut app, 1);
    update(&mut app, 5);
    assert_eq!(films(&mut app), [first]);
    assert_eq!([second, third].map(|glass| mesh_of(&app, glass)), own);
    assert!(messages::<FilmFailed>(&mut app).is_empty(), "glass is no fault");
    let status = app.world().resource::<CoatingStatus>();
    assert_eq!((status.refused, status.waiting), (0, 0));
    // A pane that is painted over is coated.
    let painted = StandardMaterial::from(Color::BLACK);
    app.world_mut().resource_mut::<Assets<StandardMaterial>>().insert(&pane, painted).expect("a handle");
    wait_for_films(&mut app, 2);
    let mut both = vec![first, second];
    both.sort_unstable();
    let mut found = films(&mut app);
    found.sort_unstable();
    assert_eq!(found, both);
}

#[cfg(feature = "render")]
#[test]
fn glass_that_is_coated_itself_is_refused_with_a_reason() {
    let mut app = app();
    app.init_asset::<StandardMaterial>();
    let glass = StandardMaterial { specular_transmission: 0.5, ..StandardMaterial::default() };
    let glass = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(glass);
    let pane = spawn_plate(&mut app, 4, quick_coating());
    app.world_mut().entity_mut(pane).insert(MeshMaterial3d(glass));
    update_until(&mut app, |app| app.world().resource::<CoatingStatus>().refused == 1);
    let failed = messages::<FilmFailed>(&mut app);
    assert_eq!(failed.len(), 1);
    assert_eq!(failed[0].error.cause, CoatingFault::Transmissive);
}
