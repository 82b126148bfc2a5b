//! A painted street sign on a corner of a ruined city, ageing (VC, fig. 14).
//!
//! `cargo run --example city_sign` opens a window; without a display, or with `--headless`, it renders the
//! sign at five ages into PNG files; without a graphics adapter it ages the sign and writes the model.

#![allow(clippy::disallowed_methods, reason = "the scenery is only looked at; its bits may differ between platforms")]

mod bare;
mod cli;
#[path = "../common_scene/mod.rs"]
mod common_scene;
mod debris;
mod props;
mod scene;
mod views;

use bevy::prelude::*;
use clap::Parser;
use cli::Options;
use common_scene::{graphics, headless, paint, window};

fn main() -> AppExit {
    let options = Options::parse();
    let folder = options.scene.folder("city_sign");
    if !graphics::adapter_exists() {
        return common_scene::bare::run(&folder, bare::pieces(&options));
    }
    let mut app = App::new();
    if options.scene.pictures() || !graphics::display_exists() {
        headless::add(&mut app, &options.scene, folder, views::shots(&options));
    } else {
        let size = options.scene.size.map_or(views::SIZE, UVec2::from);
        window::add(&mut app, "City sign", size, views::views(&options));
    }
    app.insert_resource(options);
    app.add_plugins((scene::ScenePlugin, props::PropsPlugin, paint::PaintPlugin, debris::DebrisPlugin));
    app.run()
}
