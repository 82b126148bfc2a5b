//! Encodes textures as PNG.

use bevy_math::UVec2;

use super::{
    sheet::Sheet,
    texture::{MAX_TEXELS, Texture},
};
use crate::bake::{model::Image, parallel};

/// A set of textures, encoded.
#[derive(Clone, Debug, Default)]
pub struct Encoded {
    pub base: Vec<u8>,
    pub surface: Vec<u8>,
    pub normals: Vec<u8>,
}

impl Encoded {
    /// Encodes a sheet. Alpha is left out where it means nothing.
    pub fn new(sheet: &Sheet) -> Self {
        type Job<'a> = (Box<dyn Fn() -> Vec<u8> + Send + 'a>, Vec<u8>);
        let size = sheet.size;
        let opaque = || sheet.base.iter().flat_map(|&[r, g, b, _]| [r, g, b]).collect::<Vec<u8>>();
        let base = move || match sheet.transparent {
            true => png(size, png::ColorType::Rgba, sheet.base.as_flattened()),
            false => png(size, png::ColorType::Rgb, &opaque()),
        };
        let mut jobs: [Job; 3] = [
            (Box::new(base), Vec::new()),
            (Box::new(move || png(size, png::ColorType::Rgb, sheet.surface.as_flattened())), Vec::new()),
            (Box::new(move || png(size, png::ColorType::Rgb, sheet.normals.as_flattened())), Vec::new()),
        ];
        parallel::for_each(&mut jobs, |(encode, file)| *file = encode());
        let [base, surface, normals] = jobs.map(|(_, file)| file);
        Self { base, surface, normals }
    }
}

/// A white image with the alpha of another; `None` if that cannot be decoded.
pub fn white_with_alpha(image: &Image) -> Option<Vec<u8>> {
    let texture = Texture::decode(image, true, MAX_TEXELS).ok()?;
    let texels: Vec<u8> = texture.pixels().iter().flat_map(|&[_, _, _, alpha]| [255, alpha]).collect();
    let UVec2 { x, y } = texture.size();
    Some(png_of([x, y], png::ColorType::GrayscaleAlpha, &texels))
}

fn png(size: u32, color: png::ColorType, bytes: &[u8]) -> Vec<u8> {
    png_of([size, size], color, bytes)
}

fn png_of([width, height]: [u32; 2], color: png::ColorType, bytes: &[u8]) -> Vec<u8> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width, height);
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    // A tenth larger than balanced, in a fifth of the time.
    encoder.set_compression(png::Compression::Fast);
    // The sizes fit, and writing to memory cannot fail.
    let _ = encoder.write_header().and_then(|mut writer| writer.write_image_data(bytes));
    file
}
