//! One float at a time: the twin that runs everywhere.

use super::vector::Lanes;
use crate::deform::packed::point::{Point, PointOffset};

#[derive(Clone, Copy)]
pub struct Scalar(f32);

impl Lanes for Scalar {
    const WIDTH: usize = 1;

    type Mask = bool;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        Self(x)
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        // SAFETY: the caller's.
        Self(unsafe { from.read_unaligned() })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        // SAFETY: the caller's.
        unsafe { to.write_unaligned(self.0) }
    }

    #[inline(always)]
    unsafe fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }

    #[inline(always)]
    unsafe fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }

    #[inline(always)]
    unsafe fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }

    #[inline(always)]
    unsafe fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }

    #[inline(always)]
    unsafe fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    #[inline(always)]
    unsafe fn gt(self, other: Self) -> bool {
        self.0 > other.0
    }

    #[inline(always)]
    unsafe fn and(a: bool, b: bool) -> bool {
        a & b
    }

    #[inline(always)]
    unsafe fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    unsafe fn keep(self, mask: bool) -> Self {
        if mask { self } else { Self(0.0) }
    }

    #[inline(always)]
    unsafe fn gather(points: *const Point, offsets: *const PointOffset) -> [Self; 4] {
        // SAFETY: the caller's.
        let Point([x, y, z, w]) = unsafe { *(*offsets).of(points) };
        [Self(x), Self(y), Self(z), Self(w)]
    }

    #[inline(always)]
    unsafe fn scatter(points: *mut Point, offsets: *const PointOffset, [x, y, z, w]: [Self; 4]) {
        // SAFETY: the caller's.
        unsafe { *(*offsets).of_mut(points) = Point([x.0, y.0, z.0, w.0]) }
    }
}
