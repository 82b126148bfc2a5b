//! Paint on metal that separates, cracks, curls, flakes off and rusts while a Bevy game runs.

pub mod film;
pub mod settings;
mod settings_asset;

pub use settings_asset::{CoatingSettingsLoader, CoatingSettingsLoaderError, CoatingSettingsPlugin};
