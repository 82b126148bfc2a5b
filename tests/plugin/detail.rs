//! Films that are shown finer than they are simulated.

use bevy::{mesh::VertexAttributeValues, prelude::*};
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
        let triangles = shown.indices().expect("triangles").len() / 3;
        assert_eq!(triangles, live << (2 * level), "at level {level}");
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
