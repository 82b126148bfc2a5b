//! Sixteen floats: AVX-512F.

use core::arch::x86_64::*;

use super::vector::Lanes;
use crate::deform::packed::point::{Point, PointOffset};

#[derive(Clone, Copy)]
pub struct Avx512(__m512);

impl Lanes for Avx512 {
    const WIDTH: usize = 16;

    type Mask = __mmask16;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        // SAFETY: the caller's, here and below.
        Self(unsafe { _mm512_set1_ps(x) })
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        Self(unsafe { _mm512_loadu_ps(from) })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        unsafe { _mm512_storeu_ps(to, self.0) }
    }

    #[inline(always)]
    unsafe fn add(self, other: Self) -> Self {
        Self(unsafe { _mm512_add_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn sub(self, other: Self) -> Self {
        Self(unsafe { _mm512_sub_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn mul(self, other: Self) -> Self {
        Self(unsafe { _mm512_mul_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn div(self, other: Self) -> Self {
        Self(unsafe { _mm512_div_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn sqrt(self) -> Self {
        Self(unsafe { _mm512_sqrt_ps(self.0) })
    }

    #[inline(always)]
    unsafe fn gt(self, other: Self) -> __mmask16 {
        unsafe { _mm512_cmp_ps_mask::<_CMP_GT_OQ>(self.0, other.0) }
    }

    #[inline(always)]
    unsafe fn and(a: __mmask16, b: __mmask16) -> __mmask16 {
        a & b
    }

    #[inline(always)]
    unsafe fn select(mask: __mmask16, yes: Self, no: Self) -> Self {
        Self(unsafe { _mm512_mask_blend_ps(mask, no.0, yes.0) })
    }

    #[inline(always)]
    unsafe fn keep(self, mask: __mmask16) -> Self {
        Self(unsafe { _mm512_maskz_mov_ps(mask, self.0) })
    }

    #[inline(always)]
    unsafe fn gather(points: *const Point, offsets: *const PointOffset) -> [Self; 4] {
        unsafe {
            let (a, b) = (row(points, offsets), row(points, offsets.wrapping_add(1)));
            let (c, d) = (row(points, offsets.wrapping_add(2)), row(points, offsets.wrapping_add(3)));
            let (xy, zw) = (_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
            let (xy_2, zw_2) = (_mm512_unpacklo_ps(c, d), _mm512_unpackhi_ps(c, d));
            [Self(low(xy, xy_2)), Self(high(xy, xy_2)), Self(low(zw, zw_2)), Self(high(zw, zw_2))]
        }
    }

    #[inline(always)]
    unsafe fn scatter(points: *mut Point, offsets: *const PointOffset, [x, y, z, w]: [Self; 4]) {
        unsafe {
            let (xy, xy_2) = (_mm512_unpacklo_ps(x.0, y.0), _mm512_unpackhi_ps(x.0, y.0));
            let (zw, zw_2) = (_mm512_unpacklo_ps(z.0, w.0), _mm512_unpackhi_ps(z.0, w.0));
            put_row(points, offsets, low(xy, zw));
            put_row(points, offsets.wrapping_add(1), high(xy, zw));
            put_row(points, offsets.wrapping_add(2), low(xy_2, zw_2));
            put_row(points, offsets.wrapping_add(3), high(xy_2, zw_2));
        }
    }
}

/// Reads points 0, 4, 8 and 12 from `offsets` on, so that lanes end up in the order of the offsets.
#[inline(always)]
unsafe fn row(points: *const Point, offsets: *const PointOffset) -> __m512 {
    unsafe {
        let row = _mm512_castps128_ps512(_mm_loadu_ps((*offsets).of(points).cast()));
        let row = _mm512_insertf32x4::<1>(row, _mm_loadu_ps((*offsets.wrapping_add(4)).of(points).cast()));
        let row = _mm512_insertf32x4::<2>(row, _mm_loadu_ps((*offsets.wrapping_add(8)).of(points).cast()));
        _mm512_insertf32x4::<3>(row, _mm_loadu_ps((*offsets.wrapping_add(12)).of(points).cast()))
    }
}

/// Writes points 0, 4, 8 and 12 from `offsets` on.
#[inline(always)]
unsafe fn put_row(points: *mut Point, offsets: *const PointOffset, row: __m512) {
    unsafe {
        _mm_storeu_ps((*offsets).of_mut(points).cast(), _mm512_castps512_ps128(row));
        _mm_storeu_ps((*offsets.wrapping_add(4)).of_mut(points).cast(), _mm512_extractf32x4_ps::<1>(row));
        _mm_storeu_ps((*offsets.wrapping_add(8)).of_mut(points).cast(), _mm512_extractf32x4_ps::<2>(row));
        _mm_storeu_ps((*offsets.wrapping_add(12)).of_mut(points).cast(), _mm512_extractf32x4_ps::<3>(row));
    }
}

/// Returns the lower two floats of each 128 bits of `a`, then those of `b`.
#[inline(always)]
unsafe fn low(a: __m512, b: __m512) -> __m512 {
    unsafe { _mm512_castpd_ps(_mm512_unpacklo_pd(_mm512_castps_pd(a), _mm512_castps_pd(b))) }
}

/// Returns the upper two floats of each 128 bits of `a`, then those of `b`.
#[inline(always)]
unsafe fn high(a: __m512, b: __m512) -> __m512 {
    unsafe { _mm512_castpd_ps(_mm512_unpackhi_pd(_mm512_castps_pd(a), _mm512_castps_pd(b))) }
}
