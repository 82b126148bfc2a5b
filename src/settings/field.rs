//! One row of the settings table: how a single setting is found, read, checked and written by its path.

use super::{error::SettingsErrorKind, range::Range, stages::CoatingSettings};

/// One setting, addressed by its path.
#[derive(Clone, Copy, Debug)]
pub struct Field {
    /// Stage and name, like `tearing.alpha`.
    pub path: &'static str,
    /// Meaning, unit and source: the field's documentation.
    pub doc: &'static str,
    /// What the setting may be.
    pub range: Range,
    pub(super) get: fn(&CoatingSettings) -> f32,
    pub(super) set: fn(&mut CoatingSettings, f32),
}

impl Field {
    /// The setting's value. Whole settings come as `f32` too: all that are in their range are exact in it.
    pub fn get(&self, settings: &CoatingSettings) -> f32 {
        (self.get)(settings)
    }

    /// Sets the setting.
    ///
    /// # Errors
    /// [`SettingsErrorKind::OutOfRange`]; nothing is changed then.
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
        text.trim().parse().map_err(|_| self.malformed(format!("found `{text}`")))
    }

    pub(super) fn malformed(&self, cause: String) -> SettingsErrorKind {
        SettingsErrorKind::Malformed { field: self.path, range: self.range, cause }
    }
}
