//! Defines the range of values over which a heat map spreads its colours.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::*;

/// Range of values over which a heat map spreads its colours. Values beyond an end have the colour of that end.
///
/// ```
/// use bevy_coating::heat::HeatRange;
///
/// let range = HeatRange { min: 1.0, max: 3.0 };
/// assert_eq!([0.0, 1.5, 9.0].map(|value| range.share(value)), [0.0, 0.25, 1.0]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "plugin", derive(Reflect), reflect(Debug, Clone, PartialEq), type_path = "bevy_coating::heat")]
pub struct HeatRange {
    /// Value at the lower end.
    pub min: f32,
    /// Value at the upper end. A range whose upper end is not above the lower one has two colours: below and above.
    pub max: f32,
}

impl HeatRange {
    /// Returns the place of `value` in the range: 0 at the lower end and below, 1 at the upper end and above. NaN,
    /// which has no place, gives NaN.
    pub fn share(&self, value: f32) -> f32 {
        if value.is_nan() {
            return f32::NAN;
        }
        let share = (value - self.min) / (self.max - self.min);
        // An infinite value, or a range without a length.
        if share.is_finite() {
            share.clamp(0.0, 1.0)
        } else if value > self.min {
            1.0
        } else {
            0.0
        }
    }

    /// Returns the value at the place `share` of the range: the lower end at 0, the upper one at 1.
    pub fn value(&self, share: f32) -> f32 {
        self.min + (self.max - self.min) * share
    }
}
