//! Reads the command line.

use std::{
    ffi::OsString,
    fs, io,
    path::{Path, PathBuf},
};

use bevy_coating::{
    appearance::Detail,
    bake::{BakeOptions, Input, MAX_STEPS_PER_AGE, MaskFiles, NamePattern, StainOutput},
    deform::SolverQuality,
    film::FaceGrid,
    remesh::{DEFAULT_GRAIN_SHARE, DEFAULT_MAX_TRIANGLES, FilmResolution},
    settings::CoatingSettings,
    stain::Environment,
};
use bevy_math::Vec3;
use clap::{
    CommandFactory, Parser,
    builder::{OsStringValueParser, TypedValueParser},
    error::ErrorKind,
};

use crate::{
    Failure,
    values::{
        MAX_WIND, parse_age, parse_count, parse_edge, parse_glb, parse_gravity, parse_gusts, parse_pattern,
        parse_quality, parse_set, parse_texture_size, parse_triangles, parse_unit, parse_vector,
    },
};

/// Path of the setting that --grain sets.
const GRAIN: &str = "scale.grain";

/// Ages a painted prop without a window or a graphics adapter
#[derive(Debug, Parser)]
#[command(
    name = "coating-bake",
    version,
    after_help = "\
Several inputs, or folders of models, go to --out-dir and --stats-dir under their own names; each comes out as it \
would alone, and one that fails does not keep the others.
Exit code: 0, 1 with one line for each bad input, 2 on bad usage, 130 if interrupted. Output files are written whole \
or not at all, and never over a file that is read.
Meshes that have no triangle mesh, or are all slivers, are left out; skinned and morphed ones are aged in their bind \
pose. Digest: BLAKE3 over the films in order, fields as documented at FilmState::digest_into."
)]
pub struct Args {
    /// .glb, .gltf and .obj files, folders of them, or test pieces: plate:3012, curved:3005, disk:4047
    #[arg(
        required = true, value_name = "INPUT",
        value_parser = OsStringValueParser::new().try_map(|text: OsString| Input::parse(&text))
    )]
    pub inputs: Vec<Input>,
    /// Write the aged model: paint, backs of flakes, bare metal, all with their stains
    #[arg(
        long, value_name = "FILE.glb", conflicts_with = "out_dir",
        value_parser = OsStringValueParser::new().try_map(parse_glb)
    )]
    pub out: Option<PathBuf>,
    /// Write the aged model of each input into this folder, as NAME.glb
    #[arg(long, value_name = "FOLDER")]
    pub out_dir: Option<PathBuf>,
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
    #[arg(long, value_name = "FILE.json", conflicts_with = "stats_dir")]
    pub stats: Option<PathBuf>,
    /// Write figures of each input's run into this folder, as NAME.json
    #[arg(long, value_name = "FOLDER")]
    pub stats_dir: Option<PathBuf>,
    /// Write one row a vertex
    #[arg(long, value_name = "FILE.csv")]
    pub dump: Option<PathBuf>,
    /// Leave nodes, meshes and materials of this name as they are; * and ? stand for any characters; may be repeated
    #[arg(long, value_name = "NAME", allow_hyphen_values = true, value_parser = parse_pattern)]
    exclude: Vec<NamePattern>,
    /// Ignore custom properties of models that say how they are painted, such as `coating`
    #[arg(long)]
    ignore_extras: bool,
    /// Masks: a .ron file of them, or an image or a rule (edges, lower, under, noise, color) with what it does where
    /// it is 0 and 1: wear.png:adhesion=1..0.2,rust=0..0.5; may be repeated
    #[arg(long = "mask", value_name = "FILE.ron|WHERE:EFFECT=A..B")]
    masks: Vec<String>,
    /// Settings: chalky_whitewash, default, desert_sun, few_cracks, fresh_enamel, gentle, harsh, heavy, marine,
    /// old_lead_paint, paper, powder_coat, or a file that ends in .ron
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
    /// Grain in metres, the scale of cracks and curls by the rules Grain; the same as --set scale.grain=M
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    grain: Option<String>,
    /// Most triangles of all films together, whose edges are 0.7 grains long up to there; test pieces ignore it
    #[arg(
        long, value_name = "N", default_value_t = DEFAULT_MAX_TRIANGLES, allow_hyphen_values = true,
        value_parser = parse_count, conflicts_with_all = ["triangles", "edge"]
    )]
    max_triangles: u32,
    /// Triangles of all films together, or keep to use the meshes as they are; test pieces ignore it
    #[arg(
        long, value_name = "N|keep", allow_hyphen_values = true, value_parser = parse_triangles,
        conflicts_with = "edge"
    )]
    triangles: Option<FilmResolution>,
    /// Length of the edges of all films in metres; test pieces ignore it
    #[arg(long, value_name = "M", allow_hyphen_values = true, value_parser = parse_edge)]
    edge: Option<FilmResolution>,
    /// How finely the aged model is written: 4 to this power triangles for each of a film, 0 to 4
    #[arg(
        long, value_name = "N", default_value_t = 0, allow_hyphen_values = true,
        value_parser = clap::value_parser!(u32).range(0..=i64::from(FaceGrid::MOST))
    )]
    level: u32,
    /// Metres that a unit of the models is long; test pieces are in metres anyway
    #[arg(long, value_name = "M", default_value = "1", allow_hyphen_values = true, value_parser = parse_unit)]
    metres_per_unit: f32,
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
    /// How stains come into the aged model.
    pub fn stains(&self) -> StainOutput {
        match (self.vertex_colors, self.no_stains) {
            (true, _) => StainOutput::VertexColors,
            (_, true) => StainOutput::None,
            _ => StainOutput::Textures(self.texture_size),
        }
    }

    /// The file of settings, if they are in one.
    pub fn preset_file(&self) -> Option<&Path> {
        Some(Path::new(&self.preset)).filter(|file| file.extension().is_some_and(|ending| ending == "ron"))
    }

    /// How fine the films are.
    fn resolution(&self) -> FilmResolution {
        let by_grain = FilmResolution::Grain { share: DEFAULT_GRAIN_SHARE, max_triangles: self.max_triangles };
        self.triangles.or(self.edge).unwrap_or(by_grain)
    }

    /// The masks with their images.
    ///
    /// # Errors
    /// [`Failure`] if a mask is none or has a file that cannot be used.
    pub fn masks(&self) -> Result<MaskFiles, Failure> {
        let mut masks = MaskFiles::default();
        self.masks.iter().try_for_each(|text| masks.add(text))?;
        Ok(masks)
    }

    /// How to age, with `masks`. Ends the program with code 2 on an unknown preset or setting.
    ///
    /// # Errors
    /// [`Failure`] if the settings are a file that cannot be used.
    pub fn options(&self, masks: MaskFiles) -> Result<BakeOptions, Failure> {
        let mut settings = if let Some(file) = self.preset_file() {
            let text = read_text(file).map_err(|source| Failure::Preset { file: self.preset.clone(), source })?;
            CoatingSettings::from_ron(&text, &self.preset)?
        } else {
            CoatingSettings::preset(&self.preset).unwrap_or_else(|error| usage_error(&error.to_string()))
        };
        if self.grain.is_some() && self.settings.iter().any(|(path, _)| path == GRAIN) {
            usage_error("--grain and --set scale.grain are the same: give one of them");
        }
        let grain = self.grain.as_ref().map(|grain| (GRAIN, grain.as_str()));
        let others = self.settings.iter().map(|(path, value)| (path.as_str(), value.as_str()));
        for (path, value) in grain.into_iter().chain(others) {
            settings.set(path, value).unwrap_or_else(|error| usage_error(&error.to_string()));
        }
        settings.validate()?;
        let MaskFiles { masks, images: mask_images, .. } = masks;
        Ok(BakeOptions {
            extras: !self.ignore_extras,
            masks,
            mask_images,
            resolution: self.resolution(),
            metres_per_unit: self.metres_per_unit,
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
            exclude: self.exclude.clone(),
            detail: Detail { level: self.level, ..Detail::default() },
        })
    }
}

/// Reads a text; a pipe, which may take for ever, is refused.
fn read_text(file: &Path) -> io::Result<String> {
    let data = fs::metadata(file)?;
    if !data.is_file() && !data.is_dir() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file but a pipe or a device"));
    }
    fs::read_to_string(file)
}

/// Ends the program with code 2.
pub fn usage_error(message: &str) -> ! {
    Args::command().error(ErrorKind::ValueValidation, message).exit()
}
