//! Says how much of a place rust covers.

use bevy_math::ops;

use crate::stain::shown::FIRST_RUST;

/// Returns the share of a place that rusted metal covers, from 0 to 1: spots of rust grow together over metal of this
/// `corrosion`.
#[inline]
pub(super) fn rusted(corrosion: f32) -> f32 {
    (corrosion * FIRST_RUST).clamp(0.0, 1.0)
}

/// Returns the share of a place that so many layers of run-off rust cover, from 0 to 1 (VC 6.1).
#[inline]
pub(super) fn stained(layers: f32) -> f32 {
    // Most places have none, and an exponential is dear.
    if layers > 0.0 { 1.0 - ops::exp(-3.0 * layers) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn covers_are_shares() {
        assert_eq!([rusted(0.0), rusted(0.125), rusted(0.9), rusted(-1.0)], [0.0, 0.4, 1.0, 0.0]);
        assert_eq!([stained(-1.0), stained(0.0)], [0.0; 2]);
        assert!(stained(0.1) > 0.25 && stained(0.1) < 0.26 && stained(100.0) == 1.0);
    }
}
