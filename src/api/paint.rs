//! Defines [`Paint`], what a coating is made with.

use bevy::{asset::Handle, reflect::prelude::*};

use super::masks::CoatingMasks;
use crate::settings::{CoatingSettings, Preset};

/// Paint that a [`Coating`](super::coating::Coating) is made with: settings, and the masks that belong to them.
///
/// A [`Preset`], [`CoatingSettings`], a handle of them and a [`SettingsSource`] convert into it. Only presets bring
/// [masks](Preset::masks).
///
/// ```
/// use bevy_coating::{Paint, prelude::*};
///
/// let hull = Paint::from(Preset::Marine);
/// assert_eq!(hull.masks.masks, Preset::Marine.masks());
/// assert!(Paint::from(CoatingSettings::from(Preset::Marine)).masks.masks.is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Paint {
    /// Settings of the ageing.
    pub settings: SettingsSource,
    /// Masks: where the paint is weak or dirty from the start.
    pub masks: CoatingMasks,
}

impl From<Preset> for Paint {
    fn from(preset: Preset) -> Self {
        Self { settings: preset.into(), masks: preset.masks().into() }
    }
}

impl From<SettingsSource> for Paint {
    fn from(settings: SettingsSource) -> Self {
        Self { settings, masks: CoatingMasks::default() }
    }
}

impl From<CoatingSettings> for Paint {
    fn from(settings: CoatingSettings) -> Self {
        SettingsSource::from(settings).into()
    }
}

impl From<Handle<CoatingSettings>> for Paint {
    fn from(settings: Handle<CoatingSettings>) -> Self {
        SettingsSource::from(settings).into()
    }
}

/// Source of a coating's settings.
///
/// [`CoatingSettings`], a [`Preset`] and a [`Handle`] convert into it.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn paint(mut commands: Commands, assets: Res<AssetServer>, mut meshes: ResMut<Assets<Mesh>>) {
///     let settings: Handle<CoatingSettings> = assets.load("hull.coating.ron");
///     let source = SettingsSource::from(settings);
///     commands.spawn((Mesh3d(meshes.add(Sphere::new(1.0))), Coating::new(source)));
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Startup, paint);
/// app.update();
/// ```
#[derive(Clone, Debug, PartialEq, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub enum SettingsSource {
    /// Settings that are stored in the component.
    Inline(CoatingSettings),
    /// Settings asset, for example of a `.coating.ron` file. The film is built once it has loaded, and takes over later
    /// changes of the asset.
    Asset(Handle<CoatingSettings>),
}

impl Default for SettingsSource {
    fn default() -> Self {
        Self::Inline(CoatingSettings::default())
    }
}

impl From<CoatingSettings> for SettingsSource {
    fn from(settings: CoatingSettings) -> Self {
        Self::Inline(settings)
    }
}

impl From<Preset> for SettingsSource {
    fn from(preset: Preset) -> Self {
        Self::Inline(preset.into())
    }
}

impl From<Handle<CoatingSettings>> for SettingsSource {
    fn from(handle: Handle<CoatingSettings>) -> Self {
        Self::Asset(handle)
    }
}
