//! Eight floats: AVX2.

use core::arch::x86_64::*;

use super::vector::Lanes;
use crate::deform::packed::point::{Point, PointOffset};

#[derive(Clone, Copy)]
pub struct Avx2(__m256);

impl Lanes for Avx2 {
    const WIDTH: usize = 8;

    type Mask = __m256;

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        // SAFETY: the caller's, here and below.
        Self(unsafe { _mm256_set1_ps(x) })
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        Self(unsafe { _mm256_loadu_ps(from) })
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        unsafe { _mm256_storeu_ps(to, self.0) }
    }

    #[inline(always)]
    unsafe fn add(self, other: Self) -> Self {
        Self(unsafe { _mm256_add_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn sub(self, other: Self) -> Self {
        Self(unsafe { _mm256_sub_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn mul(self, other: Self) -> Self {
        Self(unsafe { _mm256_mul_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn div(self, other: Self) -> Self {
        Self(unsafe { _mm256_div_ps(self.0, other.0) })
    }

    #[inline(always)]
    unsafe fn sqrt(self) -> Self {
        Self(unsafe { _mm256_sqrt_ps(self.0) })
    }

    #[inline(always)]
    unsafe fn gt(self, other: Self) -> __m256 {
        unsafe { _mm256_cmp_ps::<_CMP_GT_OQ>(self.0, other.0) }
    }

    #[inline(always)]
    unsafe fn and(a: __m256, b: __m256) -> __m256 {
        unsafe { _mm256_and_ps(a, b) }
    }

    #[inline(always)]
    unsafe fn select(mask: __m256, yes: Self, no: Self) -> Self {
        // Masks come from comparisons: all bits of a lane are alike.
        Self(unsafe { _mm256_blendv_ps(no.0, yes.0, mask) })
    }

    #[inline(always)]
    unsafe fn keep(self, mask: __m256) -> Self {
        Self(unsafe { _mm256_and_ps(mask, self.0) })
    }

    #[inline(always)]
    unsafe fn gather(points: *const Point, offsets: *const PointOffset) -> [Self; 4] {
        unsafe {
            let (a, b) = (row(points, offsets), row(points, offsets.wrapping_add(1)));
            let (c, d) = (row(points, offsets.wrapping_add(2)), row(points, offsets.wrapping_add(3)));
            let (xy, zw) = (_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
            let (xy_2, zw_2) = (_mm256_unpacklo_ps(c, d), _mm256_unpackhi_ps(c, d));
            [Self(low(xy, xy_2)), Self(high(xy, xy_2)), Self(low(zw, zw_2)), Self(high(zw, zw_2))]
        }
    }

    #[inline(always)]
    unsafe fn scatter(points: *mut Point, offsets: *const PointOffset, [x, y, z, w]: [Self; 4]) {
        unsafe {
            let (xy, xy_2) = (_mm256_unpacklo_ps(x.0, y.0), _mm256_unpackhi_ps(x.0, y.0));
            let (zw, zw_2) = (_mm256_unpacklo_ps(z.0, w.0), _mm256_unpackhi_ps(z.0, w.0));
            put_row(points, offsets, low(xy, zw));
            put_row(points, offsets.wrapping_add(1), high(xy, zw));
            put_row(points, offsets.wrapping_add(2), low(xy_2, zw_2));
            put_row(points, offsets.wrapping_add(3), high(xy_2, zw_2));
        }
    }
}

/// Reads points 0 and 4 from `offsets` on, so that lanes end up in the order of the offsets.
#[inline(always)]
unsafe fn row(points: *const Point, offsets: *const PointOffset) -> __m256 {
    unsafe {
        let row = _mm256_castps128_ps256(_mm_loadu_ps((*offsets).of(points).cast()));
        _mm256_insertf128_ps::<1>(row, _mm_loadu_ps((*offsets.wrapping_add(4)).of(points).cast()))
    }
}

/// Writes points 0 and 4 from `offsets` on.
#[inline(always)]
unsafe fn put_row(points: *mut Point, offsets: *const PointOffset, row: __m256) {
    unsafe {
        _mm_storeu_ps((*offsets).of_mut(points).cast(), _mm256_castps256_ps128(row));
        _mm_storeu_ps((*offsets.wrapping_add(4)).of_mut(points).cast(), _mm256_extractf128_ps::<1>(row));
    }
}

/// Returns the lower two floats of each 128 bits of `a`, then those of `b`.
#[inline(always)]
unsafe fn low(a: __m256, b: __m256) -> __m256 {
    unsafe { _mm256_castpd_ps(_mm256_unpacklo_pd(_mm256_castps_pd(a), _mm256_castps_pd(b))) }
}

/// Returns the upper two floats of each 128 bits of `a`, then those of `b`.
#[inline(always)]
unsafe fn high(a: __m256, b: __m256) -> __m256 {
    unsafe { _mm256_castpd_ps(_mm256_unpackhi_pd(_mm256_castps_pd(a), _mm256_castps_pd(b))) }
}
