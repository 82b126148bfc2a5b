//! The command line.

use crate::common_scene::cli::SceneArgs;
use crate::common_scene::keys;
use crate::measure::figure::Figure;
use crate::measure::figures::FIGURES;
use crate::stage;
use bevy::prelude::Resource;
use clap::Parser;

/// The figures of the paper, and ours: a window to step through, or pictures and a page.
#[derive(Parser, Resource, Clone, Debug)]
#[command(name = "gallery", about, after_help = keys::help(&stage::names(), &[]))]
pub struct Options {
    #[command(flatten)]
    pub scene: SceneArgs,
    /// Which figures, by the names of their files, such as fig08,fig17; all by default. A moving picture (--animate) is
    /// of the first of them.
    #[arg(long = "figure", value_name = "NAME,..", value_delimiter = ',', value_parser = parse_figure)]
    figures: Vec<String>,
    /// Write docs/gallery.md and the small pictures of assets/gallery, too (with --headless).
    #[arg(long, requires = "headless")]
    pub page: bool,
}

impl Options {
    /// Figures that are shown, in the paper's order: those that have a picture.
    pub fn figures(&self) -> Vec<&'static Figure> {
        let wanted = |figure: &&Figure| self.figures.is_empty() || self.figures.iter().any(|name| name == figure.file);
        let shown = stage::shown().into_iter().filter(wanted);
        shown.take(if self.scene.animate.is_some() { 1 } else { usize::MAX }).collect()
    }

    /// Whether all figures are shown, so that there can be a page of them.
    pub fn is_whole(&self) -> bool {
        self.figures.is_empty() && self.scene.animate.is_none()
    }
}

fn parse_figure(name: &str) -> Result<String, String> {
    let names: Vec<&str> = FIGURES.iter().map(|figure| figure.file).filter(|file| file.starts_with("fig")).collect();
    match names.iter().find(|known| **known == name) {
        Some(known) => Ok((*known).to_owned()),
        None => Err(format!("`{name}` is none of {}", names.join(", "))),
    }
}
