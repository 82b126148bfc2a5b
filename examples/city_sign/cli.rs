//! The command line.

use crate::common_scene::cli::{SceneArgs, parse_age, parse_preset};
use crate::common_scene::keys;
use crate::views;
use bevy::prelude::Resource;
use bevy_coating::settings::CoatingSettings;
use clap::{Parser, ValueEnum};

/// A painted street sign on a corner of a ruined city, ageing.
#[derive(Parser, Resource, Clone, Debug)]
#[command(name = "city_sign", about, after_help = keys::help(&views::NAMES, &[]))]
pub struct Options {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Ages of the pictures: 0 is fresh paint, 1 the end of the reference run.
    #[arg(long, value_name = "AGE,..", value_delimiter = ',', value_parser = parse_age)]
    #[arg(default_value = "0,0.25,0.5,0.75,1")]
    pub ages: Vec<f64>,
    /// What the camera looks at.
    #[arg(long, value_enum, default_value_t = View::Sign)]
    pub view: View,
    /// How the paint behaves: a preset, such as few_cracks, heavy or marine.
    #[arg(long, value_name = "NAME", default_value = "default", value_parser = parse_preset)]
    pub preset: (String, CoatingSettings),
    /// Triangles of the film on the sign's plate.
    #[arg(long, default_value_t = 8000, value_parser = clap::value_parser!(u32).range(100..=200_000))]
    pub triangles: u32,
    /// How finely paint is shown: each triangle of a film by 4 to this power.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(0..=4))]
    pub level: u32,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The sign on its corner.
    Sign,
    /// The lettering from a hand's breadth away.
    Close,
    /// The whole street.
    Street,
    /// Each of them (pictures only; the window starts with the sign).
    All,
}
