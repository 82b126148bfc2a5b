//! The paper's fig. 17 and the answer to it: one plate, coarse and fine. By the paper's rules the fine plate cracks
//! more densely, and a higher alpha makes up for a part of that; by the grain, coarse and fine plates look alike.
//!
//! `cargo run --example fineness` opens a window; without a display, or with `--headless`, it renders one picture of
//! all plates into a PNG file; without a graphics adapter it ages the plates and writes them as models.

#![allow(clippy::disallowed_methods, reason = "the scene is only looked at; its bits may differ between platforms")]

mod bare;
mod cli;
#[path = "../common_scene/mod.rs"]
mod common_scene;
mod plates;
mod stage;

use bevy::prelude::*;
use clap::Parser;
use cli::Options;
use common_scene::{paint, scene::Scene, studio::StudioPlugin, wall};

fn main() -> AppExit {
    let options = Options::parse();
    let scene = Scene::new("fineness", "Fineness", &options.scene);
    let opened = scene.open(|free| stage::views().fit(stage::SIZE, free), || stage::shots(&options));
    let Some(mut app) = opened else { return scene.bake(bare::pieces(&options)) };
    app.insert_resource(options);
    let studio = StudioPlugin { sun: wall::sun_direction() };
    app.add_plugins((paint::PaintPlugin, studio, stage::StagePlugin));
    app.run()
}
