//! How a scene begins: as a window, as pictures, or, where nothing can be drawn, not at all.

use super::cli::SceneArgs;
use super::headless::{self, Shot};
use super::keys::Own;
use super::window::{self, Views};
use super::{bare, graphics};
use bevy::prelude::*;
use bevy_coating::bake::BakeError;
use std::path::PathBuf;

/// A scene that is about to begin.
pub struct Scene<'a> {
    /// Name of the example.
    name: &'a str,
    /// Title of the window.
    title: &'a str,
    args: &'a SceneArgs,
    is_window: bool,
    keys: Own,
    covered_below: f32,
}

/// Size of a window, in pixels: it fits on the displays of small computers.
const WINDOW: UVec2 = UVec2::new(1280, 720);

impl<'a> Scene<'a> {
    pub fn new(name: &'a str, title: &'a str, args: &'a SceneArgs) -> Self {
        let is_window = !args.pictures() && graphics::display_exists();
        Self { name, title, args, is_window, keys: &[], covered_below: 0.0 }
    }

    /// Sets the keys that this scene alone has.
    pub fn with_keys(self, keys: Own) -> Self {
        Self { keys, ..self }
    }

    /// Sets the height that the scene covers at the bottom of its window, in logical pixels.
    pub fn with_covered_below(self, covered_below: f32) -> Self {
        Self { covered_below, ..self }
    }

    /// Where pictures go.
    pub fn folder(&self) -> PathBuf {
        self.args.folder(self.name)
    }

    /// Whether it is shown in a window, rather than in pictures.
    pub fn is_window(&self) -> bool {
        self.is_window
    }

    /// An app with a window, or with a camera that takes the `shots`. `views` are those of a picture of so many pixels:
    /// what read-outs leave free of the window. `None` where nothing can be drawn.
    pub fn open(&self, views: impl FnOnce(UVec2) -> Views, shots: impl FnOnce() -> Vec<Shot>) -> Option<App> {
        if !graphics::adapter_exists() {
            return None;
        }
        let mut app = App::new();
        if self.is_window {
            let size = self.args.size.map_or(WINDOW, UVec2::from);
            let free = window::free_part(size.as_vec2(), self.covered_below);
            let mut views = views(free.as_uvec2());
            // They fill the height of the whole window.
            views.list.iter_mut().for_each(|(_, orbit)| orbit.distance *= size.y as f32 / free.y);
            window::add(&mut app, self.title, size, views, (self.keys, self.covered_below));
        } else {
            headless::add(&mut app, self.args, self.folder(), shots());
        }
        Some(app)
    }

    /// Ages the pieces where nothing can be drawn, and writes them as models.
    pub fn bake(&self, pieces: Result<Vec<bare::Piece>, BakeError>) -> AppExit {
        bare::run(&self.folder(), pieces)
    }
}
