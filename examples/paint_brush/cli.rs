//! The command line.

use crate::common_scene::cli::{SceneArgs, parse_age};
use crate::common_scene::keys;
use crate::stage;
use bevy::prelude::Resource;
use bevy_coating::prelude::*;
use clap::Parser;

/// Weathering that is painted: before, its heat map, and after.
#[derive(Parser, Resource, Clone, Debug)]
#[command(name = "paint_brush", about, after_help = keys::help(&stage::NAMES, stage::KEYS))]
pub struct Options {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Age of the last picture: 0 is fresh paint, 1 the end of the reference run.
    #[arg(long, default_value_t = 1.0, value_parser = parse_age)]
    pub age: f64,
    /// Triangles of the sheet.
    #[arg(long, default_value_t = 8_000, value_parser = clap::value_parser!(u32).range(500..=40_000))]
    pub triangles: u32,
}

impl Options {
    /// The paint of the sheet.
    pub fn coating(&self) -> Coating {
        let mut settings = CoatingSettings::from(Preset::Harsh);
        // Cracks are looked at here, not what darkens them.
        settings.dust.rate *= 0.3;
        Coating::new(settings).with_seed(self.scene.seed).with_triangles(self.triangles)
    }
}
