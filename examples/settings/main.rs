//! What each setting does: three pieces of painted metal side by side, one with its default, two with other values.
//!
//! `cargo run --example settings` opens a window, in which number keys choose the stage; without a display, or with
//! `--headless`, it renders a picture of each stage into a PNG file; without a graphics adapter it ages the pieces and
//! writes them as models.

#![allow(clippy::disallowed_methods, reason = "the scene is only looked at; its bits may differ between platforms")]

mod bare;
mod cli;
#[path = "../common_scene/mod.rs"]
mod common_scene;
#[path = "../stains/rounded_box.rs"]
mod rounded_box;
mod rows;
mod stage;

use bevy::prelude::*;
use clap::Parser;
use cli::Options;
use common_scene::{paint, scene::Scene, studio::StudioPlugin, wall};

fn main() -> AppExit {
    let options = Options::parse();
    let scene = Scene::new("settings", "Settings", &options.scene);
    let opened = scene.open(|free| stage::views(&options).fit(stage::SIZE, free), || stage::shots(&options));
    let Some(mut app) = opened else { return scene.bake(bare::pieces(&options)) };
    app.insert_resource(options);
    let studio = StudioPlugin { sun: wall::sun_direction() };
    app.add_plugins((paint::PaintPlugin, studio, stage::StagePlugin));
    app.run()
}
