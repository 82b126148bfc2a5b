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
    /// Returns the probability that the bit is 0, in parts of 2^15: never all, never none, as a learner stops short of
    /// both.
    #[inline]
    pub fn of_zero(self) -> u32 {
        (u32::from(self.quick) + u32::from(self.slow)) / 2
    }

    /// Learns that the bit was `bit`.
    #[inline]
    pub fn learn(&mut self, bit: bool) {
        self.quick = learned::<4>(self.quick, bit);
        self.slow = learned::<7>(self.slow, bit);
    }
}

/// Returns odds that have learned. Both ways are computed and one is taken: nobody can foretell which, so that a
/// branch would cost more.
#[inline]
fn learned<const SHIFT: u32>(odds: u16, bit: bool) -> u16 {
    let (down, up) = (odds - (odds >> SHIFT), odds + (((1 << PRECISION) - odds) >> SHIFT));
    let mask = u16::from(bit).wrapping_neg();
    (down & mask) | (up & !mask)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn odds_are_never_all_or_none() {
        for bit in [true, false] {
            let mut odds = Odds::default();
            (0..10_000).for_each(|_| odds.learn(bit));
            assert!((1..1 << PRECISION).contains(&odds.of_zero()), "{}", odds.of_zero());
            let least = if bit { odds.of_zero() } else { (1 << PRECISION) - odds.of_zero() };
            assert!(least < 100, "they come near: {least}");
        }
    }
}
