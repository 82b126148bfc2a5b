//! The sign, for ageing it where nothing can be drawn.

use crate::cli::Options;
use crate::common_scene::bare::Piece;
use crate::common_scene::graphics;
use bevy_coating::{
    bake::{BakeError, BakeOptions, Images, Input},
    remesh::FilmResolution,
};
use std::path::Path;

pub fn pieces(options: &Options) -> Result<Vec<Piece>, BakeError> {
    let (preset, settings) = options.preset.clone();
    let bake = BakeOptions {
        // The plate has about half of the sign's surface.
        resolution: FilmResolution::Triangles(options.triangles.saturating_mul(2)),
        settings,
        preset,
        age: options.ages.iter().copied().fold(0.0, f64::max),
        seed: options.scene.seed,
        ..BakeOptions::default()
    };
    let sign = Path::new(graphics::ASSETS).join("city/street_sign.glb");
    let model = Input::File(sign).read(options.scene.seed, Images::Load)?;
    Ok(vec![Piece { name: "street_sign_aged".into(), model, options: bake }])
}
