//! The cans, for ageing them where nothing can be drawn.

use crate::cans::{self, Can, cans};
use crate::cli::Options;
use crate::common_scene::bare::Piece;
use bevy_coating::bake::{BakeError, BakeOptions, Model, ModelMesh, Slot};

pub fn pieces(options: &Options) -> Result<Vec<Piece>, BakeError> {
    Ok(cans().map(|can| piece(&can, options)).collect())
}

fn piece(can: &Can, options: &Options) -> Piece {
    let mut model = Model { origin: can.preset.name().into(), ..Model::default() };
    let material = Some(model.materials.add_plain_paint());
    let slots = vec![Slot { material, uvs: true, ..Slot::default() }];
    let (name, surface) = (can.preset.name().into(), cans::shape().surface());
    model.meshes.push(ModelMesh { name, surface, slots, ..ModelMesh::default() });
    let bake = BakeOptions {
        preset: can.preset.name().into(),
        settings: can.preset.into(),
        age: options.age,
        seed: can.coating(options).seed.unwrap_or_default(),
        ..BakeOptions::default()
    };
    Piece { name: format!("preset_{}", can.preset), model, options: bake }
}
