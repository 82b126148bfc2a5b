//! Reads the command line.

use std::{
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
};

use bevy_coating::{
    bake::{BakeOptions, Input, MAX_AGE, MAX_STEPS_PER_AGE, MAX_TRIANGLES, Resolution, StainOutput, TEXTURE_SIZES},
    deform::SolverQuality,
    settings::CoatingSettings,
    stain::Environment,
};
use bevy_math::{DVec3, Vec3};
use clap::{
    CommandFactory, Parser,
    builder::{OsStringValueParser, TypedValueParser},
    error::ErrorKind,
};

use crate::Failure;

/// Strongest wind, in pulls of gravity, and widest gusts, in metres a metre: as wide as a setting's spread.
const MAX_WIND: f32 = 100.0;
const MAX_GUSTS: f32 = 10.0;

/// Ages a painted prop without a window or a graphics adapter
#[derive(Debug, Parser)]
#[command(
    name = "coating-bake",
    version,
    after_help = "\
Exit code: 0, 1 with one line on bad input, 2 on bad usage. Output files are written whole or not at all.
Meshes that have no triangle mesh, or are all slivers, are left out; skinned and morphed ones are aged in their bind \
pose. Digest: BLAKE3 over the films in order, fields as documented at FilmState::digest_into."
)]
pub struct Args {
    /// A .glb, .gltf or .obj file, or a test piece: plate:3012, curved:3005, disk:4047
    #[arg(value_parser = OsStringValueParser::new().try_map(|text: OsString| Input::parse(&text)))]
    pub input: Input,
    /// Write the aged model: paint, backs of flakes, bare metal, all with their stains
    #[arg(long, value_name = "FILE.glb", value_parser = OsStringValueParser::new().try_map(parse_glb))]
    pub out: Option<PathBuf>,
    /// Texels along the side of the aged model's textures: base colour, metalness and roughness, normals
    #[arg(
        long, value_name = "N", default_value_t = 1024, allow_hyphen_values = true,
        value_parser = parse_texture_size, conflicts_with_all = ["vertex_colors", "no_stains"]
    )]
    texture_size: u32,
    /// Write stains as vertex colours, and leave textures as they are
    #[arg(long, conflicts_with = "no_stains")]
    vertex_colors: bool,
    /// Write no stains: materials and textures as they are
    #[arg(long)]
    no_stains: bool,
    /// Write figures of the run
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
    /// Write one row a vertex
    #[arg(long, value_name = "FILE.csv")]
    pub dump: Option<PathBuf>,
    /// Settings: default, few_cracks, gentle, heavy, or a file that ends in .ron
    #[arg(long, value_name = "NAME|FILE.ron", default_value = "default")]
    preset: String,
    /// Change one setting, such as tearing.beta=0.3; may be repeated
    #[arg(long = "set", value_name = "PATH=VALUE", allow_hyphen_values = true, value_parser = parse_set)]
    settings: Vec<(String, String)>,
    /// Age to reach: 1 is the end of the reference run
    #[arg(long, default_value = "1", allow_hyphen_values = true, value_parser = parse_age)]
    age: f64,
    /// Steps per unit age
    #[arg(
        long, default_value_t = 1000, allow_hyphen_values = true,
        value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_STEPS_PER_AGE))
    )]
    steps: u32,
    /// How bending is solved: reference, high, default or fast
    #[arg(long, value_name = "NAME", default_value = "default", value_parser = parse_quality)]
    quality: SolverQuality,
    /// Seed of everything random
    #[arg(long, default_value_t = 0, allow_hyphen_values = true)]
    seed: u64,
    /// Triangles of all films together, or keep to use the meshes as they are; test pieces ignore it
    #[arg(
        long, value_name = "N|keep", default_value = "4000", allow_hyphen_values = true,
        value_parser = parse_resolution
    )]
    triangles: Resolution,
    /// Direction of gravity in scene space, of any length
    #[arg(
        long, value_name = "X,Y,Z", default_value = "0,-1,0", allow_hyphen_values = true,
        value_parser = parse_gravity
    )]
    gravity: Vec3,
    /// Where the wind blows, in scene space; as long as it pulls at run-off: 1 like gravity
    #[arg(
        long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true,
        value_parser = |text: &str| parse_vector(text, f64::from(MAX_WIND))
    )]
    wind: Vec3,
    /// How far gusts spread run-off sideways: metres after one metre
    #[arg(long, value_name = "M", default_value = "0", allow_hyphen_values = true, value_parser = parse_gusts)]
    gusts: f32,
    /// Where rain falls, in scene space; as long as there is rain: 0 to 1
    #[arg(
        long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true,
        value_parser = |text: &str| parse_vector(text, 1.0)
    )]
    rain: Vec3,
    /// Where sunlight falls, in scene space; as long as it is strong: 0 to 1
    #[arg(
        long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true,
        value_parser = |text: &str| parse_vector(text, 1.0)
    )]
    sun: Vec3,
}

impl Args {
    /// Reads the command line; ends the program with code 2 if it makes no sense.
    pub fn parse_or_exit() -> Self {
        let args = Self::parse();
        let outputs: Vec<&Path> = args.outputs().collect();
        if (1..outputs.len()).any(|i| outputs[..i].contains(&outputs[i])) {
            usage_error("two output files have the same name");
        }
        args
    }

