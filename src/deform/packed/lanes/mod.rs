//! Vectors of 32-bit floats, one type for each instruction set, with the same operations on each.
//!
//! [`vector`] says which operations there are. Only operations that IEEE 754 defines to the last bit are among them
//! (add, subtract, multiply, divide, square root, compare and select), none is fused and none is approximate, so a
//! kernel written once over [`vector::Lanes`] gives the same bits on every machine. Minimum and maximum are
//! compare-and-select, as instruction sets disagree about zeros and NaN.

#[cfg(target_arch = "x86_64")]
pub mod avx2;
#[cfg(target_arch = "x86_64")]
pub mod avx512;
#[cfg(target_arch = "aarch64")]
pub mod neon;
#[cfg(target_arch = "x86_64")]
pub mod pair;
pub mod scalar;
#[cfg(target_arch = "x86_64")]
pub mod sse2;
pub mod vector;
