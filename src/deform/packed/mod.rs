//! The packed solver: the same constraints as the plain one, 32 at a time.
//!
//! From the bottom up:
//!
//! | part | module |
//! |---|---|
//! | a point of 16 bytes and its offset | [`point`] |
//! | packs of 32 constraints that share no point | [`pack`] |
//! | vectors of every instruction set | [`lanes`] |
//! | the sweeps, written once | [`kernels`] |
//! | the instruction set, chosen while the program runs | [`level`] |
//! | where vertices lie in memory, and which regions they form | [`layout`] |
//! | a film's points, in units near the mean edge, and which of them move | [`points`] |
//! | which lane holds which constraint | [`slots`] |
//! | the packs of a region, patched in place | [`region`] |
//! | the packed constraints of a film | [`constraints`] |
//!
//! All code that touches memory through pointers is in [`lanes`] and [`kernels`]; [`points`] and [`region`] keep the
//! invariant that it relies on: every offset in a pack or in the list of awake points is that of a point.

#![allow(unsafe_code, reason = "intrinsics, and loads and stores without bounds checks, in the innermost loops")]

pub mod constraints;
#[allow(clippy::undocumented_unsafe_blocks, reason = "every block needs the same, which the module says once")]
mod kernels;
#[allow(clippy::undocumented_unsafe_blocks, reason = "every block needs the same, which the module says once")]
mod lanes;
mod layout;
#[allow(clippy::undocumented_unsafe_blocks, reason = "every block needs the same, which the module says once")]
pub mod level;
pub mod pack;
mod point;
pub mod points;
mod region;
mod slots;

#[cfg(test)]
#[allow(clippy::undocumented_unsafe_blocks, reason = "every block needs the same, which the module says once")]
pub mod tests;
