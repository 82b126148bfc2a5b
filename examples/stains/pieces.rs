//! What is stained: a plate, a sphere, a cube with bevels, and a fire hydrant.

use crate::common_scene::graphics;
use crate::rounded_box::{Shape, rounded_box};
use bevy::gltf::GltfAssetLabel;
use bevy::prelude::*;
use bevy_coating::bake::{BakeError, Images, Input, Model, ModelMesh, Slot};
use std::path::Path;

const HYDRANT: &str = "props/prop_firehydrant.glb";
/// The hydrant is a toy; so it comes to the height of the others.
const HYDRANT_SCALE: f32 = 4.2;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece {
    Plate,
    Sphere,
    Cube,
    Hydrant,
}

impl Piece {
    /// From left to right.
    pub const ALL: [Self; 4] = [Self::Plate, Self::Sphere, Self::Cube, Self::Hydrant];

    pub fn name(self) -> &'static str {
        match self {
            Self::Plate => "plate",
            Self::Sphere => "sphere",
            Self::Cube => "cube",
            Self::Hydrant => "hydrant",
        }
    }

    /// Its form, standing on the ground; the hydrant's is in a file.
    fn shape(self) -> Option<Shape> {
        let (half, radius, segments) = match self {
            Self::Plate => (Vec3::new(0.45, 0.45, 0.025), 0.012, 1),
            Self::Sphere => (Vec3::splat(0.44), 0.44, 10),
            Self::Cube => (Vec3::splat(0.36), 0.05, 3),
            Self::Hydrant => return None,
        };
        Some(rounded_box(Vec3::Y * half.y, half, radius, segments))
    }

    /// How it stands on its place.
    pub fn stance(self) -> Transform {
        let turn = |degrees: f32| Transform::from_rotation(Quat::from_rotation_y(degrees.to_radians()));
        match self {
            Self::Plate => turn(-14.0),
            Self::Sphere => turn(35.0),
            Self::Cube => turn(-32.0),
            Self::Hydrant => turn(20.0).with_scale(Vec3::splat(HYDRANT_SCALE)),
        }
    }

    pub fn mesh(self, meshes: &mut Assets<Mesh>, assets: &AssetServer) -> Handle<Mesh> {
        match self.shape() {
            Some(shape) => meshes.add(shape.mesh()),
            None => assets.load(GltfAssetLabel::Primitive { mesh: 0, primitive: 0 }.from_asset(HYDRANT)),
        }
    }
}

/// All pieces side by side, `spacing` metres apart, as a model.
pub fn model(spacing: f32) -> Result<Model, BakeError> {
    let file = Path::new(graphics::ASSETS).join(HYDRANT);
    let mut model = Input::File(file).read(0, Images::Load)?;
    let material = Some(model.materials.add_plain_paint());
    let hydrants = std::mem::take(&mut model.meshes);
    for (column, piece) in Piece::ALL.into_iter().enumerate() {
        let stance = piece.stance();
        let place = Vec3::X * spacing * column as f32;
        match piece.shape() {
            Some(shape) => {
                let mut surface = shape.surface();
                surface.positions.iter_mut().for_each(|p| *p = stance.transform_point(*p));
                surface.normals.iter_mut().for_each(|n| *n = stance.rotation * *n);
                let slots = vec![Slot { material, uvs: true, ..Slot::default() }];
                let name = piece.name().into();
                model.meshes.push(ModelMesh { name, surface, slots, origin: place, ..ModelMesh::default() });
            }
            None => model.meshes.extend(hydrants.iter().cloned().map(|mut mesh| {
                mesh.surface.positions.iter_mut().for_each(|p| *p = stance.transform_point(*p));
                mesh.surface.normals.iter_mut().for_each(|n| *n = stance.rotation * *n);
                mesh.origin = place + stance.transform_point(mesh.origin);
                mesh
            })),
        }
    }
    Ok(model)
}
