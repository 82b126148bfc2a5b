//! One row of the settings table: how a single setting is found, read, checked and written by its path.

use std::fmt;

use super::{CoatingSettings, SettingsErrorKind};

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

/// What a setting may be: everything from `min` to `max`. NaN is in no range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Lower end.
    pub min: f32,
    /// Upper end.
    pub max: f32,
    /// Whether the ends themselves are left out.
    pub open: bool,
    /// Whether only whole numbers are allowed.
    pub whole: bool,
}

impl Range {
    /// Whether the setting may be `value`.
    pub fn contains(&self, value: f32) -> bool {
        let inside =
            if self.open { self.min < value && value < self.max } else { self.min <= value && value <= self.max };
        inside && !(self.whole && value.fract() != 0.0)
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", self.min, self.max)?;
        match (self.open, self.whole) {
            (true, _) => f.write_str(" (both excluded)"),
            (false, true) => f.write_str(" (whole numbers)"),
            (false, false) => Ok(()),
        }
    }
}
