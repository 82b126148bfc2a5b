//! A painted street sign on a corner of a ruined city, ageing (VC, fig. 14).
//!
//! `cargo run --example city_sign` opens a window; without a display, or with `--headless`, it renders the
//! sign at five ages into PNG files; without a graphics adapter it ages the sign and writes the model.

#![allow(clippy::disallowed_methods, reason = "the scenery is only looked at; its bits may differ between platforms")]

mod bare;
mod camera;
mod cli;
#[path = "../common/mod.rs"]
mod common;
mod debris;
mod graphics;
mod headless;
mod props;
mod scene;
mod weathering;
mod window;

use bevy::prelude::*;
use clap::Parser;
use cli::Options;

fn main() -> AppExit {
    let options = Options::parse();
    if !graphics::adapter_exists() {
        return bare::run(&options);
    }
    let windowless = options.headless || !graphics::display_exists();
    let mut app = App::new();
    if windowless {
        headless::add(&mut app, &options);
    } else {
        window::add(&mut app, &options);
    }
    app.insert_resource(options);
    app.add_plugins((scene::ScenePlugin, props::PropsPlugin, weathering::WeatheringPlugin, debris::DebrisPlugin));
    app.run()
}
