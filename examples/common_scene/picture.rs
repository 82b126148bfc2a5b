//! A rendered image becomes pixels, and a PNG file.

use bevy::prelude::*;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;

/// Samples along each side of a pixel.
pub const SUPERSAMPLING: u32 = 2;

/// Averages the samples of each pixel as light: a picture of `size` pixels from the image's upper left corner, three
/// bytes a pixel.
pub fn pixels(image: &Image, size: UVec2) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let (width, height) = (size.x, size.y);
    let data = image.data.as_ref().ok_or("the picture came back without data")?;
    let linear: Vec<f32> = (0..=255u8).map(|c| Srgba::gamma_function(f32::from(c) / 255.0)).collect();
    let samples = (SUPERSAMPLING * SUPERSAMPLING) as f32;
    let mut pixels = Vec::with_capacity((width * height * 3) as usize);
    for y in 0..height {
        for x in 0..width {
            for channel in 0..3 {
                let sample = |i: u32| {
                    let (sx, sy) = (x * SUPERSAMPLING + i % SUPERSAMPLING, y * SUPERSAMPLING + i / SUPERSAMPLING);
                    let at = (sy * image.width() + sx) as usize * 4 + channel;
                    data.get(at).map_or(0.0, |c| linear[usize::from(*c)])
                };
                let mean = (0..SUPERSAMPLING * SUPERSAMPLING).map(sample).sum::<f32>() / samples;
                pixels.push((Srgba::gamma_function_inverse(mean) * 255.0 + 0.5) as u8);
            }
        }
    }
    Ok(pixels)
}

/// Writes such a picture.
pub fn write(pixels: &[u8], size: UVec2, file: &Path) -> Result<(), Box<dyn std::error::Error>> {
    if let Some(folder) = file.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(file)?), size.x, size.y);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(pixels)?;
    Ok(())
}
