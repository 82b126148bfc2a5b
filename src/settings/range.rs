//! The range of a setting.

use std::fmt;

/// Range of the values that a setting may have. NaN is in no range.
///
/// ```
/// use bevy_coating::settings::Range;
///
/// let octaves = Range { min: 1.0, max: 8.0, open: false, whole: true };
/// assert!(octaves.contains(8.0));
/// assert!(!octaves.contains(2.5) && !octaves.contains(f32::NAN));
/// assert_eq!(octaves.to_string(), "1 to 8 (whole numbers)");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Lower end of the range.
    pub min: f32,
    /// Upper end of the range.
    pub max: f32,
    /// Whether the ends themselves are not allowed.
    pub open: bool,
    /// Whether only whole numbers are allowed.
    pub whole: bool,
}

impl Range {
    /// Returns whether `value` is in the range.
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
