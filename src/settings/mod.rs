//! Settings of a coating, grouped by the stage of the method that they steer.
//!
//! Each setting is declared once, in a table: name, type, default, range, meaning and source. The structs and their
//! documentation, the checks, the reading of files and [`set`](CoatingSettings::set) are all made from that table.
//!
//! ```
//! use bevy_coating::settings::{CoatingSettings, Preset};
//!
//! let mut settings = CoatingSettings::from(Preset::Heavy);
//! settings.tearing.alpha = 0.6;
//! settings.set("adhesion.decay", "1.1")?;
//! settings.validate()?;
//!
//! let error = CoatingSettings::from_ron("(tearing: (beta: 2.0))", "barrel.coating.ron").unwrap_err();
//! assert_eq!(error.to_string(), "barrel.coating.ron:1:18: setting `tearing.beta` is 2, but its range is 0 to 1");
//! # Ok::<(), bevy_coating::settings::SettingsError>(())
//! ```

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

#[cfg(feature = "plugin")]
pub(crate) mod asset;
mod error;
mod field;
mod presets;
mod range;
mod read;
mod rows;
mod rules;
mod stages;
mod table;
#[cfg(test)]
mod tests;
mod words;

use crate::film::{Geometry, Grain};

pub use error::{SettingsError, SettingsErrorKind, TextPosition};
pub use field::Field;
pub use presets::Preset;
pub use range::Range;
pub use rules::Rules;
pub use stages::{
    AdhesionSettings, BendingSettings, CoatingSettings, DeformSettings, DustSettings, MoistureSettings, RustSettings,
    ScaleSettings, StrippingSettings, TearingSettings,
};

impl ScaleSettings {
    /// Returns the grain of a film; `None` by the paper's rules, which have none.
    ///
    /// ```
    /// use bevy_coating::{film::Geometry, settings::{CoatingSettings, Rules}};
    ///
    /// let mut scale = CoatingSettings::default().scale;
    /// scale.rules = Rules::Grain;
    /// assert_eq!(scale.grain_of(&Geometry::default()).map(|grain| grain.length), Some(0.028));
    /// scale.rules = Rules::Paper;
    /// assert_eq!(scale.grain_of(&Geometry::default()), None);
    /// ```
    pub fn grain_of(&self, geometry: &Geometry) -> Option<Grain> {
        (self.rules == Rules::Grain).then(|| Grain::of_film(geometry, self.grain))
    }
}

impl CoatingSettings {
    /// Iterates over all settings, in the order of the structs.
    ///
    /// ```
    /// use bevy_coating::settings::CoatingSettings;
    ///
    /// let defaults = CoatingSettings::default();
    /// for field in CoatingSettings::fields() {
    ///     println!("{} = {} ({})", field.path, field.get(&defaults), field.range);
    /// }
    /// # assert!(CoatingSettings::fields().count() > 30);
    /// ```
    pub fn fields() -> impl Iterator<Item = &'static Field> {
        rows::STAGES.iter().flat_map(|stage| stage.fields)
    }

    /// Checks every setting against its range.
    ///
    /// # Errors
    /// [`SettingsErrorKind::OutOfRange`] for the first setting that is NaN, infinite or out of its range.
    ///
    /// ```
    /// use bevy_coating::settings::CoatingSettings;
    ///
    /// let mut settings = CoatingSettings::default();
    /// assert!(settings.validate().is_ok());
    /// settings.rust.into_cracks = 1.5;
    /// let error = settings.validate().unwrap_err();
    /// assert_eq!(error.to_string(), "setting `rust.into_cracks` is 1.5, but its range is 0 to 1");
    /// ```
    pub fn validate(&self) -> Result<(), SettingsError> {
        for field in Self::fields() {
            field.check(field.get(self))?;
        }
        Ok(())
    }

    /// Sets one setting, given its path and the text of its value.
    ///
    /// # Errors
    /// [`SettingsErrorKind::UnknownField`] if there is no such path, [`SettingsErrorKind::Malformed`] if the value is
    /// no number, or [`SettingsErrorKind::OutOfRange`]. The settings are not changed then.
    ///
    /// ```
    /// use bevy_coating::settings::CoatingSettings;
    ///
    /// let mut settings = CoatingSettings::default();
    /// settings.set("tearing.beta", "0.3")?;
    /// assert_eq!(settings.tearing.beta, 0.3);
    /// assert!(settings.set("tearing.beta", "often").is_err());
    /// # Ok::<(), bevy_coating::settings::SettingsError>(())
    /// ```
    pub fn set(&mut self, path: &str, value: &str) -> Result<(), SettingsError> {
        let field = Self::fields()
            .find(|field| field.path == path)
            .ok_or_else(|| SettingsErrorKind::unknown_field(path, Self::fields().map(|field| field.path)))?;
        let value = field.parse(value)?;
        Ok(field.set(self, value)?)
    }
}
