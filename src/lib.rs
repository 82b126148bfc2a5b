//! Paint on metal that separates, cracks, curls, flakes off and rusts while a Bevy game runs.

pub mod deform;
pub mod film;
pub mod fracture;
pub mod settings;
mod settings_asset;
pub mod sim;

pub use settings_asset::{CoatingSettingsLoader, CoatingSettingsLoaderError, CoatingSettingsPlugin};
