//! The range of a setting.

use std::fmt;

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
