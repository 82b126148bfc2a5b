//! The command line.

use std::{
    ffi::OsString,
    fs,
    path::{Path, PathBuf},
};

use bevy_coating::{settings::CoatingSettings, stain::Environment};
use bevy_math::{DVec3, Vec3};
use clap::{
    CommandFactory, Parser,
    builder::{OsStringValueParser, TypedValueParser},
    error::ErrorKind,
};

use crate::{
    Failure,
    common::{BakeOptions, Input, MAX_TRIANGLES, Resolution},
};

/// Oldest age and most steps that are taken seriously: a typing error should not run for a year.
const MAX_AGE: f64 = 100.0;
const MAX_STEPS: u32 = 1_000_000;

/// Ages a painted prop without a window or a graphics adapter
#[derive(Debug, Parser)]
#[command(
    name = "bake",
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
    /// Write the aged model: paint with its own texture, backs of flakes, bare metal
    #[arg(long, value_name = "FILE.glb", value_parser = OsStringValueParser::new().try_map(parse_glb))]
    pub out: Option<PathBuf>,
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
        value_parser = clap::value_parser!(u32).range(1..=i64::from(MAX_STEPS))
    )]
    steps: u32,
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
            seed: self.seed,
            environment: Environment::still(self.gravity),
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

fn parse_gravity(text: &str) -> Result<Vec3, &'static str> {
    let parts: Vec<f64> = text.split(',').map_while(|part| part.trim().parse().ok()).collect();
    let &[x, y, z] = parts.as_slice() else { return Err("write it as three numbers, like 0,-1,0") };
    if text.split(',').count() != 3 || ![x, y, z].iter().all(|x| x.is_finite()) {
        return Err("write it as three finite numbers, like 0,-1,0");
    }
    // By the largest part first, so that no square can overflow.
    let direction = DVec3::new(x, y, z);
    let largest = direction.abs().max_element();
    (direction / largest).try_normalize().map(|g| g.as_vec3()).ok_or("gravity needs a direction")
}
