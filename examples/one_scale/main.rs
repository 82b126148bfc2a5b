//! Props of very different size under one coating: cracks and flakes have one scale, that of the grain in metres, on a
//! car, on the pedal car before it, on a hydrant, a dumpster and a lantern.
//!
//! `cargo run --example one_scale` opens a window, in which M changes between rules by the grain and the paper's;
//! without a display, or with `--headless`, it renders each view at two ages into PNG files; without a graphics adapter
//! it ages the props and writes them as models.

#![allow(clippy::disallowed_methods, reason = "the scene is only looked at; its bits may differ between platforms")]

mod bare;
mod cli;
#[path = "../common_scene/mod.rs"]
mod common_scene;
mod props;
mod stage;

use bevy::prelude::*;
use clap::Parser;
use cli::Options;
use common_scene::{graphics, headless, paint, studio::StudioPlugin, window};

fn main() -> AppExit {
    let options = Options::parse();
    let folder = options.scene.folder("one_scale");
    if !graphics::adapter_exists() {
        return common_scene::bare::run(&folder, bare::pieces(&options));
    }
    let mut app = App::new();
    if options.scene.pictures() || !graphics::display_exists() {
        headless::add(&mut app, &options.scene, folder, stage::shots(&options));
    } else {
        let size = options.scene.size.map_or(stage::SIZE, UVec2::from);
        window::add(&mut app, "One scale (M: rules by the grain or the paper's)", size, stage::views(&options));
    }
    app.insert_resource(options);
    let studio = StudioPlugin { sun: stage::sun_direction() };
    app.add_plugins((paint::PaintPlugin, studio, stage::StagePlugin, props::PropsPlugin));
    app.run()
}