    /// The files to be written.
    pub fn outputs(&self) -> impl Iterator<Item = &Path> {
        [&self.out, &self.dump, &self.stats].into_iter().flatten().map(PathBuf::as_path)
    }

    /// How stains come into the aged model.
    pub fn stains(&self) -> StainOutput {
        match (self.vertex_colors, self.no_stains) {
            (true, _) => StainOutput::VertexColors,
            (_, true) => StainOutput::None,
            _ => StainOutput::Textures(self.texture_size),
        }
    }

    /// How to age. Ends the program with code 2 on an unknown preset or setting.
    ///
    /// # Errors
    /// [`Failure`] if the settings are a file that cannot be used.
    pub fn options(&self) -> Result<BakeOptions, Failure> {
        let mut settings = if Path::new(&self.preset).extension().is_some_and(|ending| ending == "ron") {
            let text = fs::read_to_string(&self.preset)
                .map_err(|source| Failure::Preset { file: self.preset.clone(), source })?;
            CoatingSettings::from_ron(&text, &self.preset)?
        } else {
            CoatingSettings::preset(&self.preset).unwrap_or_else(|error| usage_error(&error.to_string()))
        };
        for (path, value) in &self.settings {
            settings.set(path, value).unwrap_or_else(|error| usage_error(&error.to_string()));
        }
        settings.validate()?;
        Ok(BakeOptions {
            resolution: self.triangles,
            settings,
            preset: self.preset.clone(),
            age: self.age,
            steps: self.steps,
            quality: self.quality,
            seed: self.seed,
            environment: Environment {
                gravity: self.gravity,
                wind: self.wind,
                gusts: self.gusts,
                rain: self.rain,
                sun: self.sun,
            },
            exclude: Vec::new(),
        })
    }
}

fn usage_error(message: &str) -> ! {
    Args::command().error(ErrorKind::ValueValidation, message).exit()
}

fn parse_glb(path: OsString) -> Result<PathBuf, &'static str> {
    let path = PathBuf::from(path);
    match path.extension() {
        Some(ending) if ending.eq_ignore_ascii_case("gltf") => Err("what is written is binary glTF: name it .glb"),
        _ => Ok(path),
    }
}

fn parse_set(text: &str) -> Result<(String, String), &'static str> {
    let (path, value) = text.split_once('=').ok_or("write it as path=value")?;
    Ok((path.trim().into(), value.trim().into()))
}

fn parse_quality(text: &str) -> Result<SolverQuality, &'static str> {
    SolverQuality::named(text).ok_or("not reference, high, default or fast")
}

fn parse_age(text: &str) -> Result<f64, String> {
    let age = text.parse::<f64>().ok().filter(|age| (0.0..=MAX_AGE).contains(age));
    age.ok_or_else(|| format!("not a number from 0 to {MAX_AGE}"))
}

fn parse_resolution(text: &str) -> Result<Resolution, String> {
    if text == "keep" {
        return Ok(Resolution::Keep);
    }
    let count = text.parse().ok().filter(|n| (4..=MAX_TRIANGLES).contains(n));
    count.map(Resolution::Triangles).ok_or_else(|| format!("neither `keep` nor a number from 4 to {MAX_TRIANGLES}"))
}

fn parse_texture_size(text: &str) -> Result<u32, String> {
    let size = text.parse().ok().filter(|size| TEXTURE_SIZES.contains(size));
    size.ok_or_else(|| format!("not a number from {} to {}", TEXTURE_SIZES.start(), TEXTURE_SIZES.end()))
}

fn parse_gravity(text: &str) -> Result<Vec3, &'static str> {
    let direction = parse_numbers(text).ok_or("write it as three finite numbers, like 0,-1,0")?;
    // By the largest part first, so that no square can overflow.
    let largest = direction.abs().max_element();
    (direction / largest).try_normalize().map(|g| g.as_vec3()).ok_or("gravity needs a direction")
}

/// A vector that is at most so long.
fn parse_vector(text: &str, longest: f64) -> Result<Vec3, String> {
    let vector = parse_numbers(text).ok_or("write it as three finite numbers, like 0.3,0,-0.2")?;
    // A little more is rounding: 0.6,-0.8,0 is one long.
    if vector.length() <= longest * 1.000_001 {
        Ok(vector.as_vec3())
    } else {
        Err(format!("its length is more than {longest}"))
    }
}

fn parse_gusts(text: &str) -> Result<f32, String> {
    let gusts = text.parse::<f32>().ok().filter(|gusts| (0.0..=MAX_GUSTS).contains(gusts));
    gusts.ok_or_else(|| format!("not a number from 0 to {MAX_GUSTS}"))
}

/// Three finite numbers between commas.
fn parse_numbers(text: &str) -> Option<DVec3> {
    let parts: Vec<f64> = text.split(',').map_while(|part| part.trim().parse().ok()).collect();
    let &[x, y, z] = parts.as_slice() else { return None };
    let whole = text.split(',').count() == 3;
    Some(DVec3::new(x, y, z)).filter(|vector| whole && vector.is_finite())
}
