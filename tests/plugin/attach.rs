//! Coating and uncoating: groups, scenes, waiting, swapping, despawning, and meshes that cannot be coated.

use bevy::{
    asset::RenderAssetUsages,
    mesh::{Indices, PrimitiveTopology, VertexAttributeValues, skinning::SkinnedMesh},
    prelude::*,
};
use bevy_coating::{ATTRIBUTE_STAINS, CoatingPart, film::FilmMesh, prelude::*, surface::BuildError};

use crate::common::*;

fn films(app: &mut App) -> Vec<(Entity, Entity)> {
    let mut films: Vec<_> = app
        .world_mut()
        .query_filtered::<(Entity, &CoatedBy), With<FilmMesh>>()
        .iter(app.world())
        .map(|(film, coated_by)| (film, coated_by.0))
        .collect();
    films.sort_unstable();
    films
}

fn mesh_of(app: &App, entity: Entity) -> Handle<Mesh> {
    app.world().get::<Mesh3d>(entity).expect("a mesh").0.clone()
}

fn updates(app: &mut App, frames: u32) {
    for _ in 0..frames {
        app.update();
    }
}

#[test]
fn removing_the_coating_gives_everything_back() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 8, quick_coating());
    let own = mesh_of(&app, plate);
    let components = app.world().entity(plate).archetype().components().len();
    let meshes = app.world().resource::<Assets<Mesh>>().len();
    wait_for_films(&mut app, 1);
    assert_ne!(mesh_of(&app, plate), own);
    take_steps(&mut app, 80);
    app.world_mut().entity_mut(plate).remove::<Coating>();
    updates(&mut app, 3);
    assert_eq!(mesh_of(&app, plate), own);
    assert!(films(&mut app).is_empty());
    assert_eq!(app.world().resource::<Assets<Mesh>>().len(), meshes, "no mesh is left behind");
    assert_eq!(app.world_mut().query::<&CoatingPart>().iter(app.world()).count(), 0);
    // What is left beside the coating itself came with transforms and bounds, not from us.
    let left = app.world().entity(plate).archetype().components().len();
    assert!(left < components + 2, "{left} components, {components} at first");
    app.world_mut().entity_mut(plate).insert(quick_coating());
    wait_for_films(&mut app, 1);
    assert_eq!(film_state(&app, plate).clock.steps, 0, "a new coat of paint is fresh");
}

#[test]
fn removing_the_coating_during_the_build_is_no_error() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 8, quick_coating());
    let own = mesh_of(&app, plate);
    app.update();
    app.world_mut().entity_mut(plate).remove::<Coating>();
    updates(&mut app, 20);
    assert_eq!(mesh_of(&app, plate), own);
    assert_eq!(*app.world().resource::<CoatingStatus>(), CoatingStatus::default());
    assert!(app.world().get::<CoatedBy>(plate).is_none());
}

#[test]
fn primitives_of_a_node_share_a_film_and_others_do_not() {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(4));
    let far = add_mesh(&mut app, plate(4).translated_by(Vec3::new(1.0, 0.0, 0.0)));
    let root = app.world_mut().spawn((Transform::default(), quick_coating())).id();
    let node = app.world_mut().spawn((Transform::from_xyz(0.0, 2.0, 0.0), ChildOf(root))).id();
    let primitives = [&mesh, &far].map(|mesh| app.world_mut().spawn((Mesh3d(mesh.clone()), ChildOf(node))).id());
    let moved = (Mesh3d(mesh.clone()), Transform::from_xyz(0.0, 0.0, 5.0), ChildOf(node));
    let alone = app.world_mut().spawn(moved).id();
    let elsewhere = app.world_mut().spawn(Mesh3d(mesh.clone())).id();
    wait_for_films(&mut app, 2);
    updates(&mut app, 5);
    let mut expected = vec![(node, root), (alone, root)];
    expected.sort_unstable();
    assert_eq!(films(&mut app), expected);
    let film = film_state(&app, node);
    assert_eq!(film.mesh.topology.face_count(), 64);
    assert_eq!(film.mesh.topology.vertex_count(), 45, "welded where the primitives touch");
    for primitive in primitives {
        let shown = mesh_of(&app, primitive);
        let count = app.world().resource::<Assets<Mesh>>().get(&shown).and_then(|m| m.indices()).map(Indices::len);
        assert_eq!(count, Some(96), "each shows its own part");
    }
    assert_eq!(mesh_of(&app, elsewhere), mesh);
    app.world_mut().entity_mut(root).remove::<Coating>();
    updates(&mut app, 2);
    assert!(films(&mut app).is_empty());
    assert_eq!(primitives.map(|primitive| mesh_of(&app, primitive)), [mesh, far]);
}

