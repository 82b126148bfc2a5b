//! Codes numbers that can nearly be foretold, to the bit: the ground of snapshots.
//!
//! Whoever saves a number says what it expects; only the difference is coded, in few bits where it is small and in
//! almost none where there is none. The same function writes and reads: it is given a `Coder`, which either takes
//! the number or replaces it. So the two directions cannot differ, and what is expected wrongly costs bytes, never bits
//! of the result.
//!
//! | part | module |
//! |---|---|
//! | bits whose odds are learned as they come | `odds` |
//! | the range coder: such bits in the space that they deserve | `range_coder` |
//! | differences of any size | `difference` |
//! | single bits, written or read | `bits` |
//! | what a part of a film codes itself with | `coder` |
//! | coded bytes as serde data | `serial` |

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

mod bits;
mod coder;
mod difference;
mod odds;
mod range_coder;
mod serial;
#[cfg(test)]
mod tests;

pub(crate) use bits::Damage;
pub(crate) use coder::{Coder, number};
pub(crate) use difference::Differences;
pub(crate) use odds::Odds;
pub(crate) use range_coder::{Reader, Writer};
pub(crate) use serial::deserialize_bytes;
