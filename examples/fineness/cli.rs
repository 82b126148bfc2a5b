//! The command line.

use crate::common_scene::cli::{SceneArgs, parse_age};
use crate::common_scene::keys;
use crate::stage;
use bevy::prelude::Resource;
use clap::Parser;

/// One plate, coarse and fine, by the paper's rules and by the grain.
#[derive(Parser, Resource, Clone, Debug)]
#[command(name = "fineness", about, after_help = keys::help(&stage::NAMES, &[]))]
pub struct Options {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Ages of the pictures: 0 is fresh paint, 1 the end of the reference run.
    #[arg(long, value_name = "AGE,..", value_delimiter = ',', default_value = "0.9", value_parser = parse_age)]
    pub ages: Vec<f64>,
    /// Straightness that makes the fine plate by the paper's rules crack less.
    #[arg(long, value_name = "COSINE", default_value_t = 0.9, value_parser = parse_alpha)]
    pub alpha: f32,
}

fn parse_alpha(text: &str) -> Result<f32, String> {
    match text.trim().parse::<f32>() {
        Ok(alpha) if alpha > -1.0 && alpha < 1.0 => Ok(alpha),
        _ => Err(format!("`{text}` is not a cosine between -1 and 1")),
    }
}
