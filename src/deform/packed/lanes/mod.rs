//! Vectors of 32-bit floats, one type for each instruction set, with the same operations on each.
//!
//! Only operations that IEEE 754 defines to the last bit are here (add, subtract, multiply, divide, square root,
//! compare and select), none is fused and none is approximate, so a kernel written once over [`Lanes`] gives the same
//! bits on every machine. Minimum and maximum are compare-and-select, as instruction sets disagree about zeros and NaN.

#[cfg(target_arch = "x86_64")]
pub(super) mod avx2;
#[cfg(target_arch = "x86_64")]
pub(super) mod avx512;
#[cfg(target_arch = "aarch64")]
pub(super) mod neon;
pub(super) mod pair;
pub(super) mod scalar;
#[cfg(target_arch = "x86_64")]
pub(super) mod sse2;

use super::points::{Point, PointOffset};

/// As many floats as fit a register.
///
/// # Safety
/// All functions may only be called where the CPU has the instruction set of the type. Pointers must be valid for
/// `WIDTH` floats or places, and places within the points. Alignment does not matter.
pub(super) trait Lanes: Copy {
    /// Number of floats.
    const WIDTH: usize;

    /// One truth value a lane.
    type Mask: Copy;

    /// `x` in all lanes.
    unsafe fn splat(x: f32) -> Self;
    unsafe fn load(from: *const f32) -> Self;
    unsafe fn store(self, to: *mut f32);
    unsafe fn add(self, other: Self) -> Self;
    unsafe fn sub(self, other: Self) -> Self;
    unsafe fn mul(self, other: Self) -> Self;
    unsafe fn div(self, other: Self) -> Self;
    unsafe fn sqrt(self) -> Self;
    /// Lanes in which `self` is greater; false where either is NaN.
    unsafe fn gt(self, other: Self) -> Self::Mask;
    unsafe fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// `yes` where the mask holds, `no` elsewhere.
    unsafe fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// `self` where the mask holds, +0 elsewhere.
    unsafe fn keep(self, mask: Self::Mask) -> Self;
    /// The four components of the points at `places`, a vector each.
    unsafe fn gather(points: *const Point, places: *const PointOffset) -> [Self; 4];
    /// Writes four components to the points at `places`, which are all different or written the same.
    unsafe fn scatter(points: *mut Point, places: *const PointOffset, components: [Self; 4]);
}
