//! Decodes texture images of the prop and samples them.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use bevy_math::{IVec2, UVec2, Vec2, Vec4, ops};
use zune_jpeg::{
    JpegDecoder,
    zune_core::{bytestream::ZCursor, colorspace::ColorSpace, options::DecoderOptions},
};

use crate::bake::model::Image;

/// Most texels of all images of a model together: 16,384 squared, the largest image that graphics adapters take.
pub const MAX_TEXELS: u64 = 1 << 28;
/// Most texels of a JPEG image for each of its bytes: a block of 64 takes a bit at least.
const JPEG_TEXELS_A_BYTE: u64 = 64 * 8;
/// Most bytes of pixels of a PNG image for each of its bytes, as its compression allows (RFC 1951: 258 bytes of two
/// codes of a bit each).
const PNG_BYTES_A_BYTE: u64 = 1032;

/// A decoded image and its smaller copies.
#[derive(Clone, Debug)]
pub struct Texture {
    levels: Vec<Level>,
    /// Whether its colours are stored as sRGB.
    srgb: bool,
}

#[derive(Clone, Debug)]
struct Level {
    size: UVec2,
    texels: Vec<[u8; 4]>,
}

impl Level {
    /// Returns a texel; nothing beyond the edges.
    fn texel(&self, x: u32, y: u32) -> [u8; 4] {
        self.texels.get((y * self.size.x + x) as usize).copied().unwrap_or_default()
    }
}

/// How a texture goes on beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// It repeats.
    #[default]
    Repeat,
    /// Its edge goes on.
    Clamp,
    /// It repeats, each time mirrored.
    Mirror,
}

impl Texture {
    /// Decodes a PNG or JPEG image of at most so many texels. How large it is and whether it can be whole is known
    /// before it is decoded.
    ///
    /// # Errors
    /// A message that says why not.
    pub fn decode(image: &Image, srgb: bool, most_texels: u64) -> Result<Self, String> {
        let level = match image.mime_type.as_str() {
            "image/png" => decode_png(&image.bytes, most_texels)?,
            "image/jpeg" => decode_jpeg(&image.bytes, most_texels)?,
            other => return Err(format!("{other} cannot be read")),
        };
        let mut texture = Self { levels: vec![level], srgb };
        while let Some(half) = texture.levels.last().and_then(|level| texture.half(level)) {
            texture.levels.push(half);
        }
        Ok(texture)
    }

    /// Texels along each side.
    pub fn size(&self) -> UVec2 {
        self.levels.first().map_or(UVec2::ONE, |level| level.size)
    }

    /// Texels as they are stored, row by row from the top.
    pub fn pixels(&self) -> &[[u8; 4]] {
        self.levels.first().map_or(&[], |level| &level.texels)
    }

    /// The mean of all its texels.
    pub fn mean(&self) -> Vec4 {
        let texel = self.levels.last().and_then(|level| level.texels.first());
        texel.map_or(Vec4::ZERO, |&texel| self.linear(texel))
    }

    /// Number of texels, without smaller copies.
    pub fn texels(&self) -> u64 {
        self.levels.first().map_or(0, |level| level.texels.len() as u64)
    }

    /// Half as large: each texel the mean of four, as light. `None` for a single texel.
    fn half(&self, level: &Level) -> Option<Level> {
        if level.size == UVec2::ONE {
            return None;
        }
        let size = (level.size / 2).max(UVec2::ONE);
        let mut texels = Vec::with_capacity((size.x * size.y) as usize);
        for y in 0..size.y {
            for x in 0..size.x {
                let at = |dx: u32, dy: u32| {
                    let p = UVec2::new(2 * x + dx, 2 * y + dy).min(level.size - 1);
                    self.linear(level.texel(p.x, p.y))
                };
                texels.push(self.encode((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) * 0.25));
            }
        }
        Some(Level { size, texels })
    }

    fn linear(&self, texel: [u8; 4]) -> Vec4 {
        if self.srgb {
            let [r, g, b, a] = texel;
            #[expect(clippy::indexing_slicing, reason = "the table has a place for each byte")]
            let [r, g, b] = [r, g, b].map(|c| SRGB.linear[usize::from(c)]);
            Vec4::new(r, g, b, f32::from(a) / 255.0)
        } else {
            Vec4::from(texel.map(f32::from)) / 255.0
        }
    }

