//! Four floats: SSE2, which every x86-64 has.

use core::arch::x86_64::*;

use super::vector::Lanes;
use crate::deform::packed::point::{Point, PointOffset};

#[derive(Clone, Copy)]
pub struct Sse2(__m128);

impl Lanes for Sse2 {
    const WIDTH: usize = 4;

    type Mask = __m128;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        // SAFETY: the caller's, here and below.
        Self(unsafe { _mm_set1_ps(x) })
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        Self(unsafe { _mm_loadu_ps(from) })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        unsafe { _mm_storeu_ps(to, self.0) }
    }

    #[inline(always)]
    unsafe fn add(self, other: Self) -> Self {
        Self(unsafe { _mm_add_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn sub(self, other: Self) -> Self {
        Self(unsafe { _mm_sub_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn mul(self, other: Self) -> Self {
        Self(unsafe { _mm_mul_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn div(self, other: Self) -> Self {
        Self(unsafe { _mm_div_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn sqrt(self) -> Self {
        Self(unsafe { _mm_sqrt_ps(self.0) })
    }

    #[inline(always)]
    unsafe fn gt(self, other: Self) -> __m128 {
        unsafe { _mm_cmpgt_ps(self.0, other.0) }
    }

    #[inline(always)]
    unsafe fn and(a: __m128, b: __m128) -> __m128 {
        unsafe { _mm_and_ps(a, b) }
    }

    #[inline(always)]
    unsafe fn select(mask: __m128, yes: Self, no: Self) -> Self {
        Self(unsafe { _mm_or_ps(_mm_and_ps(mask, yes.0), _mm_andnot_ps(mask, no.0)) })
    }

    #[inline(always)]
    unsafe fn keep(self, mask: __m128) -> Self {
        Self(unsafe { _mm_and_ps(mask, self.0) })
    }

    #[inline(always)]
    unsafe fn gather(points: *const Point, offsets: *const PointOffset) -> [Self; 4] {
        unsafe {
            let (a, b) = (row(points, offsets), row(points, offsets.wrapping_add(1)));
            let (c, d) = (row(points, offsets.wrapping_add(2)), row(points, offsets.wrapping_add(3)));
            let (xy, zw) = (_mm_unpacklo_ps(a, b), _mm_unpackhi_ps(a, b));
            let (xy_2, zw_2) = (_mm_unpacklo_ps(c, d), _mm_unpackhi_ps(c, d));
            [
                Self(_mm_movelh_ps(xy, xy_2)),
                Self(_mm_movehl_ps(xy_2, xy)),
                Self(_mm_movelh_ps(zw, zw_2)),
                Self(_mm_movehl_ps(zw_2, zw)),
            ]
        }
    }

    #[inline(always)]
    unsafe fn scatter(points: *mut Point, offsets: *const PointOffset, [x, y, z, w]: [Self; 4]) {
        unsafe {
            let (xy, xy_2) = (_mm_unpacklo_ps(x.0, y.0), _mm_unpackhi_ps(x.0, y.0));
            let (zw, zw_2) = (_mm_unpacklo_ps(z.0, w.0), _mm_unpackhi_ps(z.0, w.0));
            put_row(points, offsets, _mm_movelh_ps(xy, zw));
            put_row(points, offsets.wrapping_add(1), _mm_movehl_ps(zw, xy));
            put_row(points, offsets.wrapping_add(2), _mm_movelh_ps(xy_2, zw_2));
            put_row(points, offsets.wrapping_add(3), _mm_movehl_ps(zw_2, xy_2));
        }
    }
}

#[inline(always)]
unsafe fn row(points: *const Point, offset: *const PointOffset) -> __m128 {
    unsafe { _mm_loadu_ps((*offset).of(points).cast()) }
}

#[inline(always)]
unsafe fn put_row(points: *mut Point, offset: *const PointOffset, row: __m128) {
    unsafe { _mm_storeu_ps((*offset).of_mut(points).cast(), row) }
}
