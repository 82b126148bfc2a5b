//! Heat maps over films, without a GPU.

use bevy::{mesh::VertexAttributeValues, prelude::*};
use bevy_coating::{
    CoatingPart, HeatMapView,
    film::FilmMesh,
    heat::{HeatMap, HeatRange},
    prelude::*,
};

use crate::common::*;

fn app_with_materials() -> App {
    let mut app = app();
    app.init_asset::<Image>().init_asset::<StandardMaterial>();
    app
}

fn spawn_prop(app: &mut App) -> Entity {
    let material = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial::default());
    let mesh = add_mesh(app, plate(10));
    app.world_mut().spawn((Mesh3d(mesh), MeshMaterial3d(material), quick_coating().with_seed(1))).id()
}

/// Entities that draw heat maps, with their meshes, in the order of their parents.
fn heat_maps(app: &mut App) -> Vec<(Entity, Entity, AssetId<Mesh>)> {
    let world = app.world_mut();
    let mut parts = world.query_filtered::<(Entity, &Name, &ChildOf, &Mesh3d), With<CoatingPart>>();
    let found = parts.iter(world).filter(|(_, name, ..)| name.as_str() == "heat map");
    let mut found: Vec<_> = found.map(|(part, _, parent, mesh)| (parent.parent(), part, mesh.0.id())).collect();
    found.sort();
    found
}

fn floats<const N: usize>(mesh: &Mesh, attribute: bevy::mesh::MeshVertexAttribute) -> Vec<[f32; N]> {
    let values: Vec<f32> = match mesh.attribute(attribute) {
        Some(VertexAttributeValues::Float32x3(values)) => values.as_flattened().to_vec(),
        Some(VertexAttributeValues::Float32x4(values)) => values.as_flattened().to_vec(),
        other => panic!("{other:?}"),
    };
    values.as_chunks::<N>().0.to_vec()
}

fn colors(app: &mut App) -> Vec<[f32; 4]> {
    let (_, _, mesh) = heat_maps(app)[0];
    floats(app.world().resource::<Assets<Mesh>>().get(mesh).expect("a mesh"), Mesh::ATTRIBUTE_COLOR)
}

#[test]
fn a_heat_map_comes_and_goes_and_leaves_everything_as_it_was() {
    let mut app = app_with_materials();
    let film = spawn_prop(&mut app);
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 60);
    app.update();
    let drawn = |app: &App| {
        let film = app.world().entity(film);
        let children = film.get::<Children>().map(|children| children.to_vec()).unwrap_or_default();
        (film.get::<Mesh3d>().cloned(), film.get::<MeshMaterial3d<StandardMaterial>>().cloned(), children)
    };
    let before = drawn(&app);
    assert!(heat_maps(&mut app).is_empty());
    app.world_mut().entity_mut(film).insert(HeatMapView::new(HeatMap::Adhesion));
    app.update();
    let shown = heat_maps(&mut app);
    assert_eq!(shown.len(), 1);
    assert_eq!(drawn(&app).0, before.0, "the same mesh");
    let state = film_state(&app, film);
    let live = state.mesh.topology.live_faces().count();
    let mesh = app.world().resource::<Assets<Mesh>>().get(shown[0].2).expect("a mesh").clone();
    assert_eq!(mesh.count_vertices(), 3 * live);
    // It lies just over the film, wherever that has curled to.
    let places: Vec<[f32; 3]> = floats(&mesh, Mesh::ATTRIBUTE_POSITION);
    let film_places = state.mesh.topology.live_faces().flat_map(|f| state.mesh.topology.corners(f));
    for (shown, v) in places.iter().zip(film_places) {
        let apart = Vec3::from(*shown).distance(state.mesh.geometry.positions[v.index()]);
        assert!(apart < 0.03 * state.mesh.geometry.mean_edge, "{apart}");
    }
    app.world_mut().entity_mut(film).remove::<HeatMapView>();
    app.update();
    assert!(heat_maps(&mut app).is_empty());
    assert_eq!(drawn(&app), before);
}