    fn encode(&self, color: Vec4) -> [u8; 4] {
        let [r, g, b, a] = color.to_array();
        if self.srgb { [to_srgb(r), to_srgb(g), to_srgb(b), to_byte(a)] } else { [r, g, b, a].map(to_byte) }
    }

    /// Linear colour at `uv`. `footprint` is how many texels of the image one sample stands for, along a side;
    /// `nearest` takes whole texels.
    pub fn sample(&self, uv: Vec2, wrap: [Wrap; 2], footprint: f32, nearest: bool) -> Vec4 {
        let deepest = self.levels.len() - 1;
        // Nothing is blended until a sample stands for two texels.
        let lod = if footprint > 1.0 { ops::log2(footprint).min(deepest as f32) } else { 0.0 };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it is a number from 0 to the deepest level"
        )]
        let fine = lod as usize;
        let near = self.sample_level(fine, uv, wrap, nearest);
        let part = lod - fine as f32;
        if part <= 0.0 || fine == deepest {
            return near;
        }
        near.lerp(self.sample_level(fine + 1, uv, wrap, nearest), part)
    }

    fn sample_level(&self, level: usize, uv: Vec2, wrap: [Wrap; 2], nearest: bool) -> Vec4 {
        let Some(level) = self.levels.get(level) else { return Vec4::ZERO };
        let size = level.size.as_ivec2();
        let at = |x: i32, y: i32| self.linear(level.texel(wrapped(x, size.x, wrap[0]), wrapped(y, size.y, wrap[1])));
        // Coordinates far out, in steps of more than a texel, are not worth more.
        let p = (uv * level.size.as_vec2()).clamp(Vec2::splat(-1e9), Vec2::splat(1e9));
        if nearest {
            let p = p.floor().as_ivec2();
            return at(p.x, p.y);
        }
        let (corner, part) = ((p - 0.5).floor(), (p - 0.5) - (p - 0.5).floor());
        let IVec2 { x, y } = corner.as_ivec2();
        at(x, y).lerp(at(x + 1, y), part.x).lerp(at(x, y + 1).lerp(at(x + 1, y + 1), part.x), part.y)
    }
}

/// Returns where the texel `i` of a row of `size` is: from 0 to below `size`.
fn wrapped(i: i32, size: i32, wrap: Wrap) -> u32 {
    let i = match wrap {
        Wrap::Repeat => i.rem_euclid(size),
        Wrap::Clamp => i.clamp(0, size - 1),
        Wrap::Mirror => {
            let i = i.rem_euclid(2 * size);
            i.min(2 * size - 1 - i)
        }
    };
    i.cast_unsigned()
}

fn decode_png(bytes: &[u8], most_texels: u64) -> Result<Level, String> {
    let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::ALPHA);
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let (width, height) = reader.info().size();
    let row = reader.info().raw_row_length() as u64;
    check_size((width, height), most_texels, row.saturating_mul(u64::from(height)) / PNG_BYTES_A_BYTE, bytes)?;
    let length = reader.output_buffer_size().ok_or("it is too large")?;
    let mut pixels = vec![0; length];
    let frame = reader.next_frame(&mut pixels).map_err(|error| error.to_string())?;
    let texels = match frame.color_type {
        png::ColorType::GrayscaleAlpha => pixels.as_chunks::<2>().0.iter().map(|&[g, a]| [g, g, g, a]).collect(),
        png::ColorType::Rgba => pixels.as_chunks::<4>().0.to_vec(),
        other => return Err(format!("{other:?} pixels")),
    };
    level(width, height, texels)
}

fn decode_jpeg(bytes: &[u8], most_texels: u64) -> Result<Level, String> {
    let options = DecoderOptions::default()
        .jpeg_set_out_colorspace(ColorSpace::RGB)
        .set_max_width(usize::from(u16::MAX))
        .set_max_height(usize::from(u16::MAX));
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| error.to_string())?;
    let (width, height) = decoder.dimensions().ok_or("no size")?;
    // What has more than 32 bits is too large.
    let [width, height] = [width, height].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
    let texels = u64::from(width) * u64::from(height);
    check_size((width, height), most_texels, texels / JPEG_TEXELS_A_BYTE, bytes)?;
    let pixels = decoder.decode().map_err(|error| error.to_string())?;
    let texels = pixels.as_chunks::<3>().0.iter().map(|&[r, g, b]| [r, g, b, 255]).collect();
    level(width, height, texels)
}

