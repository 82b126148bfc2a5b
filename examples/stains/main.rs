//! What stains painted metal, each cause by itself: black stains by height, direction and curvature (VC, fig. 11),
//! rust that runs off below cracks without and with wind, and moisture in the rain and under a roof.
//!
//! `cargo run --example stains` opens a window; without a display, or with `--headless`, it renders a picture for each
//! of the three into a PNG file; without a graphics adapter it ages the pieces and writes them as models.

#![allow(clippy::disallowed_methods, reason = "the scene is only looked at; its bits may differ between platforms")]

mod bare;
mod cli;
#[path = "../common_scene/mod.rs"]
mod common_scene;
mod pieces;
mod rounded_box;
mod stage;
mod themes;
mod weather;

use bevy::prelude::*;
use clap::Parser;
use cli::Options;
use common_scene::{paint, scene::Scene, studio::StudioPlugin};

fn main() -> AppExit {
    let options = Options::parse();
    let scene = Scene::new("stains", "Stains", &options.scene);
    let opened = scene.open(|size| stage::views(&options, size), || stage::shots(&options));
    let Some(mut app) = opened else { return scene.bake(bare::pieces(&options)) };
    app.insert_resource(options);
    let studio = StudioPlugin { sun: weather::sun_direction() };
    app.add_plugins((paint::PaintPlugin, weather::WeatherPlugin, studio, stage::StagePlugin));
    app.run()
}
