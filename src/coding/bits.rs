//! The ground of coding: single bits.

use super::odds::Odds;

/// Part of a film that cannot be as it was found, in words that go before "cannot be so".
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Damage(pub &'static str);

/// Writes or reads. Every function takes the number that is to be written, which does not matter when reading, and
/// gives the number that was written or read. A reader gives numbers of any value: whoever uses one as an index or a
/// length must check it.
pub(crate) trait Bits: Sized {
    /// Whether this reads.
    const READS: bool;

    /// Returns whether what is read may be anything, so that it must be checked as a whole.
    fn distrusts(&self) -> bool;

    /// Codes a bit by its odds.
    fn bit(&mut self, odds: &mut Odds, bit: bool) -> bool;

    /// Codes the `count` lowest bits, at most 32, of `bits`, whose others are 0.
    fn plain(&mut self, bits: u32, count: u32) -> u32;
}
