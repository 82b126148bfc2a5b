//! The props, for ageing them where nothing can be drawn.

use crate::cli::Options;
use crate::common_scene::bare::Piece;
use crate::common_scene::graphics;
use crate::props::{PROPS, Prop};
use bevy_coating::bake::{BakeError, BakeOptions, Carried, Images, Input, Model};
use std::path::Path;

pub fn pieces(options: &Options) -> Result<Vec<Piece>, BakeError> {
    let piece = |prop: &Prop| {
        let file = Path::new(graphics::ASSETS).join(prop.file);
        let mut model = Input::File(file).read(options.scene.seed, Images::Load)?;
        enlarge(&mut model, prop.scale);
        let coating = options.coating(options.rules, prop.seed);
        let bake = BakeOptions {
            resolution: coating.resolution,
            preset: options.preset.0.clone(),
            settings: options.settings(options.rules),
            age: options.ages.iter().copied().fold(0.0, f64::max),
            seed: coating.seed.unwrap_or_default(),
            ..BakeOptions::default()
        };
        Ok(Piece { name: format!("one_scale_{}", prop.name), model, options: bake })
    };
    PROPS.iter().map(piece).collect()
}

/// Gives a toy its own size; of what it was read from nothing else is kept.
fn enlarge(model: &mut Model, scale: f32) {
    model.carried = Carried::default();
    for mesh in &mut model.meshes {
        mesh.surface.positions.iter_mut().for_each(|position| *position *= scale);
        mesh.origin *= scale;
        mesh.place = None;
    }
}
