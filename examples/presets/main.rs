//! The presets side by side: twelve ways in which paint grows old, on cans of one size.
//!
//! `cargo run --example presets` opens a window, in which number keys choose the view; without a display, or with
//! `--headless`, it renders all cans and each real paint into PNG files; without a graphics adapter it ages the cans
//! and writes them as models.

#![allow(clippy::disallowed_methods, reason = "the scene is only looked at; its bits may differ between platforms")]

mod bare;
mod cans;
mod cli;
#[path = "../common_scene/mod.rs"]
mod common_scene;
#[path = "../stains/rounded_box.rs"]
mod rounded_box;
mod stage;

use bevy::prelude::*;
use clap::Parser;
use cli::Options;
use common_scene::{paint, scene::Scene, studio::StudioPlugin, wall};

fn main() -> AppExit {
    let options = Options::parse();
    let scene = Scene::new("presets", "Presets", &options.scene);
    let opened = scene.open(|free| stage::views().fit(stage::SIZE, free), || stage::shots(&options));
    let Some(mut app) = opened else { return scene.bake(bare::pieces(&options)) };
    app.insert_resource(options);
    let studio = StudioPlugin { sun: wall::sun_direction() };
    app.add_plugins((paint::PaintPlugin, studio, stage::StagePlugin));
    app.run()
}
