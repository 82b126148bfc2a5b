//! The paper and us, side by side: a scene for each figure of the paper (VC), with what the paper states, and numbers
//! that are measured in the same run.
//!
//! `cargo run --example gallery` opens a window in which Left and Right step through the figures; without a display, or
//! with `--headless`, it renders a picture of each into a PNG file and writes a page; with `--headless --page` the page
//! and its small pictures go into the repository, too. Without a graphics adapter it writes the page without pictures.
//! `--animate FILE --figure fig17` makes a moving picture of a figure.

#![allow(clippy::disallowed_methods, reason = "the scene is only looked at; its bits may differ between platforms")]

mod cli;
#[path = "../common_scene/mod.rs"]
mod common_scene;
mod films;
mod labels;
mod measure;
mod publish;
mod stage;
mod statement;
mod wires;

use bevy::prelude::*;
use bevy_coating::CoatingClock;
use clap::Parser;
use cli::Options;
use common_scene::{paint, scene::Scene, studio::StudioPlugin, wall};

fn main() -> AppExit {
    let options = Options::parse();
    let folder = options.scene.folder("gallery");
    let scene =
        Scene::new("gallery", "Gallery (Left, Right: figures)", &options.scene).with_covered_below(statement::HEIGHT);
    let opened = scene.open(|size| stage::views(&options, size), || stage::shots(&options));
    let Some(mut app) = opened else {
        println!("No graphics adapter was found, so nothing can be drawn: the page is written without pictures.");
        return publish::text(&folder);
    };
    if scene.is_window() {
        app.add_plugins(statement::StatementPlugin);
        app.add_systems(Startup, |mut clock: ResMut<CoatingClock>| clock.paused = true);
    }
    app.insert_resource(options.clone());
    let studio = StudioPlugin { sun: wall::sun_direction() };
    app.add_plugins((paint::PaintPlugin, studio, stage::StagePlugin, films::FilmsPlugin));
    let exit = app.run();
    if exit.is_error() || scene.is_window() || !options.is_whole() {
        return exit;
    }
    publish::page(&folder, options.page)
}
