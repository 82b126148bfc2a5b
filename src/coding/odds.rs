//! Odds of a bit, learned from the bits of its kind that came before.

/// Number of bits of a probability.
pub const PRECISION: u32 = 15;

/// Odds that a bit is 0: the mean of a quick and of a slow learner. The quick one serves short lists, the slow one long
/// ones.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Odds {
    quick: u16,
    slow: u16,
}

impl Default for Odds {
    fn default() -> Self {
        Self { quick: 1 << 14, slow: 1 << 14 }
    }
}

impl Odds {
    /// Returns the probability that the bit is 0, in parts of 2^15: never all, never none.
    #[inline]
    pub fn of_zero(self) -> u32 {
        ((u32::from(self.quick) + u32::from(self.slow)) / 2).clamp(1, (1 << PRECISION) - 1)
    }

    /// Learns that the bit was `bit`.
    #[inline]
    pub fn learn(&mut self, bit: bool) {
        let move_by = |odds: &mut u16, shift: u32| {
            if bit {
                *odds -= *odds >> shift;
            } else {
                *odds += ((1 << PRECISION) - *odds) >> shift;
            }
        };
        move_by(&mut self.quick, 4);
        move_by(&mut self.slow, 7);
    }
}
