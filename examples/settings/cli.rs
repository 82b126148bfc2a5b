//! The command line.

use crate::common_scene::cli::{SceneArgs, parse_age};
use crate::common_scene::keys;
use crate::rows::{self, Page};
use bevy::prelude::Resource;
use clap::Parser;

/// What each setting does: three values of it side by side.
#[derive(Parser, Resource, Clone, Debug)]
#[command(name = "settings", about, after_help = keys::help(&rows::names(), &[]))]
pub struct Options {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Stages whose settings are shown, one picture each; all by default.
    #[arg(long = "stage", value_name = "STAGE,..", value_enum, value_delimiter = ',')]
    stages: Vec<Page>,
    /// Age of the paint: 0 is fresh, 1 the end of the reference run.
    #[arg(long, value_name = "AGE", default_value_t = 0.9, value_parser = parse_age)]
    pub age: f64,
    /// How finely paint is shown: each triangle of a film by 4 to this power.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(0..=4))]
    pub level: u32,
}

impl Options {
    /// The stages that are shown, in their order.
    pub fn pages(&self) -> Vec<Page> {
        Page::ALL.into_iter().filter(|page| self.stages.is_empty() || self.stages.contains(page)).collect()
    }
}
