//! Props that were refused, and recover when the cause is mended.

use bevy::{
    mesh::{VertexAttributeValues, skinning::SkinnedMesh},
    prelude::*,
};
use bevy_coating::{film::FilmMesh, prelude::*};

use crate::common::*;

fn status(app: &App) -> &CoatingStatus {
    app.world().resource()
}

/// Updates until a prop is refused, and returns the cause, which must be told once.
fn refused(app: &mut App) -> CoatingFault {
    // Messages are kept for two frames only.
    let mut failed = Vec::new();
    update_until(app, |app| {
        failed.extend(messages::<FilmFailed>(app));
        status(app).refused == 1
    });
    for _ in 0..5 {
        failed.extend(messages::<FilmFailed>(app));
        app.update();
    }
    assert_eq!(failed.len(), 1, "{failed:?}");
    failed[0].error.cause.clone()
}

/// Updates until the prop has its film.
fn recovers(app: &mut App, prop: Entity) {
    update_until(app, |app| app.world().get::<FilmMesh>(prop).is_some());
    app.update();
    assert_eq!((status(app).refused, status(app).waiting), (0, 0));
    assert!(messages::<FilmFailed>(app).is_empty());
}

#[test]
fn a_mended_mesh_is_coated() {
    let mut app = app();
    let handle = add_mesh(&mut app, plate(3).with_removed_attribute(Mesh::ATTRIBUTE_POSITION));
    let prop = app.world_mut().spawn((Mesh3d(handle.clone()), quick_coating())).id();
    assert_eq!(refused(&mut app), CoatingFault::NoPositions);
    app.world_mut().resource_mut::<Assets<Mesh>>().insert(&handle, plate(3)).expect("a handle");
    recovers(&mut app, prop);
}

#[test]
fn a_mesh_that_is_mended_during_its_build_is_coated() {
    let mut app = app();
    // Large, so that its last vertex is looked at some frames after the build has begun.
    let mut broken = plate(700);
    if let Some(VertexAttributeValues::Float32x3(positions)) = broken.attribute_mut(Mesh::ATTRIBUTE_POSITION) {
        positions.last_mut().expect("a vertex")[0] = f32::NAN;
    }
    let handle = add_mesh(&mut app, broken);
    let prop = app.world_mut().spawn((Mesh3d(handle.clone()), quick_coating())).id();
    update_until(&mut app, |app| app.world().get::<CoatedBy>(prop).is_some());
    app.world_mut().resource_mut::<Assets<Mesh>>().insert(&handle, plate(3)).expect("a handle");
    update_until(&mut app, |app| app.world().get::<FilmMesh>(prop).is_some());
    assert_eq!(app.world().get::<FilmMesh>(prop).map(|film| film.topology.face_count()), Some(18));
}

#[test]
fn mended_settings_are_followed() {
    let mut app = app();
    let mut settings = CoatingSettings::default();
    settings.tearing.alpha = 7.0;
    let handle = app.world_mut().resource_mut::<Assets<CoatingSettings>>().add(settings);
    let prop = spawn_plate(&mut app, 4, Coating { settings: handle.clone().into(), ..quick_coating() });
    assert!(matches!(refused(&mut app), CoatingFault::Settings(_)));
    let mut settings = app.world_mut().resource_mut::<Assets<CoatingSettings>>();
    settings.insert(&handle, CoatingSettings::default()).expect("a handle");
    recovers(&mut app, prop);
}

#[test]
fn a_mended_coating_scale_or_skin_is_followed() {
    let mut app = app();
    let prop = spawn_plate(&mut app, 4, quick_coating().with_rate(f64::NAN));
    assert!(matches!(refused(&mut app), CoatingFault::Field { field: "rate", .. }));
    app.world_mut().get_mut::<Coating>(prop).expect("a coating").rate = 1.0;
    recovers(&mut app, prop);

    let mut app = self::app();
    let prop = spawn_plate(&mut app, 4, quick_coating());
    app.world_mut().entity_mut(prop).insert(Transform::from_scale(Vec3::new(1.0, 0.0, 1.0)));
    assert!(matches!(refused(&mut app), CoatingFault::Scale(..)));
    app.world_mut().entity_mut(prop).insert(Transform::from_scale(Vec3::splat(2.0)));
    recovers(&mut app, prop);

    let mut app = self::app();
    let prop = spawn_plate(&mut app, 4, quick_coating());
    app.world_mut().entity_mut(prop).insert(SkinnedMesh::default());
    assert_eq!(refused(&mut app), CoatingFault::Skinned);
    app.world_mut().entity_mut(prop).remove::<SkinnedMesh>();
    recovers(&mut app, prop);
}

#[test]
fn meshes_that_would_share_a_film_recover_together() {
    let mut app = app();
    let good = add_mesh(&mut app, plate(4));
    let bad = add_mesh(&mut app, plate(4).with_removed_attribute(Mesh::ATTRIBUTE_POSITION));
    let node = app.world_mut().spawn((Transform::default(), quick_coating())).id();
    app.world_mut().spawn((Mesh3d(good), ChildOf(node)));
    app.world_mut().spawn((Mesh3d(bad.clone()), ChildOf(node)));
    update_until(&mut app, |app| status(app).refused == 2);
    let mended = plate(4).translated_by(Vec3::X);
    app.world_mut().resource_mut::<Assets<Mesh>>().insert(&bad, mended).expect("a handle");
    recovers(&mut app, node);
    assert_eq!(film_state(&app, node).mesh.topology.face_count(), 64, "one film for both");
}

#[test]
fn a_coating_that_changes_all_the_time_is_not_refused_all_the_time() {
    let mut app = app();
    let handle = add_mesh(&mut app, plate(3).with_removed_attribute(Mesh::ATTRIBUTE_POSITION));
    let prop = app.world_mut().spawn((Mesh3d(handle), quick_coating())).id();
    assert_eq!(refused(&mut app), CoatingFault::NoPositions);
    for i in 0..50 {
        app.world_mut().get_mut::<Coating>(prop).expect("a coating").rate = 1.0 + f64::from(i) * 0.01;
        app.update();
    }
    assert!(messages::<FilmFailed>(&mut app).is_empty());
    assert_eq!((status(&app).refused, status(&app).waiting), (1, 0));
}
