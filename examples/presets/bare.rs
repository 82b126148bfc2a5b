//! The cans, for ageing them where nothing can be drawn.

use crate::cans::{self, Can, cans};
use crate::cli::Options;
use crate::common_scene::bare::{Piece, plain_model};
use bevy_coating::bake::{BakeError, BakeOptions};

pub fn pieces(options: &Options) -> Result<Vec<Piece>, BakeError> {
    Ok(cans().map(|can| piece(&can, options)).collect())
}

fn piece(can: &Can, options: &Options) -> Piece {
    let model = plain_model(can.preset.name(), cans::shape().surface());
    let bake = BakeOptions {
        preset: can.preset.name().into(),
        settings: can.preset.into(),
        age: options.age,
        seed: can.coating(options).seed.unwrap_or_default(),
        ..BakeOptions::default()
    };
    Piece { name: format!("preset_{}", can.preset), model, options: bake }
}
