//! Backs of flakes, bare metal, and materials, without a GPU.

use bevy::{
    asset::AsAssetId,
    camera::visibility::RenderLayers,
    light::NotShadowCaster,
    mesh::VertexAttributeValues,
    pbr::Material,
    prelude::*,
    render::render_resource::{AsBindGroup, Face},
};
use bevy_coating::{CoatingPart, prelude::*};

use crate::common::*;

/// The app with standard materials, but nothing to draw them.
fn app_with_materials() -> App {
    let mut app = app();
    app.init_asset::<Image>().init_asset::<StandardMaterial>();
    app
}

fn add_material(app: &mut App, material: StandardMaterial) -> MeshMaterial3d<StandardMaterial> {
    MeshMaterial3d(app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(material))
}

fn spawn_painted(app: &mut App, material: StandardMaterial, more: impl Bundle) -> Entity {
    let material = add_material(app, material);
    let mesh = add_mesh(app, plate(10));
    app.world_mut().spawn((Mesh3d(mesh), material, quick_coating().with_seed(1), more)).id()
}

/// The parts below `film`: name, mesh and material.
fn parts(app: &mut App, film: Entity) -> Vec<(String, Mesh, StandardMaterial, Entity)> {
    let mut query = app
        .world_mut()
        .query_filtered::<(Entity, &Name, &Mesh3d, &MeshMaterial3d<StandardMaterial>, &ChildOf), With<CoatingPart>>();
    let world = app.world();
    let (meshes, materials) = (world.resource::<Assets<Mesh>>(), world.resource::<Assets<StandardMaterial>>());
    let mut parts: Vec<_> = query
        .iter(world)
        .filter(|(.., parent)| parent.parent() == film)
        .map(|(entity, name, mesh, material, _)| {
            let mesh = meshes.get(mesh.as_asset_id()).expect("a mesh").clone();
            let material = materials.get(material.as_asset_id()).expect("a material").clone();
            (name.to_string(), mesh, material, entity)
        })
        .collect();
    parts.sort_by(|a, b| a.0.cmp(&b.0));
    parts
}

#[test]
fn backs_and_metal_come_with_the_first_separation_and_go_with_the_coating() {
    let mut app = app_with_materials();
    let layers = RenderLayers::layer(3);
    let film = spawn_painted(&mut app, StandardMaterial::default(), (layers.clone(), NotShadowCaster));
    wait_for_films(&mut app, 1);
    app.update();
    assert!(parts(&mut app, film).is_empty(), "fresh paint has neither");
    let materials = app.world().resource::<Assets<StandardMaterial>>().len();
    take_steps(&mut app, 80);
    let found = parts(&mut app, film);
    assert_eq!(found.iter().map(|part| part.0.as_str()).collect::<Vec<_>>(), ["bare metal", "paint backs"]);
    let state = film_state(&app, film);
    let topology = &state.mesh.topology;
    let separated = |f: &_| topology.corners(*f).iter().any(|&v| !state.forces.is_attached(v));
    let backs = topology.live_faces().filter(separated).count();
    let gone = topology.face_count() - topology.live_faces().count();
    let triangles = |mesh: &Mesh| triangles_of(mesh).len();
    assert_eq!((triangles(&found[0].1), triangles(&found[1].1)), (backs + gone, backs));
    assert!(found[0].1.contains_attribute(Mesh::ATTRIBUTE_COLOR), "patches of rust");
    for (name, _, material, entity) in &found {
        assert_eq!(material.cull_mode, Some(Face::Back), "{name}");
        assert_eq!(app.world().get::<RenderLayers>(*entity), Some(&layers), "{name}");
        assert!(app.world().get::<NotShadowCaster>(*entity).is_some(), "{name}");
    }
    let backs = |app: &mut App| -> Vec<[f32; 4]> {
        match parts(app, film)[1].1.attribute(Mesh::ATTRIBUTE_COLOR) {
            Some(VertexAttributeValues::Float32x4(colors)) => colors.clone(),
            _ => panic!("without a renderer, colours carry it"),
        }
    };
    let grey = backs(&mut app);
    app.world_mut().get_mut::<Coating>(film).expect("a coating").shading.primer = Color::BLACK.into();
    app.update();
    let black = backs(&mut app);
    let sum = |c: &[f32; 4]| c[0] + c[1] + c[2];
    // Rust hides it here and there.
    let darker = grey.iter().zip(&black).filter(|(grey, black)| sum(black) < 0.9 * sum(grey)).count();
    assert!(darker * 2 > grey.len(), "{darker} of {}", grey.len());
    app.world_mut().entity_mut(film).remove::<Coating>();
    for _ in 0..3 {
        app.update();
    }
    assert!(parts(&mut app, film).is_empty());
    assert_eq!(app.world().resource::<Assets<StandardMaterial>>().len(), materials);
    assert_eq!(app.world().resource::<Assets<Mesh>>().len(), 1);
}

