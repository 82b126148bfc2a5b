//! Defines [`Paint`], what a coating is made with.

use bevy::asset::Handle;

use super::{coating::SettingsSource, masks::CoatingMasks};
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
