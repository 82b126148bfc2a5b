//! The paper's fig. 16: the weathering is painted. Strokes of a brush protect a ring and a wave on a sheet of metal,
//! weaken its lower corner and score a line; a heat map shows where paint will come off; then it has.
//!
//! `cargo run --example paint_brush` opens a window in which you paint yourself, over the same strokes; without a
//! display, or with `--headless`, it renders the sheet before, its heat map, and the sheet after into PNG files;
//! without a graphics adapter it ages the sheet and writes it as a model.

#![allow(clippy::disallowed_methods, reason = "the scene is only looked at; its bits may differ between platforms")]

mod bare;
mod cli;
#[path = "../common_scene/mod.rs"]
mod common_scene;
mod stage;
mod strokes;

use bevy::prelude::*;
use bevy_coating::CoatingPointingPlugin;
use clap::Parser;
use cli::Options;
use common_scene::{paint, scene::Scene, studio::StudioPlugin};

fn main() -> AppExit {
    let options = Options::parse();
    let scene = Scene::new("paint_brush", "Paint brush (right button: weaken the paint, M: heat map)", &options.scene)
        .with_keys(stage::KEYS);
    let opened = scene.open(|free| stage::views().fit(stage::SIZE, free), || stage::shots(&options));
    let Some(mut app) = opened else { return scene.bake(bare::pieces(&options)) };
    if scene.is_window() {
        app.add_plugins(CoatingPointingPlugin).add_systems(Startup, stage::take_brush);
    }
    app.insert_resource(options);
    let studio = StudioPlugin { sun: stage::sun_direction() };
    app.add_plugins((paint::PaintPlugin, studio, stage::StagePlugin, strokes::StrokesPlugin));
    app.run()
}
