//! Codes differences of any size: whether there is any, how many bits it has, and the bits.

use super::{bits::Bits, odds::Odds};

/// Number of bits after the leading one whose odds are learned. Those behind them are as good as random.
const LEARNED: u32 = 5;

/// Odds of the differences of one list.
#[derive(Clone, Debug)]
pub(crate) struct Differences {
    /// Whether there is any, by the size of the one before.
    any: [Odds; 3],
    /// Number of bits less 1, by the size of the one before: a tree of five bits.
    sizes: [[Odds; 32]; 3],
    /// First bits after the leading one, by the number of bits: a tree each.
    firsts: [[Odds; 1 << LEARNED]; 32],
    /// Size of the difference before: 0 for none, 1 for a small one, 2 for a large one.
    before: usize,
}

impl Default for Differences {
    fn default() -> Self {
        let odds = Odds::default();
        Self { any: [odds; 3], sizes: [[odds; 32]; 3], firsts: [[odds; 1 << LEARNED]; 32], before: 0 }
    }
}

impl Differences {
    /// Codes a difference of the list, the next one, and returns it.
    #[inline]
    #[expect(clippy::indexing_slicing, reason = "a size before is 0, 1 or 2, and a number of bits has five bits")]
    pub fn code<C: Bits>(&mut self, coder: &mut C, difference: u32) -> u32 {
        let before = self.before;
        if !coder.bit(&mut self.any[before], difference != 0) {
            self.before = 0;
            return 0;
        }
        let size = tree(coder, &mut self.sizes[before], 5, 31u32.wrapping_sub(difference.leading_zeros()) & 31);
        self.before = if size < 10 { 1 } else { 2 };
        let learned = size.min(LEARNED);
        let behind = size - learned;
        let first = difference >> behind & ((1 << learned) - 1);
        let first = tree(coder, &mut self.firsts[size as usize], learned, first);
        let rest = if behind > 0 { coder.plain(difference & ((1 << behind) - 1), behind) } else { 0 };
        1 << size | first << behind | rest
    }
}

/// Codes a number of `count` bits, the highest bit first, each by the odds that those before it leave.
#[inline]
#[expect(clippy::indexing_slicing, reason = "five bits of the node are taken")]
fn tree<C: Bits>(coder: &mut C, odds: &mut [Odds; 32], count: u32, number: u32) -> u32 {
    let mut node = 1;
    for i in (0..count).rev() {
        let bit = coder.bit(&mut odds[(node & 31) as usize], number >> i & 1 != 0);
        node = node << 1 | u32::from(bit);
    }
    node & ((1 << count) - 1)
}
