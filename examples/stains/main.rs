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
use common_scene::{graphics, headless, paint, studio::StudioPlugin, window};

fn main() -> AppExit {
    let options = Options::parse();
    let folder = options.scene.folder("stains");
    if !graphics::adapter_exists() {
        return common_scene::bare::run(&folder, bare::pieces(&options));
    }
    let mut app = App::new();
    if options.scene.pictures() || !graphics::display_exists() {
        headless::add(&mut app, &options.scene, folder, stage::shots(&options));
    } else {
        let size = options.scene.size.map_or(stage::SIZE, UVec2::from);
        window::add(&mut app, "Stains", size, stage::views(&options, size));
    }
    app.insert_resource(options);
    let studio = StudioPlugin { sun: weather::sun_direction() };
    app.add_plugins((paint::PaintPlugin, weather::WeatherPlugin, studio, stage::StagePlugin));
    app.run()
}
