//! The command line.

use crate::common_scene::cli::{SceneArgs, parse_age, parse_preset};
use crate::common_scene::keys;
use crate::stage;
use bevy::prelude::Resource;
use bevy_coating::prelude::*;
use bevy_coating::settings::{Rules, ScaleSettings};
use clap::{Parser, ValueEnum};

/// Props of very different size under one coating: cracks and flakes have one scale in metres.
#[derive(Parser, Resource, Clone, Debug)]
#[command(name = "one_scale", about, after_help = keys::help(&stage::NAMES, &[]))]
pub struct Options {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Ages of the pictures: 0 is fresh paint, 1 the end of the reference run.
    #[arg(long, value_name = "AGE,..", value_delimiter = ',', default_value = "0.5,0.9", value_parser = parse_age)]
    pub ages: Vec<f64>,
    /// What the camera looks at.
    #[arg(long, value_enum, default_value_t = View::All)]
    pub view: View,
    /// How the paint behaves: a preset, such as few_cracks, heavy or marine.
    #[arg(long, value_name = "NAME", default_value = "default", value_parser = parse_preset)]
    pub preset: (String, CoatingSettings),
    /// What cracks and curls are measured in; M changes it in the window.
    #[arg(long, value_enum, default_value_t = Measure::Grain)]
    pub rules: Measure,
    /// How finely paint is shown: each triangle of a film by 4 to this power.
    #[arg(long, default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=4))]
    pub level: u32,
    /// Grain, in metres.
    #[arg(long, value_name = "METRES", default_value_t = 0.04, value_parser = parse_grain)]
    grain: f32,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// All props.
    Scene,
    /// The small ones before the large ones.
    Close,
    /// Each of them (pictures only; the window starts with the scene).
    All,
}

/// What cracks and curls are measured in.
#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Metres: films of one edge length, and rules by the grain.
    Grain,
    /// Triangles: films of as many triangles on every prop, and the paper's rules.
    Paper,
}

/// Triangles of every film by the paper's rules.
const TRIANGLES: u32 = 6000;
/// Length of a film's edges by the grain, in grains: short enough for cracks to bend between them.
const EDGE: f32 = 0.85;

impl Options {
    /// Length of a film's edges by the grain, in metres.
    pub fn edge(&self) -> f32 {
        self.grain * EDGE
    }

    /// The paint of every prop, which differs by nothing but the seed.
    pub fn coating(&self, measure: Measure, seed: u64) -> Coating {
        let resolution = match measure {
            Measure::Grain => FilmResolution::EdgeLength(self.edge()),
            Measure::Paper => FilmResolution::Triangles(TRIANGLES),
        };
        let seed = self.scene.seed.wrapping_add(seed);
        let coating = Coating::new(self.settings(measure)).with_resolution(resolution).with_seed(seed);
        Coating { detail: self.scene.detail(self.level), ..coating }
    }

    pub fn settings(&self, measure: Measure) -> CoatingSettings {
        let rules = match measure {
            Measure::Grain => Rules::Grain,
            Measure::Paper => Rules::Paper,
        };
        let mut settings = self.preset.1.clone();
        settings.scale = ScaleSettings { rules, grain: self.grain };
        // Cracks are looked at here, not what darkens them.
        settings.dust.rate *= 0.3;
        settings
    }
}

fn parse_grain(text: &str) -> Result<f32, String> {
    match text.trim().parse::<f32>() {
        Ok(grain) if (0.01..=1.0).contains(&grain) => Ok(grain),
        _ => Err(format!("`{text}` is not a length from 0.01 to 1 metres")),
    }
}
