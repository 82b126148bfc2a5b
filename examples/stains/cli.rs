//! The command line.

use crate::common_scene::cli::{SceneArgs, parse_age, parse_preset};
use crate::common_scene::keys;
use crate::themes::Theme;
use bevy::prelude::Resource;
use bevy_coating::settings::CoatingSettings;
use clap::Parser;

/// Painted test pieces side by side, stained by dust, rust and rain.
#[derive(Parser, Resource, Clone, Debug)]
#[command(name = "stains", about, after_help = keys::help(&Theme::ALL.map(|theme| theme.name()), &[]))]
pub struct Options {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Ages of the pictures: 0 is fresh paint, 1 the end of the reference run.
    #[arg(long, value_name = "AGE,..", value_delimiter = ',', default_value = "0.8", value_parser = parse_age)]
    pub ages: Vec<f64>,
    /// What is shown, one picture each; all by default.
    #[arg(long = "theme", value_name = "THEME,..", value_enum, value_delimiter = ',')]
    themes: Vec<Theme>,
    /// How the paint behaves but for what a row shows: a preset, such as few_cracks, heavy or marine.
    #[arg(long, value_name = "NAME", default_value = "default", value_parser = parse_preset)]
    pub preset: (String, CoatingSettings),
    /// Triangles of the film on each piece.
    #[arg(long, default_value_t = 4000, value_parser = clap::value_parser!(u32).range(100..=100_000))]
    pub triangles: u32,
}

impl Options {
    /// Each once, in their own order.
    pub fn themes(&self) -> Vec<Theme> {
        Theme::ALL.into_iter().filter(|theme| self.themes.is_empty() || self.themes.contains(theme)).collect()
    }
}
