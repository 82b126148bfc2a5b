//! How a scene begins: as a window, as pictures, or, where nothing can be drawn, not at all.

use super::cli::SceneArgs;
use super::headless::{self, Shot};
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
}

impl<'a> Scene<'a> {
    pub fn new(name: &'a str, title: &'a str, args: &'a SceneArgs) -> Self {
        Self { name, title, args, is_window: !args.pictures() && graphics::display_exists() }
    }

    /// Where pictures go.
    pub fn folder(&self) -> PathBuf {
        self.args.folder(self.name)
    }

    /// Whether it is shown in a window, rather than in pictures.
    pub fn is_window(&self) -> bool {
        self.is_window
    }

    /// An app with the window, of so many pixels where the command line asks for no other, or with a camera that takes
    /// the `shots`. `None` where nothing can be drawn.
    pub fn open(
        &self,
        size: UVec2,
        views: impl FnOnce(UVec2) -> Views,
        shots: impl FnOnce() -> Vec<Shot>,
    ) -> Option<App> {
        if !graphics::adapter_exists() {
            return None;
        }
        let mut app = App::new();
        if self.is_window {
            let size = self.args.size.map_or(size, UVec2::from);
            window::add(&mut app, self.title, size, views(size));
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
