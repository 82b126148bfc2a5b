//! Writing in a scene: text drawn into a texture with the fonts that egui brings.

use bevy::asset::RenderAssetUsages;
use bevy::image::Image;
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};
use bevy_egui::egui::{self, Color32, FontId};

/// Height of a line, in texels.
const TEXELS: f32 = 72.0;

/// Fonts, ready to draw with.
pub struct Pen(egui::Context);

/// Text as a texture.
pub struct Label {
    pub image: Handle<Image>,
    /// Width for a height of 1.
    pub aspect: f32,
}

impl Default for Pen {
    fn default() -> Self {
        let context = egui::Context::default();
        // Fonts are there from the first pass on.
        let _ = context.run_ui(egui::RawInput::default(), |_| {});
        Self(context)
    }
}

impl Pen {
    /// Draws `text`, white on nothing.
    pub fn write(&self, text: &str, images: &mut Assets<Image>) -> Label {
        let (galley, atlas) = self.0.fonts_mut(|fonts| {
            let galley = fonts.layout_no_wrap(text.into(), FontId::proportional(TEXELS), Color32::WHITE);
            // After the layout, which draws what glyphs are new into it.
            (galley, fonts.image())
        });
        let size = galley.rect.size().ceil();
        let (width, height) = ((size.x as usize).max(1), (size.y as usize).max(1));
        let mut coverage = vec![0u8; width * height];
        for row in &galley.rows {
            // A glyph is a square of four corners: places in points, which are texels here, and in the atlas.
            for corners in row.visuals.mesh.vertices.chunks_exact(4) {
                let [first, .., last] = corners else { continue };
                let to = row.pos + first.pos.to_vec2();
                let (x, y) = (to.x.round() as usize, to.y.round() as usize);
                let [from, until] = [first.uv, last.uv].map(|uv| (uv.x.round() as usize, uv.y.round() as usize));
                for v in from.1..until.1 {
                    for u in from.0..until.0 {
                        let (column, line) = (x + u - from.0, y + v - from.1);
                        if column < width
                            && let Some(texel) = coverage.get_mut(line * width + column)
                            && let Some(ink) = atlas.pixels.get(v * atlas.size[0] + u)
                        {
                            *texel = (*texel).max(ink.a());
                        }
                    }
                }
            }
        }
        let data = coverage.into_iter().flat_map(|a| [255, 255, 255, a]).collect();
        let extent = Extent3d { width: width as u32, height: height as u32, depth_or_array_layers: 1 };
        let format = TextureFormat::Rgba8UnormSrgb;
        let image = Image::new(extent, TextureDimension::D2, data, format, RenderAssetUsages::RENDER_WORLD);
        Label { image: images.add(image), aspect: width as f32 / height as f32 }
    }
}
