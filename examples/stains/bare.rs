//! The pieces, for ageing them where nothing can be drawn: a model for each row.

use crate::cli::Options;
use crate::common_scene::bare::Piece;
use crate::pieces;
use crate::stage;
use crate::weather;
use bevy_coating::{
    bake::{BakeError, BakeOptions},
    remesh::FilmResolution,
};

pub fn pieces(options: &Options) -> Result<Vec<Piece>, BakeError> {
    let mut models = Vec::new();
    for theme in options.themes() {
        // Nothing is known here of the roof.
        for row in theme.rows(options).into_iter().filter(|row| !row.roof) {
            let bake = BakeOptions {
                resolution: FilmResolution::Triangles(options.triangles.saturating_mul(4)),
                preset: options.preset.0.clone(),
                environment: weather::environment(&row),
                settings: row.settings,
                age: options.ages.iter().copied().fold(0.0, f64::max),
                seed: options.scene.seed,
                ..BakeOptions::default()
            };
            let name = format!("stains_{}_{}", theme.name(), row.name);
            models.push(Piece { name, model: pieces::model(stage::COLUMN)?, options: bake });
        }
    }
    Ok(models)
}
