//! Paint on metal that separates, cracks, curls, flakes off and rusts while a Bevy game runs.

#![warn(missing_docs)]
// What a user gives must end in a typed error, never in a panic.
#![warn(clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::unreachable)]

pub mod deform;
pub mod film;
pub mod fracture;
pub mod plugin;
pub mod prelude;
mod render;
pub mod settings;
mod settings_asset;
pub mod shown;
pub mod sim;

pub use settings_asset::{CoatingSettingsLoader, CoatingSettingsLoaderError, CoatingSettingsPlugin};
