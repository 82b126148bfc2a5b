//! What a user can set, grouped by the stage of the method that it steers.
//!
//! Every setting is declared once, in the table of `stages.rs`: name, type, default, range, meaning and where it
//! comes from. The structs, their documentation, validation, reading, `--set path=value`, reflection and the table
//! of the README all follow from there.
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

#[cfg(feature = "plugin")]
pub(crate) mod asset;
mod error;
mod field;
mod presets;
mod range;
mod read;
mod rows;
mod stages;
mod table;
#[cfg(test)]
mod tests;

pub use error::{SettingsError, SettingsErrorKind, TextPosition};
pub use field::Field;
pub use presets::Preset;
pub use range::Range;
pub use stages::{
    AdhesionSettings, BendingSettings, CoatingSettings, DeformSettings, DustSettings, MoistureSettings, RustSettings,
    StrippingSettings, TearingSettings,
};

impl CoatingSettings {
    /// Every setting, in the order of the structs.
    pub fn fields() -> impl Iterator<Item = &'static Field> {
        rows::STAGES.iter().flat_map(|stage| stage.fields)
    }

    /// Checks every setting against its range.
    ///
    /// # Errors
    /// [`SettingsErrorKind::OutOfRange`] for the first setting that is NaN, infinite or out of its range.
    pub fn validate(&self) -> Result<(), SettingsError> {
        for field in Self::fields() {
            field.check(field.get(self))?;
        }
        Ok(())
    }

    /// Sets one setting by its path, as in `settings.set("tearing.beta", "0.3")`.
    ///
    /// # Errors
    /// [`SettingsErrorKind::UnknownField`], [`SettingsErrorKind::Malformed`] or [`SettingsErrorKind::OutOfRange`];
    /// nothing is changed then.
    pub fn set(&mut self, path: &str, value: &str) -> Result<(), SettingsError> {
        let field = Self::fields()
            .find(|field| field.path == path)
            .ok_or_else(|| SettingsErrorKind::unknown_field(path, Self::fields().map(|field| field.path)))?;
        let value = field.parse(value)?;
        Ok(field.set(self, value)?)
    }
}