#[test]
fn colours_follow_the_film_and_rest_when_it_does() {
    let mut app = app_with_materials();
    let film = spawn_prop(&mut app);
    app.world_mut().entity_mut(film).insert(HeatMapView::new(HeatMap::Separation));
    wait_for_films(&mut app, 1);
    app.update();
    let fresh = colors(&mut app);
    take_steps(&mut app, 10);
    let later = colors(&mut app);
    assert_ne!(fresh, later, "what is to come has come nearer");
    let (.., mesh) = heat_maps(&mut app)[0];
    app.update();
    messages::<AssetEvent<Mesh>>(&mut app);
    for _ in 0..5 {
        app.update();
        let events = messages::<AssetEvent<Mesh>>(&mut app);
        assert!(!events.iter().any(|event| event.is_modified(mesh)), "nothing has changed: {events:?}");
    }
    // Another range, and another map.
    let narrow =
        HeatMapView { range: Some(HeatRange { min: 0.0, max: 0.05 }), ..HeatMapView::new(HeatMap::Separation) };
    app.world_mut().entity_mut(film).insert(narrow);
    app.update();
    assert_ne!(colors(&mut app), later);
    app.world_mut().entity_mut(film).insert(HeatMapView::new(HeatMap::Rain));
    app.update();
    let exposed = colors(&mut app);
    assert!(exposed.iter().all(|color| *color == exposed[0]), "it rains alike everywhere");
}

#[test]
fn a_film_with_a_heat_map_is_drawn_by_its_own_triangles() {
    let mut app = app_with_materials();
    let film = spawn_prop(&mut app);
    app.world_mut().get_mut::<Coating>(film).expect("paint").detail.level = 2;
    wait_for_films(&mut app, 1);
    let triangles = |app: &App| {
        let shown = &app.world().get::<Mesh3d>(film).expect("a mesh").0;
        triangles_of(app.world().resource::<Assets<Mesh>>().get(shown).expect("an asset")).len()
    };
    let faces = app.world().get::<FilmMesh>(film).expect("a film").topology.face_count();
    update_until(&mut app, |app| triangles(app) == 16 * faces);
    app.world_mut().entity_mut(film).insert(HeatMapView::new(HeatMap::Strain));
    update_until(&mut app, |app| triangles(app) == faces);
    app.world_mut().entity_mut(film).remove::<HeatMapView>();
    update_until(&mut app, |app| triangles(app) == 16 * faces);
}

#[test]
fn a_view_on_a_film_counts_before_that_of_its_coating() {
    let mut app = app_with_materials();
    let root = app.world_mut().spawn((Transform::default(), Visibility::default(), quick_coating())).id();
    let mut films = Vec::new();
    for (i, x) in [0.0, 2.0].into_iter().enumerate() {
        let material = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial::default());
        let mesh = add_mesh(&mut app, plate(6));
        let prop = (Mesh3d(mesh), MeshMaterial3d(material), Transform::from_xyz(x, 0.0, 0.0), Name::new(i.to_string()));
        films.push(app.world_mut().spawn((prop, ChildOf(root))).id());
    }
    wait_for_films(&mut app, 2);
    app.world_mut().entity_mut(root).insert(HeatMapView::new(HeatMap::Rain));
    app.world_mut().entity_mut(films[1]).insert(HeatMapView::new(HeatMap::Sources));
    app.update();
    let mut parents: Vec<Entity> = heat_maps(&mut app).iter().map(|(parent, ..)| *parent).collect();
    parents.sort_by_key(|parent| films.iter().position(|film| film == parent));
    assert_eq!(parents, films);
    let meshes = app.world().resource::<Assets<Mesh>>();
    let first = |mesh| floats::<4>(meshes.get(mesh).expect("a mesh"), Mesh::ATTRIBUTE_COLOR)[0];
    let maps: Vec<AssetId<Mesh>> = {
        let world = app.world();
        let children = |film: &Entity| world.get::<Children>(*film).expect("children").to_vec();
        films.iter().flat_map(children).filter_map(|child| Some(world.get::<Mesh3d>(child)?.0.id())).collect()
    };
    assert_ne!(first(maps[0]), first(maps[1]), "all the rain, and no rust");
    // The coating goes, and with it every map.
    app.world_mut().entity_mut(root).remove::<Coating>();
    app.update();
    app.update();
    assert!(heat_maps(&mut app).is_empty());
}

#[test]
fn a_clone_has_a_heat_map_of_its_own() {
    let mut app = app_with_materials();
    let film = spawn_prop(&mut app);
    wait_for_films(&mut app, 1);
    app.world_mut().entity_mut(film).insert(HeatMapView::new(HeatMap::Strain));
    take_steps(&mut app, 50);
    let clone = app.world_mut().entity_mut(film).clone_and_spawn();
    wait_for_films(&mut app, 2);
    for _ in 0..3 {
        app.update();
    }
    let shown = heat_maps(&mut app);
    let mut parents: Vec<Entity> = shown.iter().map(|(parent, ..)| *parent).collect();
    parents.sort();
    let mut expected = vec![film, clone];
    expected.sort();
    assert_eq!(parents, expected);
    assert_ne!(shown[0].2, shown[1].2, "each its own mesh");
}
