//! The plates, for ageing them where nothing can be drawn.

use crate::cli::Options;
use crate::common_scene::bare::Piece;
use crate::plates::{Plate, plates};
use bevy_coating::bake::{BakeError, BakeOptions, Images, Input, TestPiece};
use bevy_coating::remesh::FilmResolution;

pub fn pieces(options: &Options) -> Result<Vec<Piece>, BakeError> {
    let piece = |plate: Plate| {
        let model = Input::Piece(TestPiece::Plate, plate.triangles).read(options.scene.seed, Images::Load)?;
        let bake = BakeOptions {
            resolution: FilmResolution::Keep,
            settings: plate.settings,
            age: options.ages.iter().copied().fold(0.0, f64::max),
            seed: options.scene.seed,
            ..BakeOptions::default()
        };
        Ok(Piece { name: format!("fineness_{}", plate.name), model, options: bake })
    };
    plates(options).into_iter().map(piece).collect()
}
