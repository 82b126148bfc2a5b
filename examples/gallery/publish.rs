//! The page: numbers, and small pictures beside them.

use crate::measure::page::{self, FILE, PICTURES};
use crate::stage;
use bevy::prelude::AppExit;
use color_quant::NeuQuant;
use std::error::Error;
use std::fs::{self, File};
use std::io::{BufReader, BufWriter};
use std::path::{Path, PathBuf};

/// The repository.
const ROOT: &str = env!("CARGO_MANIFEST_DIR");

/// Writes the page without pictures into `folder`.
pub fn text(folder: &Path) -> AppExit {
    told(write_text(&folder.join("gallery.md")))
}

/// Writes the page into `folder`, where its pictures are; with `publish` into the repository, too.
pub fn page(folder: &Path, publish: bool) -> AppExit {
    let written = write_text(&folder.join("gallery.md")).and_then(|text| {
        if publish {
            fs::write(Path::new(ROOT).join(FILE), &text)?;
            println!("{FILE}");
            shrink_all(folder)?;
        }
        Ok(text)
    });
    told(written)
}

fn told(written: Result<String, Box<dyn Error>>) -> AppExit {
    match written {
        Ok(_) => AppExit::Success,
        Err(error) => {
            eprintln!("{error}");
            AppExit::error()
        }
    }
}

/// Measures everything, tells it, and writes the page.
fn write_text(file: &Path) -> Result<String, Box<dyn Error>> {
    println!("measuring the figures of all runs");
    let measured = page::measure()?;
    for (figure, claims) in &measured {
        println!("{}: {}", figure.number, figure.title);
        claims.iter().for_each(|claim| println!("  {claim}"));
    }
    let text = page::text(&measured, &page::times()?);
    if let Some(folder) = file.parent() {
        fs::create_dir_all(folder)?;
    }
    // Beside it the pictures have other names than in the repository.
    fs::write(file, text.replace(&format!("../{PICTURES}/"), ""))?;
    println!("{}", file.display());
    Ok(text)
}

fn shrink_all(folder: &Path) -> Result<(), Box<dyn Error>> {
    let to = Path::new(ROOT).join(PICTURES);
    fs::create_dir_all(&to)?;
    for figure in stage::shown() {
        let name = PathBuf::from(format!("{}.png", figure.file));
        shrink(&folder.join(&name), &to.join(&name))?;
        println!("{PICTURES}/{}", name.display());
    }
    Ok(())
}

/// Writes a picture with a palette of 256 colours: a third of its size.
fn shrink(from: &Path, to: &Path) -> Result<(), Box<dyn Error>> {
    let mut reader = png::Decoder::new(BufReader::new(File::open(from)?)).read_info()?;
    let mut pixels = vec![0; reader.output_buffer_size().ok_or("a picture that is too large")?];
    let frame = reader.next_frame(&mut pixels)?;
    let opaque: Vec<u8> = pixels.as_chunks::<3>().0.iter().flat_map(|&[r, g, b]| [r, g, b, 255]).collect();
    let palette = NeuQuant::new(1, 256, &opaque);
    let indices: Vec<u8> = opaque.as_chunks::<4>().0.iter().map(|pixel| palette.index_of(pixel) as u8).collect();
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(to)?), frame.width, frame.height);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_palette(palette.color_map_rgb());
    encoder.set_compression(png::Compression::High);
    encoder.write_header()?.write_image_data(&indices)?;
    Ok(())
}