#[test]
fn a_prop_that_appears_aged_has_its_parts_at_once() {
    let mut app = app_with_materials();
    let film = spawn_painted(&mut app, StandardMaterial::default(), ());
    let coating = quick_coating().with_seed(1).with_start_age(0.8);
    app.world_mut().entity_mut(film).insert((coating, Transform::from_xyz(3.0, 0.0, 0.0)));
    app.world_mut().resource_mut::<CoatingClock>().paused = true;
    update_until(&mut app, |app| app.world().get::<FilmClock>(film).is_some());
    let found = parts(&mut app, film);
    assert_eq!(found.len(), 2);
    for (name, .., entity) in found {
        let place = app.world().get::<GlobalTransform>(entity).expect("a place").translation();
        assert_eq!(place, Vec3::new(3.0, 0.0, 0.0), "{name} is in its place from the first frame on");
    }
}

#[test]
fn double_sided_props_have_double_sided_metal() {
    let mut app = app_with_materials();
    let sheet = StandardMaterial { cull_mode: None, double_sided: true, ..default() };
    let film = spawn_painted(&mut app, sheet, ());
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 60);
    let found = parts(&mut app, film);
    assert_eq!((found[0].2.cull_mode, found[0].2.double_sided), (None, true));
    assert_eq!(found[1].2.cull_mode, Some(Face::Back), "a back has one side");
}

#[derive(Asset, AsBindGroup, Reflect, Clone, Default)]
struct Glow {}

impl Material for Glow {}

#[test]
fn blended_and_custom_materials_are_refused() {
    let mut app = app_with_materials();
    app.init_asset::<Glow>().register_type::<MeshMaterial3d<Glow>>();
    let glass = StandardMaterial { alpha_mode: AlphaMode::Blend, ..default() };
    spawn_painted(&mut app, glass, ());
    update_until(&mut app, |app| app.world().resource::<CoatingStatus>().refused == 1);
    let failed = messages::<FilmFailed>(&mut app);
    assert_eq!(failed[0].error.cause, CoatingFault::AlphaBlended);
    let mesh = add_mesh(&mut app, plate(4));
    let glow = MeshMaterial3d(app.world_mut().resource_mut::<Assets<Glow>>().add(Glow {}));
    app.world_mut().spawn((Mesh3d(mesh), glow, quick_coating()));
    update_until(&mut app, |app| app.world().resource::<CoatingStatus>().refused == 2);
    let failed = messages::<FilmFailed>(&mut app);
    let CoatingFault::CustomMaterial { material } = &failed[0].error.cause else { panic!("{failed:?}") };
    assert!(material.ends_with("::Glow"), "{material}");
    let masked = StandardMaterial { alpha_mode: AlphaMode::Mask(0.5), ..default() };
    spawn_painted(&mut app, masked, ());
    wait_for_films(&mut app, 1);
}

#[test]
fn a_material_that_is_not_loaded_is_waited_for() {
    let mut app = app_with_materials();
    let handle = app.world().resource::<Assets<StandardMaterial>>().reserve_handle();
    let mesh = add_mesh(&mut app, plate(4));
    app.world_mut().spawn((Mesh3d(mesh), MeshMaterial3d(handle.clone()), quick_coating()));
    for _ in 0..10 {
        app.update();
    }
    assert_eq!(app.world().resource::<CoatingStatus>().waiting, 1);
    let mut materials = app.world_mut().resource_mut::<Assets<StandardMaterial>>();
    materials.insert(&handle, StandardMaterial::default()).expect("a reserved handle");
    wait_for_films(&mut app, 1);
}
