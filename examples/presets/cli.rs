//! The command line.

use crate::common_scene::cli::{SceneArgs, parse_age};
use crate::common_scene::keys;
use crate::stage;
use bevy::prelude::Resource;
use clap::Parser;

/// The presets side by side: twelve ways in which paint grows old.
#[derive(Parser, Resource, Clone, Debug)]
#[command(name = "presets", about, after_help = keys::help(&stage::names(), &[]))]
pub struct Options {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Age of the pictures: 0 is fresh paint, 1 the end of the reference run.
    #[arg(long, value_name = "AGE", default_value_t = 0.8, value_parser = parse_age)]
    pub age: f64,
    /// How finely paint is shown: each triangle of a film by 4 to this power.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(0..=4))]
    pub level: u32,
}
