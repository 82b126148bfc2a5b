//! The operations that every instruction set offers.

use crate::deform::packed::point::{Point, PointOffset};

/// Vector of as many floats as fit a register.
///
/// # Safety
/// All functions may only be called where the CPU has the instruction set of the type. Pointers must be valid for
/// `WIDTH` floats or offsets, and offsets within the points. Alignment does not matter.
pub trait Lanes: Copy {
    /// Number of floats.
    const WIDTH: usize;

    /// Mask with one truth value a lane.
    type Mask: Copy;

    /// Returns `x` in all lanes.
    unsafe fn splat(x: f32) -> Self;
    unsafe fn load(from: *const f32) -> Self;
    unsafe fn store(self, to: *mut f32);
    unsafe fn add(self, other: Self) -> Self;
    unsafe fn sub(self, other: Self) -> Self;
    unsafe fn mul(self, other: Self) -> Self;
    unsafe fn div(self, other: Self) -> Self;
    unsafe fn sqrt(self) -> Self;
    /// Returns the lanes in which `self` is greater; false where either is NaN.
    unsafe fn gt(self, other: Self) -> Self::Mask;
    unsafe fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Returns `yes` where the mask holds, `no` elsewhere.
    unsafe fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Returns `self` where the mask holds, +0 elsewhere.
    unsafe fn keep(self, mask: Self::Mask) -> Self;
    /// Reads the points at `offsets`; returns their four components, a vector each.
    unsafe fn gather(points: *const Point, offsets: *const PointOffset) -> [Self; 4];
    /// Writes four components to the points at `offsets`, which are all different or written the same.
    unsafe fn scatter(points: *mut Point, offsets: *const PointOffset, components: [Self; 4]);
}