#[test]
fn meshes_that_arrive_later_are_coated_and_those_that_leave_are_not() {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(4));
    let root = app.world_mut().spawn((Transform::default(), quick_coating())).id();
    updates(&mut app, 5);
    let late = app.world_mut().spawn((Mesh3d(mesh.clone()), ChildOf(root))).id();
    wait_for_films(&mut app, 1);
    assert_eq!(films(&mut app), [(late, root)]);
    app.world_mut().entity_mut(late).remove::<ChildOf>();
    updates(&mut app, 3);
    assert!(films(&mut app).is_empty());
    assert_eq!(mesh_of(&app, late), mesh);
    app.world_mut().entity_mut(late).insert(ChildOf(root));
    wait_for_films(&mut app, 1);
    let inner = app.world_mut().entity_mut(late).insert(quick_coating().with_seed(9)).id();
    update_until(&mut app, |app| films(app) == [(inner, inner)]);
    app.world_mut().entity_mut(inner).remove::<Coating>();
    update_until(&mut app, |app| films(app) == [(inner, root)]);
}

#[test]
fn meshes_that_are_not_loaded_are_waited_for() {
    let mut app = app();
    let handle = app.world().resource::<Assets<Mesh>>().reserve_handle();
    let plate_entity = app.world_mut().spawn((Mesh3d(handle.clone()), quick_coating())).id();
    updates(&mut app, 10);
    assert_eq!(app.world().resource::<CoatingStatus>().waiting, 1);
    app.world_mut().resource_mut::<Assets<Mesh>>().insert(&handle, plate(4)).expect("a reserved handle");
    wait_for_films(&mut app, 1);
    assert_eq!(films(&mut app), [(plate_entity, plate_entity)]);
    assert_eq!(app.world().resource::<CoatingStatus>().waiting, 0);
}

#[test]
fn a_handle_swapped_during_or_after_the_build_is_followed() {
    let mut app = app();
    let plate_entity = spawn_plate(&mut app, 8, quick_coating());
    app.update();
    for n in [4, 5] {
        let other = add_mesh(&mut app, plate(n));
        app.world_mut().entity_mut(plate_entity).insert(Mesh3d(other.clone()));
        let faces = (2 * n * n) as usize;
        update_until(&mut app, |app| {
            app.world().get::<FilmMesh>(plate_entity).is_some_and(|film| film.topology.face_count() == faces)
        });
        app.world_mut().entity_mut(plate_entity).remove::<Coating>();
        updates(&mut app, 2);
        assert_eq!(mesh_of(&app, plate_entity), other, "the new mesh is its own");
        app.world_mut().entity_mut(plate_entity).insert(quick_coating());
        wait_for_films(&mut app, 1);
    }
    assert!(messages::<FilmFailed>(&mut app).is_empty());
}

