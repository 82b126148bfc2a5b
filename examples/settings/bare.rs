//! The pieces, for ageing them where nothing can be drawn.

use crate::cli::Options;
use crate::common_scene::bare::{Piece, plain_model};
use crate::stage;
use bevy_coating::{
    bake::{BakeError, BakeOptions},
    prelude::CoatingSettings,
    stain::Environment,
};

pub fn pieces(options: &Options) -> Result<Vec<Piece>, BakeError> {
    let mut pieces = Vec::new();
    for page in options.pages() {
        let weather = page.weather();
        let environment = Environment { rain: weather.rain, sun: weather.sun, ..Environment::default() };
        for row in page.rows() {
            let settings = row.settings().expect("values that the unit test of the table has tried");
            for (word, (_, settings)) in ["low", "middle", "high"].into_iter().zip(settings) {
                let name = format!("settings_{}_{word}", row.path.replace('.', "_"));
                pieces.push(piece(name, settings, environment, options));
            }
        }
    }
    Ok(pieces)
}

fn piece(name: String, settings: CoatingSettings, environment: Environment, options: &Options) -> Piece {
    let model = plain_model(&name, stage::shape().surface());
    let (age, seed) = (options.age, options.scene.seed);
    Piece { name, model, options: BakeOptions { settings, age, seed, environment, ..BakeOptions::default() } }
}