/// Refuses images that are too large, or larger than so few bytes can hold: `least` is how many it takes.
fn check_size((width, height): (u32, u32), most_texels: u64, least: u64, bytes: &[u8]) -> Result<(), String> {
    let found = bytes.len() as u64;
    if u64::from(width) * u64::from(height) > most_texels {
        Err(format!(
            "it is too large: {width} x {height} texels, and a model's textures may have {MAX_TEXELS} together"
        ))
    } else if least > found {
        Err(format!("it is not whole: {width} x {height} texels need {least} bytes or more, there are {found}"))
    } else {
        Ok(())
    }
}

fn level(width: u32, height: u32, texels: Vec<[u8; 4]>) -> Result<Level, String> {
    let size = UVec2::new(width, height);
    if texels.is_empty() || texels.len() != (width * height) as usize {
        return Err("it is not whole".into());
    }
    Ok(Level { size, texels })
}

/// From sRGB to light, and the light in the middle between each sRGB byte and the next.
struct SrgbTable {
    linear: [f32; 256],
    middles: [f32; 255],
}

static SRGB: std::sync::LazyLock<SrgbTable> = std::sync::LazyLock::new(|| {
    let linear = |c: f32| {
        let c = c / 255.0;
        if c <= 0.04045 { c / 12.92 } else { ops::powf((c + 0.055) / 1.055, 2.4) }
    };
    SrgbTable {
        linear: std::array::from_fn(|i| linear(i as f32)),
        middles: std::array::from_fn(|i| linear(i as f32 + 0.5)),
    }
});

/// Light as an sRGB byte.
#[expect(clippy::cast_possible_truncation, reason = "there are 255 middles")]
pub fn to_srgb(light: f32) -> u8 {
    SRGB.middles.partition_point(|&middle| middle < light) as u8
}