#[test]
fn despawning_at_any_time_is_no_error() {
    let mut app = app();
    for frames in [0, 1, 2, 40] {
        let root = app.world_mut().spawn((Transform::default(), quick_coating())).id();
        let (mesh, other) = (add_mesh(&mut app, plate(6)), add_mesh(&mut app, plate(4).translated_by(Vec3::X * 2.0)));
        let primitives = [mesh, other].map(|mesh| app.world_mut().spawn((Mesh3d(mesh), ChildOf(root))).id());
        updates(&mut app, frames);
        app.world_mut().entity_mut(primitives[0]).despawn();
        updates(&mut app, frames);
        // There is one film, on the entity of the mesh that is left or on that of the node. It shows that mesh alone
        // and goes on ageing.
        update_until(&mut app, |app| app.world().resource::<CoatingStatus>().waiting == 0 && !films(app).is_empty());
        let [film] = films(&mut app)[..] else { panic!("after {frames} frames: {:?}", films(&mut app)) };
        assert!(film == (primitives[1], root) || film == (root, root), "after {frames} frames: {film:?}");
        let shown = app.world().resource::<Assets<Mesh>>().get(&mesh_of(&app, primitives[1])).expect("a mesh").clone();
        assert_eq!(shown.indices().map(Indices::len), Some(96), "after {frames} frames");
        let before = film_state(&app, film.0).clock.steps;
        take_steps(&mut app, 20);
        assert_eq!(film_state(&app, film.0).clock.steps, before + 20);
        app.world_mut().entity_mut(root).despawn();
        updates(&mut app, 3);
        assert!(films(&mut app).is_empty(), "after {frames} frames");
        assert_eq!(app.world_mut().query::<&CoatingPart>().iter(app.world()).count(), 0);
    }
    let status = app.world().resource::<CoatingStatus>();
    assert_eq!((status.waiting, status.refused, status.films), (0, 0, 0));
}

/// A film that has taken 50 steps, and its coating changed by `change`; nothing has been updated since.
fn changed(change: impl FnOnce(&mut Coating)) -> (App, Entity) {
    let mut app = app();
    let plate = spawn_plate(&mut app, 6, quick_coating().with_seed(3));
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 50);
    messages::<FilmReady>(&mut app);
    change(&mut app.world_mut().get_mut::<Coating>(plate).expect("a coating"));
    (app, plate)
}

#[test]
fn changes_of_seven_fields_are_followed_without_a_new_film() {
    let pace = |app: &App, film| app.world().get::<bevy_coating::FilmPace>(film).expect("a film").clone();
    let shown =
        |app: &App, film| app.world().resource::<Assets<Mesh>>().get(&mesh_of(app, film)).expect("a mesh").clone();
    let followed = |change: fn(&mut Coating), is_followed: &dyn Fn(&App, Entity) -> bool| {
        let (mut app, plate) = changed(change);
        assert!(!is_followed(&app, plate), "nothing can have happened yet");
        updates(&mut app, 2);
        assert!(messages::<FilmReady>(&mut app).is_empty(), "there is no need for a new film");
        assert_eq!(film_state(&app, plate).clock.steps, 50);
        is_followed(&app, plate)
    };
    assert!(followed(|c| c.rate = 3.0, &|app, film| pace(app, film).rate == 3.0), "rate");
    assert!(followed(|c| c.paused = true, &|app, film| pace(app, film).paused), "paused");
    let is_high = |app: &App, film| pace(app, film).quality == SolverQuality::High;
    assert!(followed(|c| c.quality = SolverQuality::High, &is_high), "quality");
    let is_gentle = |app: &App, film| *pace(app, film).settings == Preset::Gentle.into();
    assert!(followed(|c| c.settings = Preset::Gentle.into(), &is_gentle), "settings");
    let is_plain = |app: &App, film| !shown(app, film).contains_attribute(ATTRIBUTE_STAINS);
    assert!(followed(|c| c.stain_display = StainDisplay::None, &is_plain), "stain_display");
    // The others need something to be seen.
    let (mut app, plate) = changed(|c| c.stain_display = StainDisplay::VertexColor);
    app.update();
    let before = shown(&app, plate);
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").shading.stains.dust = Vec3::Y;
    app.update();
    let colors = |mesh: &Mesh| match mesh.attribute(Mesh::ATTRIBUTE_COLOR) {
        Some(VertexAttributeValues::Float32x4(colors)) => colors.clone(),
        other => panic!("{other:?}"),
    };
    assert_ne!(colors(&shown(&app, plate)), colors(&before), "shading");
    let (mut app, plate) = changed(|c| c.shelter = Shelter::Given);
    app.update();
    app.insert_resource(CoatingWeather { rain: Vec3::NEG_Z, ..CoatingWeather::default() });
    take_steps(&mut app, 1);
    assert_eq!(film_state(&app, plate).clock.steps, 51, "shelter: no ray is waited for");
}

