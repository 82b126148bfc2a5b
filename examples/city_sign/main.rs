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
use common_scene::{paint, scene::Scene};

fn main() -> AppExit {
    let options = Options::parse();
    let scene = Scene::new("city_sign", "City sign", &options.scene);
    let opened = scene.open(|_| views::views(&options), || views::shots(&options));
    let Some(mut app) = opened else { return scene.bake(bare::pieces(&options)) };
    app.insert_resource(options);
    app.add_plugins((scene::ScenePlugin, props::PropsPlugin, paint::PaintPlugin, debris::DebrisPlugin));
    app.run()
}
