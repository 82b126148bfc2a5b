//! [`CoatingSettings`] as a Bevy asset: the loader of `*.coating.ron` files.

use bevy::{
    app::{App, Plugin},
    asset::{AssetApp, AssetLoader, LoadContext, io::Reader},
    ecs::resource::Resource,
    reflect::TypePath,
};

use super::{CoatingSettings, SettingsError};

/// Makes [`CoatingSettings`] an asset that is loaded from `*.coating.ron` files and can be reflected.
///
/// `CoatingWeatheringPlugin` adds it. By itself it serves tools that only edit settings. It may be added several times,
/// in any order.
///
/// With Bevy's `file_watcher` feature a file that is edited while the game runs is loaded again; if the edit is
/// refused, the error is logged and the settings stay as they were.
#[derive(Clone, Copy, Debug, Default)]
pub struct CoatingSettingsPlugin;

impl Plugin for CoatingSettingsPlugin {
    fn build(&self, app: &mut App) {
        // To add the asset twice would forget the settings that are loaded.
        if app.world().contains_resource::<SettingsAdded>() {
            return;
        }
        app.insert_resource(SettingsAdded)
            .init_asset::<CoatingSettings>()
            .register_asset_reflect::<CoatingSettings>()
            .init_asset_loader::<CoatingSettingsLoader>();
    }

    fn is_unique(&self) -> bool {
        false
    }
}

/// Mark of an app that has the asset and its loader.
#[derive(Resource)]
struct SettingsAdded;

/// Loads [`CoatingSettings`] from RON files whose names end in `.coating.ron`. What a file leaves out has its
/// default.
#[derive(Clone, Copy, Debug, Default, TypePath)]
pub struct CoatingSettingsLoader;

/// Reason why a file of settings could not be loaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CoatingSettingsLoaderError {
    /// The file could not be read.
    #[error("could not read {file}: {source}")]
    Io {
        /// Path of the asset.
        file: String,
        /// Error of the reader.
        source: std::io::Error,
    },
    /// The file is no text.
    #[error("{file} is not UTF-8 text: {source}")]
    NotText {
        /// Path of the asset.
        file: String,
        /// Error that says at which byte the text ends.
        source: std::str::Utf8Error,
    },
    /// The text is refused. The error names the file, line and column, and the setting and its range where one is
    /// to blame.
    #[error(transparent)]
    Settings(#[from] SettingsError),
}

impl AssetLoader for CoatingSettingsLoader {
    type Asset = CoatingSettings;
    type Settings = ();
    type Error = CoatingSettingsLoaderError;

    async fn load(
        &self,
        reader: &mut dyn Reader,
        _settings: &(),
        context: &mut LoadContext<'_>,
    ) -> Result<CoatingSettings, CoatingSettingsLoaderError> {
        let file = context.path().to_string();
        let mut bytes = Vec::new();
        if let Err(source) = reader.read_to_end(&mut bytes).await {
            return Err(CoatingSettingsLoaderError::Io { file, source });
        }
        match str::from_utf8(&bytes) {
            Ok(text) => Ok(CoatingSettings::from_ron(text, &file)?),
            Err(source) => Err(CoatingSettingsLoaderError::NotText { file, source }),
        }
    }

    fn extensions(&self) -> &[&str] {
        &["coating.ron"]
    }
}
