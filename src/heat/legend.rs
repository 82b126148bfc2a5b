//! Places and texts of the legend beside a heat map.

use super::{map::HeatMap, range::HeatRange};

/// Mark on the legend of a heat map.
#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Place along the range: 0 at the lower end, 1 at the upper one.
    pub share: f32,
    /// Value at this place.
    pub value: f32,
    /// Text of the mark: a number of even width, or a name.
    pub text: String,
}

impl HeatMap {
    /// Returns the marks of a legend from the lower end of `range` to the upper one: names where the map has them,
    /// otherwise five numbers with as many decimals as they need to differ. Kinds have no legend.
    ///
    /// ```
    /// use bevy_coating::heat::{HeatMap, HeatRange};
    ///
    /// let texts = |map: HeatMap| map.legend(map.range()).into_iter().map(|tick| tick.text).collect::<Vec<_>>();
    /// assert_eq!(texts(HeatMap::Adhesion), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
    /// assert_eq!(texts(HeatMap::Sources), ["never", "past", "present"]);
    /// assert!(texts(HeatMap::Pieces).is_empty());
    /// ```
    pub fn legend(self, range: HeatRange) -> Vec<Tick> {
        if self.is_of_kinds() {
            return Vec::new();
        }
        if self == Self::Sources {
            let names = [(0.0, "never"), (0.5, "past"), (1.0, "present")];
            return names.map(|(value, name)| Tick { share: value, value, text: name.to_owned() }).into();
        }
        let decimals = decimals(range);
        let tick = |i: u8| {
            let share = f32::from(i) / 4.0;
            let value = range.value(share);
            Tick { share, value, text: format!("{value:.decimals$}") }
        };
        (0..=4).map(tick).collect()
    }
}

/// Returns the number of decimals with which quarters of `range` differ.
fn decimals(range: HeatRange) -> usize {
    let quarter = ((range.max - range.min) / 4.0).abs();
    let mut decimals = 0;
    let mut digit = 1.0;
    // Up to six decimals; a quarter like 0.025 needs one more than the size of its first digit says.
    while decimals < 6 && (quarter < digit || ((quarter / digit).fract() * 1e3).round() % 1e3 != 0.0) {
        decimals += 1;
        digit /= 10.0;
    }
    decimals
}
