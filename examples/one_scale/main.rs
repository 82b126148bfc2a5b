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
use common_scene::{paint, scene::Scene, studio::StudioPlugin};

fn main() -> AppExit {
    let options = Options::parse();
    let scene = Scene::new("one_scale", "One scale (M: rules by the grain or the paper's)", &options.scene);
    let opened = scene.open(|free| stage::views(&options).fit(stage::SIZE, free), || stage::shots(&options));
    let Some(mut app) = opened else { return scene.bake(bare::pieces(&options)) };
    app.insert_resource(options);
    let studio = StudioPlugin { sun: stage::sun_direction() };
    app.add_plugins((paint::PaintPlugin, studio, stage::StagePlugin, props::PropsPlugin));
    app.run()
}
