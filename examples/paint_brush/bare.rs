//! The sheet, for ageing it where nothing can be drawn. Bake has no brush, so strokes become masks.

use crate::cli::Options;
use crate::common_scene::bare::Piece;
use crate::strokes::{is_on_sheet, strokes};
use bevy_coating::bake::{BakeError, BakeOptions, Images, Input, TestPiece};
use bevy_coating::masks::{CoatingMask, CustomMask, Mask, MaskEffect, Span};
use bevy_coating::prelude::SettingsSource;
use bevy_coating::remesh::FilmResolution;
use bevy_coating::touch::{Change, Effect};

pub fn pieces(options: &Options) -> Result<Vec<Piece>, BakeError> {
    let model = Input::Piece(TestPiece::Plate, options.triangles).read(options.scene.seed, Images::Load)?;
    let coating = options.coating();
    let SettingsSource::Inline(settings) = coating.settings else { return Ok(Vec::new()) };
    let masks = strokes().into_iter().filter_map(|stroke| {
        let Effect::Adhesion(Change::Multiply(factor)) = stroke.effect else { return None };
        let places: Vec<_> = stroke.places.into_iter().filter(|at| is_on_sheet(*at)).collect();
        let radius = stroke.radius;
        let mask = CustomMask::new(move |position, _| {
            let far = places.iter().map(|at| at.distance(position.truncate())).fold(f32::INFINITY, f32::min);
            if far < radius { 1.0 } else { 0.0 }
        });
        Some(CoatingMask {
            mask: Mask::Custom(mask),
            effect: MaskEffect { adhesion: Span(1.0, factor), ..MaskEffect::default() },
        })
    });
    let bake = BakeOptions {
        resolution: FilmResolution::Keep,
        settings,
        age: options.age,
        seed: options.scene.seed,
        masks: masks.collect(),
        ..BakeOptions::default()
    };
    Ok(vec![Piece { name: "paint_brush_sheet".into(), model, options: bake }])
}
