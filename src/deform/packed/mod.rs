//! The packed solver: the same constraints as the plain one, 32 at a time.
//!
//! | part | module |
//! |---|---|
//! | points of 16 bytes, in units near the mean edge | [`points`] |
//! | packs of 32 constraints that share no point | [`pack`] |
//! | which lane holds which constraint, patched in place | [`slots`], [`region`] |
//! | vectors of every instruction set | [`lanes`] |
//! | the sweeps, written once | [`kernels`] |
//! | the instruction set, chosen while the program runs | [`level`] |
//!
//! All code that touches memory through pointers is in [`lanes`] and [`kernels`]; [`Points`] and [`Region`] keep the
//! invariant that it relies on: every index in a pack or in the list of awake points is below the number of points.

#![allow(unsafe_code, reason = "intrinsics, and loads and stores without bounds checks, in the innermost loops")]

#[allow(clippy::undocumented_unsafe_blocks, reason = "every block needs the same, which the module says once")]
mod kernels;
#[allow(clippy::undocumented_unsafe_blocks, reason = "every block needs the same, which the module says once")]
mod lanes;
#[allow(clippy::undocumented_unsafe_blocks, reason = "every block needs the same, which the module says once")]
mod level;
mod pack;
mod points;
mod region;
mod slots;

pub use level::SimdLevel;
pub use points::{Motion, Points};
pub use region::{BendLane, LengthLane, Region};
pub use slots::Blocked;

#[cfg(test)]
#[allow(clippy::undocumented_unsafe_blocks, reason = "every block needs the same, which the module says once")]
mod tests;