/// 0 to 1 as a byte.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "it is a number from 0 to 255.5")]
pub fn to_byte(x: f32) -> u8 {
    // NaN becomes 0.
    (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use base64::{Engine, engine::general_purpose::STANDARD};

    use super::*;

    fn checker() -> Texture {
        let (black, white) = ([0, 0, 0, 255], [255, 255, 255, 255]);
        let texels = (0..16).map(|i| if (i % 4 + i / 4) % 2 == 0 { black } else { white }).collect();
        let mut texture = Texture { levels: vec![level(4, 4, texels).expect("whole")], srgb: true };
        while let Some(half) = texture.half(&texture.levels[texture.levels.len() - 1]) {
            texture.levels.push(half);
        }
        texture
    }

    #[test]
    fn bytes_survive_the_way_to_light_and_back() {
        assert!((0..=255u8).all(|c| to_srgb(SRGB.linear[usize::from(c)]) == c));
        assert_eq!([to_srgb(-1.0), to_srgb(2.0), to_byte(f32::NAN), to_byte(0.5)], [0, 255, 0, 128]);
    }

    #[test]
    fn samples_are_texels_blends_of_them_or_means() {
        let texture = checker();
        assert_eq!(texture.levels.len(), 3);
        let at = |x: f32, y: f32, footprint: f32| {
            texture.sample(Vec2::new(x, y) / 4.0, [Wrap::Repeat; 2], footprint, false).x
        };
        assert_eq!([at(0.5, 0.5, 1.0), at(1.5, 0.5, 1.0), at(5.5, 0.5, 1.0)], [0.0, 1.0, 1.0]);
        assert!((at(1.0, 0.5, 1.0) - 0.5).abs() < 1e-6);
        // From afar it is grey, as light.
        assert!((at(0.5, 0.5, 4.0) - 0.5).abs() < 0.01);
        assert_eq!(texture.sample(Vec2::new(0.99, 0.1) / 4.0, [Wrap::Repeat; 2], 1.0, true).x, 0.0);
    }

    #[test]
    fn textures_go_on_beyond_their_edges_in_three_ways() {
        let at = |wrap| [-1, 4, 5].map(|i| wrapped(i, 4, wrap));
        assert_eq!(at(Wrap::Repeat), [3, 0, 1]);
        assert_eq!(at(Wrap::Clamp), [0, 3, 3]);
        assert_eq!(at(Wrap::Mirror), [0, 3, 2]);
    }

    /// 16 by 8 texels: the left half red, the right half blue.
    const JPEG: &str = "\
        /9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgICAgMCAgIDAwMDBAYEBAQEBAgGBgUGCQgKCgkICQkKDA8MCgsOCwkJDRENDg8Q\
        EBEQCgwSExIQEw8QEBD/2wBDAQMDAwQDBAgEBAgQCwkLEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQ\
        EBAQEBAQEBAQEBD/wAARCAAIABADAREAAhEBAxEB/8QAFAABAAAAAAAAAAAAAAAAAAAAB//EABQQAQAAAAAAAAAAAAAAAAAAAAD/\
        xAAWAQEBAQAAAAAAAAAAAAAAAAAIBwn/xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oADAMBAAIRAxEAPwAUTc1Re0dAd//Z";

    #[test]
    fn jpeg_images_are_read() {
        let bytes = STANDARD.decode(JPEG).expect("base64");
        let image = Image { mime_type: "image/jpeg".into(), bytes: bytes.into(), ..Image::default() };
        let texture = Texture::decode(&image, true, MAX_TEXELS).expect("an image");
        assert_eq!(texture.size(), UVec2::new(16, 8));
        let texel = |x: usize| texture.levels[0].texels[4 * 16 + x];
        let near = |a: [u8; 4], b: [u8; 4]| a.iter().zip(b).all(|(a, b)| a.abs_diff(b) <= 6);
        assert!(near(texel(2), [200, 40, 40, 255]) && near(texel(13), [40, 40, 200, 255]), "{:?}", texel(2));
    }

    #[test]
    fn what_is_no_image_is_an_error() {
        for (mime_type, bytes) in [
            ("image/png", &b"\x89PNG\r\n\x1a\n and the rest"[..]),
            ("image/jpeg", &[0xff, 0xd8, 0xff, 0xe0, 0, 2]),
            ("image/ktx2", &[]),
        ] {
            let image = Image { mime_type: mime_type.into(), bytes: bytes.into(), ..Image::default() };
            assert!(Texture::decode(&image, true, MAX_TEXELS).is_err(), "{mime_type}");
        }
    }

    /// Small files that claim to be 16,384 texels wide and high once took ten seconds.
    #[test]
    fn sizes_are_checked_before_images_are_decoded() {
        let mut jpeg = STANDARD.decode(JPEG).expect("base64");
        let frame = jpeg.windows(2).position(|pair| pair == [0xff, 0xc0]).expect("a frame header");
        jpeg[frame + 5..frame + 9].copy_from_slice(&[0x40, 0, 0x40, 0]);
        let mut png = Vec::new();
        let mut encoder = png::Encoder::new(&mut png, 16384, 16384);
        encoder.set_color(png::ColorType::Rgba);
        let written = encoder.write_header().and_then(|mut writer| writer.write_chunk(png::chunk::IDAT, &[0x78, 1]));
        written.expect("a header");
        for (mime_type, bytes) in [("image/jpeg", jpeg), ("image/png", png)] {
            let image = Image { mime_type: mime_type.into(), bytes: bytes.into(), ..Image::default() };
            let error = |most| Texture::decode(&image, true, most).expect_err(mime_type);
            assert!(error(MAX_TEXELS).contains("16384 x 16384 texels need"), "{}", error(MAX_TEXELS));
            assert!(error(MAX_TEXELS - 1).contains("too large"), "{}", error(MAX_TEXELS - 1));
        }
    }

    /// The most that the formats allow: nothing whole is refused.
    #[test]
    fn images_of_one_colour_are_whole() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 4096, 4096);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::One);
        encoder.set_compression(png::Compression::High);
        encoder.write_header().and_then(|mut w| w.write_image_data(&vec![0; 4096 * 512])).expect("a PNG");
        let image = Image { mime_type: "image/png".into(), bytes: bytes.into(), ..Image::default() };
        assert_eq!(Texture::decode(&image, false, MAX_TEXELS).expect("whole").texels(), 1 << 24);
    }
}
