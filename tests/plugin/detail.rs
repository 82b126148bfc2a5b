//! Films that are shown finer than they are simulated.

use bevy::{
    camera::{CameraProjection, Viewport},
    mesh::VertexAttributeValues,
    prelude::*,
};
use bevy_coating::{CoatingFault, film::FilmMesh, prelude::*};

use crate::common::*;

/// A plate in an app whose paint is shown at a level, aged by `steps` steps.
fn aged(level: u32, steps: u64) -> (App, Entity) {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(8));
    let detail = Detail { level, ..Detail::default() };
    let plate = app.world_mut().spawn((Mesh3d(mesh), Coating { detail, ..quick_coating().with_seed(7) })).id();
    wait_for_films(&mut app, 1);
    take_steps(&mut app, steps);
    (app, plate)
}

fn mesh(app: &App, entity: Entity) -> &Mesh {
    let handle = &app.world().get::<Mesh3d>(entity).expect("a mesh").0;
    app.world().resource::<Assets<Mesh>>().get(handle).expect("an asset")
}

fn mesh_handle(app: &App, entity: Entity) -> Handle<Mesh> {
    app.world().get::<Mesh3d>(entity).expect("a mesh").0.clone()
}

fn positions(mesh: &Mesh) -> &[[f32; 3]] {
    mesh.attribute(Mesh::ATTRIBUTE_POSITION).and_then(VertexAttributeValues::as_float3).expect("positions")
}

#[test]
fn a_level_changes_what_is_shown_and_nothing_else() {
    let (coarse, plate) = aged(0, 120);
    let live = coarse.world().get::<FilmMesh>(plate).expect("a film").topology.live_faces().count();
    let digest = film_state(&coarse, plate).digest();
    for level in [1, 2, 3] {
        let (fine, plate) = aged(level, 120);
        assert_eq!(film_state(&fine, plate).digest(), digest, "the film is the same");
        let shown = mesh(&fine, plate);
        assert_eq!(triangles_of(shown).len(), live << (2 * level), "at level {level}");
        assert!(positions(shown).iter().flatten().all(|x| x.is_finite()));
        assert!(shown.attribute(Mesh::ATTRIBUTE_NORMAL).is_some_and(|n| n.len() == positions(shown).len()));
    }
}

#[test]
fn another_level_builds_the_display_again() {
    let (mut app, plate) = aged(0, 5);
    let before = positions(mesh(&app, plate)).len();
    app.world_mut().get_mut::<Coating>(plate).expect("paint").detail.level = 2;
    update_until(&mut app, |app| positions(mesh(app, plate)).len() > 4 * before);
}

/// A camera in front of the plate, whose image is 1,000 pixels high.
fn spawn_camera(app: &mut App, distance: f32) -> Entity {
    let viewport = Viewport { physical_size: UVec2::new(1500, 1000), ..default() };
    let mut camera = Camera { viewport: Some(viewport), ..default() };
    camera.computed.clip_from_view = PerspectiveProjection::default().get_clip_from_view();
    let at = Transform::from_xyz(0.0, 0.0, distance);
    app.world_mut().spawn((camera, at)).id()
}

#[test]
fn films_are_shown_as_finely_as_their_distance_asks_for() {
    let (mut app, plate) = aged(3, 60);
    messages::<FilmReady>(&mut app);
    let level = |app: &App| {
        let live = app.world().get::<FilmMesh>(plate).expect("a film").topology.live_faces().count();
        let triangles = triangles_of(mesh(app, plate)).len();
        (0..5u32).find(|level| triangles == live << (2 * level)).expect("whole faces")
    };
    assert_eq!(level(&app), 3, "without cameras it is shown at the finest level");
    let (alone, _) = aged(3, 100);
    let digest = film_state(&alone, plate).digest();
    let handle = mesh_handle(&app, plate);
    let camera = spawn_camera(&mut app, 400.0);
    update_until(&mut app, |app| level(app) == 0);
    let mut seen = Vec::new();
    for distance in [400.0, 60.0, 6.0, 0.7, 0.3, 6.0, 400.0] {
        app.world_mut().get_mut::<Transform>(camera).expect("a place").translation.z = distance;
        // It ages while another level is prepared.
        take_steps(&mut app, 5);
        for _ in 0..50 {
            app.update();
            std::thread::sleep(std::time::Duration::from_millis(2));
        }
        let (film, fine) = (film_state(&app, plate), level(&app));
        seen.push(fine);
        // Corners of faces are where the film has them, whatever the level.
        let shown = positions(mesh(&app, plate)).to_vec();
        let missing = film.mesh.topology.all_vertices().filter(|&v| film.mesh.topology.has_faces(v)).filter(|v| {
            let place = film.mesh.geometry.positions[v.index()];
            !shown.iter().any(|&p| Vec3::from_array(p).abs_diff_eq(place, 1e-5))
        });
        assert_eq!(missing.count(), 0, "at {distance} m, level {fine}");
    }
    assert!(seen[..5].is_sorted(), "nearer is finer: {seen:?}");
    assert!(seen[0] == 0 && seen[4] == 3 && seen[6] == 0, "{seen:?}");
    assert_eq!(mesh_handle(&app, plate), handle, "the mesh is the same asset");
    assert!(messages::<FilmReady>(&mut app).is_empty(), "no other film was built");
    take_steps(&mut app, 5);
    assert_eq!(film_state(&app, plate).clock.steps, 100);
    assert_eq!(film_state(&app, plate).digest(), digest, "what is shown changes nothing");
}

#[test]
fn a_lower_level_by_hand_needs_no_other_film() {
    let (mut app, plate) = aged(3, 40);
    messages::<FilmReady>(&mut app);
    let live = app.world().get::<FilmMesh>(plate).expect("a film").topology.live_faces().count();
    for level in [1, 0, 2, 3] {
        app.world_mut().get_mut::<Coating>(plate).expect("paint").detail.level = level;
        update_until(&mut app, |app| triangles_of(mesh(app, plate)).len() == live << (2 * level));
        assert_eq!(film_state(&app, plate).clock.steps, 40, "its age is kept");
    }
    assert!(messages::<FilmReady>(&mut app).is_empty());
}

#[test]
fn a_level_out_of_range_is_refused_and_the_prop_keeps_its_mesh() {
    let mut app = app();
    let own = add_mesh(&mut app, plate(8));
    let detail = Detail { level: 9, ..Detail::default() };
    let plate = app.world_mut().spawn((Mesh3d(own.clone()), Coating { detail, ..quick_coating() })).id();
    let mut failed = Vec::new();
    for _ in 0..10 {
        app.update();
        failed.extend(messages::<FilmFailed>(&mut app));
    }
    let causes: Vec<_> = failed.iter().map(|failed| failed.error.cause.clone()).collect();
    assert!(
        matches!(causes[..], [CoatingFault::Field { field: "detail.level", .. }]),
        "the field is named once: {causes:?}"
    );
    assert_eq!(app.world().get::<Mesh3d>(plate).expect("a mesh").0, own);
}
