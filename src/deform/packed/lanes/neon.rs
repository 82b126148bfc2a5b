//! Four floats: NEON, which every 64-bit ARM has.

use core::arch::aarch64::*;

use super::vector::Lanes;
use crate::deform::packed::point::{Point, PointOffset};

#[derive(Clone, Copy)]
pub struct Neon(float32x4_t);

impl Lanes for Neon {
    const WIDTH: usize = 4;

    type Mask = uint32x4_t;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        // SAFETY: the caller's, here and below.
        Self(unsafe { vdupq_n_f32(x) })
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        Self(unsafe { vld1q_f32(from) })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        unsafe { vst1q_f32(to, self.0) }
    }

    #[inline(always)]
    unsafe fn add(self, other: Self) -> Self {
        Self(unsafe { vaddq_f32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn sub(self, other: Self) -> Self {
        Self(unsafe { vsubq_f32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn mul(self, other: Self) -> Self {
        Self(unsafe { vmulq_f32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn div(self, other: Self) -> Self {
        Self(unsafe { vdivq_f32(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn sqrt(self) -> Self {
        Self(unsafe { vsqrtq_f32(self.0) })
    }

    #[inline(always)]
    unsafe fn gt(self, other: Self) -> uint32x4_t {
        unsafe { vcgtq_f32(self.0, other.0) }
    }

    #[inline(always)]
    unsafe fn and(a: uint32x4_t, b: uint32x4_t) -> uint32x4_t {
        unsafe { vandq_u32(a, b) }
    }

    #[inline(always)]
    unsafe fn select(mask: uint32x4_t, yes: Self, no: Self) -> Self {
        Self(unsafe { vbslq_f32(mask, yes.0, no.0) })
    }

    #[inline(always)]
    unsafe fn keep(self, mask: uint32x4_t) -> Self {
        Self(unsafe { vreinterpretq_f32_u32(vandq_u32(mask, vreinterpretq_u32_f32(self.0))) })
    }

    #[inline(always)]
    unsafe fn gather(points: *const Point, offsets: *const PointOffset) -> [Self; 4] {
        unsafe {
            let (a, b) = (row(points, offsets), row(points, offsets.wrapping_add(1)));
            let (c, d) = (row(points, offsets.wrapping_add(2)), row(points, offsets.wrapping_add(3)));
            let [x, y, z, w] = transpose([a, b, c, d]);
            [Self(x), Self(y), Self(z), Self(w)]
        }
    }

    #[inline(always)]
    unsafe fn scatter(points: *mut Point, offsets: *const PointOffset, [x, y, z, w]: [Self; 4]) {
        unsafe {
            let [a, b, c, d] = transpose([x.0, y.0, z.0, w.0]);
            put_row(points, offsets, a);
            put_row(points, offsets.wrapping_add(1), b);
            put_row(points, offsets.wrapping_add(2), c);
            put_row(points, offsets.wrapping_add(3), d);
        }
    }
}

#[inline(always)]
unsafe fn transpose([a, b, c, d]: [float32x4_t; 4]) -> [float32x4_t; 4] {
    unsafe {
        let (even, odd) = (vtrn1q_f32(a, b), vtrn2q_f32(a, b));
        let (even_2, odd_2) = (vtrn1q_f32(c, d), vtrn2q_f32(c, d));
        [low(even, even_2), low(odd, odd_2), high(even, even_2), high(odd, odd_2)]
    }
}

/// Returns the lower two floats of `a`, then those of `b`.
#[inline(always)]
unsafe fn low(a: float32x4_t, b: float32x4_t) -> float32x4_t {
    unsafe { vreinterpretq_f32_f64(vtrn1q_f64(vreinterpretq_f64_f32(a), vreinterpretq_f64_f32(b))) }
}

/// Returns the upper two floats of `a`, then those of `b`.
#[inline(always)]
unsafe fn high(a: float32x4_t, b: float32x4_t) -> float32x4_t {
    unsafe { vreinterpretq_f32_f64(vtrn2q_f64(vreinterpretq_f64_f32(a), vreinterpretq_f64_f32(b))) }
}

#[inline(always)]
unsafe fn row(points: *const Point, offset: *const PointOffset) -> float32x4_t {
    unsafe { vld1q_f32((*offset).of(points).cast()) }
}

#[inline(always)]
unsafe fn put_row(points: *mut Point, offset: *const PointOffset, row: float32x4_t) {
    unsafe { vst1q_f32((*offset).of_mut(points).cast(), row) }
}
