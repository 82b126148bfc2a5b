//! Plates with stains of any kind, and pictures of them read place by place.
#![allow(dead_code, reason = "each test binary uses its part")]

use std::path::PathBuf;

use bevy::{
    asset::RenderAssetUsages,
    math::ops,
    mesh::{Indices, PrimitiveTopology},
    prelude::*,
};
use bevy_coating::{ATTRIBUTE_REST, ATTRIBUTE_REST_NORMAL, ATTRIBUTE_STAINS, StainedMaterial};

use crate::studio::Picture;

/// A square plate about the origin in the xy plane, facing +z, `side` metres wide, of `n` by `n` squares.
pub fn stained_plate(side: f32, n: u32, stains: impl Fn(Vec3) -> [f32; 4]) -> Mesh {
    let at = |i: u32| (i as f32 / n as f32 - 0.5) * side;
    let points: Vec<Vec3> = (0..(n + 1) * (n + 1)).map(|i| Vec3::new(at(i % (n + 1)), at(i / (n + 1)), 0.0)).collect();
    let positions: Vec<[f32; 3]> = points.iter().map(|p| p.to_array()).collect();
    let uvs: Vec<[f32; 2]> = points.iter().map(|p| [p.x / side + 0.5, 0.5 - p.y / side]).collect();
    let stains: Vec<[f32; 4]> = points.iter().map(|&p| stains(p)).collect();
    let square = |i: u32| {
        let a = i % n + i / n * (n + 1);
        [a, a + 1, a + n + 2, a, a + n + 2, a + n + 1]
    };
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, vec![[0.0, 0.0, 1.0f32]; positions.len()])
        .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, uvs)
        .with_inserted_attribute(ATTRIBUTE_STAINS, stains)
        .with_inserted_attribute(ATTRIBUTE_REST, positions.clone())
        .with_inserted_attribute(ATTRIBUTE_REST_NORMAL, vec![[0.0, 0.0, 1.0f32]; positions.len()])
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_indices(Indices::U32((0..n * n).flat_map(square).collect()))
}

/// Spawns `mesh` with `material` at the origin.
pub fn spawn_stained(app: &mut App, mesh: Mesh, material: StainedMaterial) -> Entity {
    let mesh = app.world_mut().resource_mut::<Assets<Mesh>>().add(mesh);
    let material = app.world_mut().resource_mut::<Assets<StainedMaterial>>().add(material);
    app.world_mut().spawn((Mesh3d(mesh), MeshMaterial3d(material))).id()
}

impl Picture {
    /// Places in the xy plane that the pixels of a picture show, taken from `eye` on the z axis, with the size of a
    /// pixel there.
    pub fn places(&self, eye: f32) -> impl Iterator<Item = (Vec3, f32, [u8; 4])> {
        let size = 2.0 * ops::tan(crate::studio::FIELD_OF_VIEW * 0.5) * eye / self.height as f32;
        let (width, height) = (self.width as f32, self.height as f32);
        self.pixels.iter().enumerate().map(move |(i, &pixel)| {
            let (x, y) = ((i as u32 % self.width) as f32 + 0.5, (i as u32 / self.width) as f32 + 0.5);
            (Vec3::new((x - 0.5 * width) * size, (0.5 * height - y) * size, 0.0), size, pixel)
        })
    }
}

/// Leaves a picture in the folder `COATING_PICTURES`, if it is set.
pub fn save(picture: &Picture, name: &str) {
    let Some(folder) = std::env::var_os("COATING_PICTURES").map(PathBuf::from) else { return };
    std::fs::create_dir_all(&folder).expect("a folder");
    picture.save(&folder.join(format!("{name}.png")));
}
