//! One row of the table of settings: the access to a single setting by its path.

use super::{error::SettingsErrorKind, range::Range, stages::CoatingSettings};

/// Setting that is addressed by its path.
///
/// ```
/// use bevy_coating::settings::CoatingSettings;
///
/// let alpha = CoatingSettings::fields().find(|field| field.path == "tearing.alpha").unwrap();
/// let mut settings = CoatingSettings::default();
/// assert_eq!(alpha.get(&settings), 0.45);
/// alpha.set(&mut settings, 0.6)?;
/// assert!(alpha.set(&mut settings, 1.0).is_err(), "the range is open");
/// assert_eq!(settings.tearing.alpha, 0.6);
/// # Ok::<(), bevy_coating::settings::SettingsErrorKind>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Path of the setting: the name of its stage and its own name, like `tearing.alpha`.
    pub path: &'static str,
    /// Documentation of the setting in Markdown: meaning, unit and source.
    pub doc: &'static str,
    /// Range of the values that are allowed.
    pub range: Range,
    /// Names of the values, by their numbers from 0, if the setting has names; empty if it is a number.
    pub names: &'static [&'static str],
    pub(super) get: fn(&CoatingSettings) -> f32,
    pub(super) set: fn(&mut CoatingSettings, f32),
}

impl Field {
    /// Returns the value of the setting. Whole numbers are returned as `f32` too, which is exact for all in range.
    pub fn get(&self, settings: &CoatingSettings) -> f32 {
        (self.get)(settings)
    }

    /// Sets the setting to `value`.
    ///
    /// # Errors
    /// [`SettingsErrorKind::OutOfRange`] if `value` is not in the [range](Self::range). The settings are not changed
    /// then.
    pub fn set(&self, settings: &mut CoatingSettings, value: f32) -> Result<(), SettingsErrorKind> {
        self.check(value)?;
        (self.set)(settings, value);
        Ok(())
    }

    pub(super) fn check(&self, value: f32) -> Result<(), SettingsErrorKind> {
        if self.range.contains(value) {
            Ok(())
        } else {
            Err(SettingsErrorKind::OutOfRange { field: self.path, found: value, range: self.range })
        }
    }

    pub(super) fn parse(&self, text: &str) -> Result<f32, SettingsErrorKind> {
        let text = text.trim();
        if !self.names.is_empty() {
            return self.named(text);
        }
        text.parse().map_err(|_| self.malformed(format!("found `{text}`")))
    }

    /// Returns the number of the value that has a name, in any case.
    pub(super) fn named(&self, name: &str) -> Result<f32, SettingsErrorKind> {
        let number = self.names.iter().position(|known| known.eq_ignore_ascii_case(name));
        number.map(|number| number as f32).ok_or_else(|| self.malformed(format!("found `{name}`")))
    }

    /// Returns the text of the setting's value: a number, or the name that it has.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "numbers beyond all names, and NaN, have none or the nearest"
    )]
    pub fn text(&self, settings: &CoatingSettings) -> String {
        let value = self.get(settings);
        self.names.get(value as usize).map_or_else(|| value.to_string(), |name| (*name).to_owned())
    }

    /// Returns the values that are allowed, in words.
    pub fn allowed(&self) -> String {
        if self.names.is_empty() { self.range.to_string() } else { self.names.join(", ") }
    }

    pub(super) fn malformed(&self, cause: String) -> SettingsErrorKind {
        match self.names {
            [] => SettingsErrorKind::Malformed { field: self.path, range: self.range, cause },
            known => SettingsErrorKind::UnknownName { field: self.path, known: known.to_vec(), cause },
        }
    }
}