#[test]
fn changes_of_the_other_fields_are_followed_by_a_new_film() {
    let rebuilt = |change: fn(&mut Coating)| {
        let (mut app, plate) = changed(change);
        update_until(&mut app, |app| !messages::<FilmReady>(app).is_empty());
        film_state(&app, plate)
    };
    let mut app = app();
    let plate = spawn_plate(&mut app, 6, quick_coating().with_seed(8));
    wait_for_films(&mut app, 1);
    let seeded = rebuilt(|c| *c = c.clone().with_seed(8));
    assert_eq!(seeded.digest(), film_state(&app, plate).digest(), "seed");
    let coarse = rebuilt(|c| c.resolution = FilmResolution::Triangles(30));
    assert!(coarse.clock.steps == 0 && coarse.mesh.topology.face_count() < 60, "resolution");
    assert_eq!(rebuilt(|c| c.start_age = 0.2).clock.steps, 20, "start_age");
    let finer = rebuilt(|c| c.steps_per_age = 200);
    assert_eq!((finer.clock.steps, finer.clock.steps_per_age), (0, 200), "steps_per_age");
}

#[test]
fn removing_and_inserting_the_coating_starts_over() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 6, quick_coating());
    wait_for_films(&mut app, 1);
    let fresh = film_state(&app, plate).digest();
    take_steps(&mut app, 50);
    let coating = app.world_mut().entity_mut(plate).take::<Coating>().expect("a coating");
    app.world_mut().entity_mut(plate).insert(coating);
    assert!(app.world().get::<FilmClock>(plate).is_none());
    update_until(&mut app, |app| app.world().get::<FilmClock>(plate).is_some());
    assert_eq!(film_state(&app, plate).digest(), fresh);
}

#[test]
fn settings_can_be_an_asset() {
    let mut app = app();
    let handle = app.world().resource::<Assets<CoatingSettings>>().reserve_handle();
    let coating = Coating { settings: handle.clone().into(), ..quick_coating() };
    let plate = spawn_plate(&mut app, 6, coating);
    updates(&mut app, 10);
    assert_eq!(app.world().resource::<CoatingStatus>().waiting, 1, "settings are waited for");
    let mut settings = CoatingSettings::default();
    settings.adhesion.decay = 2.5;
    let insert = |app: &mut App, settings: &CoatingSettings| {
        let mut assets = app.world_mut().resource_mut::<Assets<CoatingSettings>>();
        assets.insert(&handle, settings.clone()).expect("a reserved handle");
    };
    insert(&mut app, &settings);
    wait_for_films(&mut app, 1);
    let decay = |app: &App| app.world().get::<bevy_coating::FilmPace>(plate).expect("a film").settings.adhesion.decay;
    assert_eq!(decay(&app), 2.5);
    settings.adhesion.decay = 3.5;
    insert(&mut app, &settings);
    updates(&mut app, 3);
    assert_eq!(decay(&app), 3.5, "a reloaded file is followed");
    settings.adhesion.decay = f32::NAN;
    insert(&mut app, &settings);
    updates(&mut app, 3);
    assert_eq!(decay(&app), 3.5, "but not into nonsense");
}

/// Spawns `mesh` with a coating, expects it to be refused, and gives the reason.
fn refusal(mesh: Mesh, coating: Coating, more: impl Bundle) -> CoatingFault {
    let mut app = app();
    let handle = add_mesh(&mut app, mesh);
    let entity = app.world_mut().spawn((Mesh3d(handle.clone()), coating, more)).id();
    // A mesh that was added in the frame before is looked at twice, and messages last two frames.
    let mut failed = Vec::new();
    update_until(&mut app, |app| {
        failed.extend(messages::<FilmFailed>(app));
        app.world().resource::<CoatingStatus>().refused == 1
    });
    assert_eq!(failed.len(), 1, "told once: {failed:?}");
    assert_eq!((failed[0].entity, failed[0].root, failed[0].error.entity), (entity, entity, entity));
    assert!(failed[0].error.to_string().contains(&entity.to_string()), "{}", failed[0].error);
    assert_eq!(mesh_of(&app, entity), handle, "the prop keeps its own mesh");
    assert!(films(&mut app).is_empty() && app.world().get::<CoatedBy>(entity).is_none());
    updates(&mut app, 5);
    assert!(messages::<FilmFailed>(&mut app).is_empty(), "and is left in peace");
    let good = add_mesh(&mut app, plate(3));
    app.world_mut().entity_mut(entity).remove::<SkinnedMesh>().insert((Mesh3d(good), quick_coating()));
    wait_for_films(&mut app, 1);
    failed[0].error.cause.clone()
}

