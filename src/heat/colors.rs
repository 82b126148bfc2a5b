//! Colours of heat maps.

use super::{map::HeatMap, range::HeatRange};

/// The colour map *viridis* at ten even places, from dark to bright, as sRGB bytes. It is perceptually uniform: equal
/// differences of value look like equal differences of colour, also in grey and to most colour-blind eyes. By Nathaniel
/// Smith and Stefan van der Walt for matplotlib, which gave it to the public domain (CC0).
const VIRIDIS: [[u8; 3]; 10] = [
    [0x44, 0x01, 0x54],
    [0x48, 0x28, 0x78],
    [0x3e, 0x49, 0x89],
    [0x31, 0x68, 0x8e],
    [0x26, 0x82, 0x8e],
    [0x1f, 0x9e, 0x89],
    [0x35, 0xb7, 0x79],
    [0x6e, 0xce, 0x58],
    [0xb5, 0xde, 0x2b],
    [0xfd, 0xe7, 0x25],
];

/// Colour of places without a value.
const NOTHING: [f32; 3] = [0.42; 3];

/// Share of a turn by which the hues of one kind and the next differ: that of the golden angle, so that no two of the
/// first kinds are alike.
const GOLDEN_TURN: f32 = 0.618_034;

impl HeatMap {
    /// Returns the colour of `value` where the colours are spread over `range`: sRGB, each channel from 0 to 1. NaN,
    /// which stands for no value, is grey.
    ///
    /// ```
    /// use bevy_coating::heat::{HeatMap, HeatRange};
    ///
    /// let range = HeatRange { min: 0.0, max: 2.0 };
    /// let brightness = |value| HeatMap::Adhesion.color(value, range).iter().sum::<f32>();
    /// assert!(brightness(0.0) > brightness(1.0) && brightness(1.0) > brightness(2.0), "what is next glows");
    /// ```
    pub fn color(self, value: f32, range: HeatRange) -> [f32; 3] {
        if self.is_of_kinds() {
            return kind(value);
        }
        let share = range.share(value);
        if share.is_nan() {
            return NOTHING;
        }
        viridis(if self.is_reversed() { 1.0 - share } else { share })
    }
}

/// Returns the colour at `share` of viridis, from 0 to 1.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to the last place")]
pub(super) fn viridis(share: f32) -> [f32; 3] {
    let last = VIRIDIS.len() - 1;
    let place = share.clamp(0.0, 1.0) * last as f32;
    let below = (place as usize).min(last - 1);
    let along = place - below as f32;
    core::array::from_fn(|channel| {
        let [a, b] = [below, below + 1].map(|i| f32::from(VIRIDIS[i][channel]) / 255.0);
        a + (b - a) * along
    })
}

/// Returns the colour of the kind with the number `value`: a hue of its own.
fn kind(value: f32) -> [f32; 3] {
    if !value.is_finite() {
        return NOTHING;
    }
    let hue = (value * GOLDEN_TURN).fract() * 6.0;
    // Hue to sRGB at saturation 0.6, and two brightnesses for twice as many kinds.
    let bright = if value % 2.0 == 0.0 { 0.95 } else { 0.72 };
    [5.0, 3.0, 1.0].map(|offset: f32| {
        let k = (offset + hue) % 6.0;
        bright * (1.0 - 0.6 * k.min(4.0 - k).clamp(0.0, 1.0))
    })
}
