//! What is shown follows the film, and assets are touched only when it changed.

use bevy::{
    asset::RenderAssetUsages,
    mesh::{Indices, MeshVertexAttribute, PrimitiveTopology, VertexAttributeValues, VertexFormat},
    prelude::*,
};
use bevy_coating::prelude::*;

use crate::common::*;

/// The mesh shown on `entity`.
fn shown(app: &App, entity: Entity) -> Mesh {
    let handle = &app.world().get::<Mesh3d>(entity).expect("a mesh").0;
    app.world().resource::<Assets<Mesh>>().get(handle).expect("an asset").clone()
}

fn positions(mesh: &Mesh) -> Vec<Vec3> {
    let values = mesh.attribute(Mesh::ATTRIBUTE_POSITION).and_then(VertexAttributeValues::as_float3);
    values.expect("positions").iter().map(|&p| Vec3::from_array(p)).collect()
}

/// Corner positions of each triangle.
fn triangles(mesh: &Mesh) -> Vec<[Vec3; 3]> {
    let positions = positions(mesh);
    triangles_of(mesh).into_iter().map(|t| t.map(|i| positions[i])).collect()
}

/// Updates, and counts the meshes that were touched.
fn modified_meshes(app: &mut App, frames: u32) -> usize {
    let mut modified = 0;
    for _ in 0..frames {
        app.update();
        let events = messages::<AssetEvent<Mesh>>(app);
        modified += events.iter().filter(|event| matches!(event, AssetEvent::Modified { .. })).count();
    }
    modified
}

#[test]
fn assets_are_touched_only_when_the_film_changed() {
    let mut app = app();
    let plates = [0, 1].map(|seed| spawn_plate(&mut app, 8, quick_coating().with_seed(seed).with_rate(seed as f64)));
    wait_for_films(&mut app, 2);
    modified_meshes(&mut app, 2);
    assert_eq!(modified_meshes(&mut app, 5), 0, "paused films touch nothing");
    let mut clock = app.world_mut().resource_mut::<CoatingClock>();
    (clock.paused, clock.age_per_second, clock.target_age) = (false, 1.0, Some(0.5));
    let modified = modified_meshes(&mut app, 20);
    assert!((5..=20).contains(&modified), "an ageing film is shown, once a frame: {modified}");
    assert_eq!(triangles(&shown(&app, plates[0])).len(), 128, "and the one of rate 0 is still whole");
    assert_eq!(modified_meshes(&mut app, 5), 0, "films at their target touch nothing");
}

#[test]
fn a_fresh_film_shows_the_props_own_triangles() {
    let mut app = app();
    let plate_entity = spawn_plate(&mut app, 7, quick_coating());
    wait_for_films(&mut app, 1);
    let (own, film) = (plate(7), shown(&app, plate_entity));
    let sorted = |mesh: &Mesh| {
        let mut corners: Vec<_> = triangles(mesh).concat().iter().map(|p| p.to_array().map(f32::to_bits)).collect();
        corners.sort_unstable();
        corners
    };
    assert_eq!(sorted(&film), sorted(&own));
    assert!(triangles(&film).iter().all(|[a, b, c]| (b - a).cross(c - a).z > 0.0), "wound alike");
    assert_eq!(film.count_vertices(), own.count_vertices(), "smooth and seamless: a vertex each");
    for attribute in [Mesh::ATTRIBUTE_NORMAL, Mesh::ATTRIBUTE_UV_0] {
        assert!(film.contains_attribute(attribute), "{}", attribute.name);
    }
    for attribute in [Mesh::ATTRIBUTE_UV_1, Mesh::ATTRIBUTE_TANGENT, Mesh::ATTRIBUTE_COLOR] {
        assert!(!film.contains_attribute(attribute), "{} is not the prop's", attribute.name);
    }
}

#[test]
fn what_is_shown_is_the_film_in_the_props_space() {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(10));
    for scale in [Vec3::ONE, Vec3::new(2.0, 0.5, 3.0), Vec3::new(-1.0, 1.0, 1.0)] {
        let bundle = (Mesh3d(mesh.clone()), Transform::from_scale(scale), quick_coating().with_seed(1));
        let entity = app.world_mut().spawn(bundle).id();
        wait_for_films(&mut app, 1);
        take_steps(&mut app, 90);
        let film = film_state(&app, entity);
        let topology = &film.mesh.topology;
        let (effective, ..) = GlobalTransform::from(Transform::from_scale(scale)).to_scale_rotation_translation();
        let triangles = triangles(&shown(&app, entity));
        assert_eq!(triangles.len(), topology.live_faces().count());
        assert!(triangles.len() < 200, "some fell");
        for (f, corners) in topology.live_faces().zip(&triangles) {
            for v in topology.corners(f) {
                let expected = film.mesh.geometry.positions[v.index()] / effective;
                assert!(corners.iter().any(|p| p.abs_diff_eq(expected, 1e-5)), "{scale}: face {f:?}");
            }
        }
        // Most film still looks out; in the mesh's own space it is wound as the mesh was.
        let out = triangles.iter().filter(|[a, b, c]| (b - a).cross(c - a).z > 0.0).count();
        assert!(out * 4 > triangles.len() * 3, "{scale}: {out} of {}", triangles.len());
        app.world_mut().entity_mut(entity).despawn();
        app.update();
    }
}

#[test]
fn strips_soup_and_compact_formats_are_read() {
    let square =
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 2.0, 0.0], [1.0, 2.0, 0.0f32]];
    let strip = Mesh::new(PrimitiveTopology::TriangleStrip, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, square.to_vec())
        .with_inserted_attribute(Mesh::ATTRIBUTE_COLOR, vec![[0.5, 0.25, 1.0, 1.0f32]; 6]);
    let restarted = strip.clone().with_inserted_indices(Indices::U16(vec![0, 1, 2, 3, u16::MAX, 2, 3, 4, 5]));
    let soup: Vec<[f32; 3]> = [0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5].map(|i| square[i]).to_vec();
    let compact = MeshVertexAttribute { format: VertexFormat::Unorm8x4, ..Mesh::ATTRIBUTE_COLOR };
    let colors = VertexAttributeValues::Unorm8x4(vec![[128, 64, 255, 255]; 12]);
    let soup = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, soup)
        .with_inserted_attribute(compact, colors);
    let mut app = app();
    for (name, mesh) in [("strip", strip), ("restarted strip", restarted), ("soup", soup)] {
        let mesh = add_mesh(&mut app, mesh);
        let entity = app.world_mut().spawn((Mesh3d(mesh), quick_coating())).id();
        wait_for_films(&mut app, 1);
        let film = film_state(&app, entity);
        assert_eq!((film.mesh.topology.face_count(), film.mesh.topology.vertex_count()), (4, 6), "{name}");
        let shown = shown(&app, entity);
        assert!(triangles(&shown).iter().all(|[a, b, c]| (b - a).cross(c - a).z > 0.0), "{name}: wound alike");
        let Some(VertexAttributeValues::Float32x4(colors)) = shown.attribute(Mesh::ATTRIBUTE_COLOR) else {
            panic!("{name}: no colours")
        };
        assert!(
            colors.iter().all(|c| (c[0] - 0.5).abs() < 0.01 && (c[1] - 0.25).abs() < 0.01 && c[2] == 1.0),
            "{name}"
        );
        app.world_mut().entity_mut(entity).despawn();
        app.update();
    }
}