fn with_positions(positions: Vec<[f32; 3]>) -> Mesh {
    plate(2).with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
}

#[test]
fn meshes_that_cannot_be_coated_are_refused_with_a_reason() {
    let mut positions = plate_positions();
    positions[4] = [f32::NAN, 0.0, 0.0];
    let cause = refusal(with_positions(positions), quick_coating(), ());
    assert!(matches!(cause, CoatingFault::Build(BuildError::NonFinitePosition { vertex: 4, .. })), "{cause:?}");

    let mesh = plate(2).with_inserted_indices(Indices::U32(vec![0, 1, 9]));
    let cause = refusal(mesh, quick_coating(), ());
    let expected = BuildError::IndexOutOfRange { triangle: 0, vertex: 9, vertices: 9 };
    assert_eq!(cause, CoatingFault::Build(expected));

    let cause = refusal(plate(2).with_inserted_indices(Indices::U16(vec![])), quick_coating(), ());
    assert_eq!(cause, CoatingFault::Build(BuildError::NoTriangles));

    let cause = refusal(with_positions(vec![[1.0; 3]; 9]), quick_coating(), ());
    assert!(matches!(cause, CoatingFault::Build(BuildError::AllDegenerate { .. })), "{cause:?}");

    let cause = refusal(plate(2).with_removed_attribute(Mesh::ATTRIBUTE_POSITION), quick_coating(), ());
    assert_eq!(cause, CoatingFault::NoPositions);

    let mut extracted = plate(2);
    extracted.asset_usage = RenderAssetUsages::RENDER_WORLD;
    extracted.take_gpu_data().expect("the data");
    assert_eq!(refusal(extracted, quick_coating(), ()), CoatingFault::RenderWorldOnly);

    let lines = Mesh::new(PrimitiveTopology::LineList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, plate_positions());
    assert_eq!(refusal(lines, quick_coating(), ()), CoatingFault::NotTriangles(PrimitiveTopology::LineList));

    assert_eq!(refusal(plate(2), quick_coating(), SkinnedMesh::default()), CoatingFault::Skinned);
}

#[test]
fn coatings_out_of_range_are_refused_with_a_reason() {
    let mut settings = CoatingSettings::default();
    settings.tearing.alpha = 7.0;
    let cause = refusal(plate(2), Coating { settings: settings.into(), ..quick_coating() }, ());
    assert!(cause.to_string().contains("tearing.alpha"), "{cause}");
    let cause = refusal(plate(2), quick_coating().with_rate(f64::NAN), ());
    assert!(matches!(cause, CoatingFault::Field { field: "rate", .. }), "{cause:?}");
    let cause = refusal(plate(2), quick_coating().with_start_age(-1.0), ());
    assert!(matches!(cause, CoatingFault::Field { field: "start_age", .. }), "{cause:?}");
    let cause = refusal(plate(2), quick_coating().with_steps_per_age(0), ());
    assert!(matches!(cause, CoatingFault::Field { field: "steps_per_age", .. }), "{cause:?}");
    let cause = refusal(plate(2), quick_coating().with_triangles(0), ());
    assert!(matches!(cause, CoatingFault::Build(BuildError::Resolution { .. })), "{cause:?}");
}

#[test]
fn a_flattened_prop_is_refused() {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(2));
    app.world_mut().spawn((Mesh3d(mesh), Transform::from_scale(Vec3::new(1.0, 0.0, 1.0)), quick_coating()));
    update_until(&mut app, |app| app.world().resource::<CoatingStatus>().refused == 1);
    let failed = messages::<FilmFailed>(&mut app);
    assert!(matches!(failed[0].error.cause, CoatingFault::Scale(..)), "{failed:?}");
}

fn plate_positions() -> Vec<[f32; 3]> {
    match plate(2).attribute(Mesh::ATTRIBUTE_POSITION) {
        Some(VertexAttributeValues::Float32x3(positions)) => positions.clone(),
        other => panic!("{other:?}"),
    }
}
