//! Two vectors side by side: while one waits for a division or a square root, the other goes on.

use super::vector::Lanes;
use crate::deform::packed::point::{Point, PointOffset};

#[derive(Clone, Copy)]
pub struct Pair<L>(L, L);

impl<L: Lanes> Lanes for Pair<L> {
    const WIDTH: usize = 2 * L::WIDTH;

    type Mask = (L::Mask, L::Mask);

    #[inline(always)]
    unsafe fn splat(x: f32) -> Self {
        // SAFETY: the caller's, here and below.
        unsafe { Self(L::splat(x), L::splat(x)) }
    }

    #[inline(always)]
    unsafe fn load(from: *const f32) -> Self {
        unsafe { Self(L::load(from), L::load(from.wrapping_add(L::WIDTH))) }
    }

    #[inline(always)]
    unsafe fn store(self, to: *mut f32) {
        unsafe {
            self.0.store(to);
            self.1.store(to.wrapping_add(L::WIDTH));
        }
    }

    #[inline(always)]
    unsafe fn add(self, other: Self) -> Self {
        unsafe { Self(self.0.add(other.0), self.1.add(other.1)) }
    }

    #[inline(always)]
    unsafe fn sub(self, other: Self) -> Self {
        unsafe { Self(self.0.sub(other.0), self.1.sub(other.1)) }
    }

    #[inline(always)]
    unsafe fn mul(self, other: Self) -> Self {
        unsafe { Self(self.0.mul(other.0), self.1.mul(other.1)) }
    }

    #[inline(always)]
    unsafe fn div(self, other: Self) -> Self {
        unsafe { Self(self.0.div(other.0), self.1.div(other.1)) }
    }

    #[inline(always)]
    unsafe fn sqrt(self) -> Self {
        unsafe { Self(self.0.sqrt(), self.1.sqrt()) }
    }

    #[inline(always)]
    unsafe fn gt(self, other: Self) -> Self::Mask {
        unsafe { (self.0.gt(other.0), self.1.gt(other.1)) }
    }

    #[inline(always)]
    unsafe fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask {
        unsafe { (L::and(a.0, b.0), L::and(a.1, b.1)) }
    }

    #[inline(always)]
    unsafe fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        unsafe { Self(L::select(mask.0, yes.0, no.0), L::select(mask.1, yes.1, no.1)) }
    }

    #[inline(always)]
    unsafe fn keep(self, mask: Self::Mask) -> Self {
        unsafe { Self(self.0.keep(mask.0), self.1.keep(mask.1)) }
    }

    #[inline(always)]
    unsafe fn gather(points: *const Point, offsets: *const PointOffset) -> [Self; 4] {
        unsafe {
            let [x, y, z, w] = L::gather(points, offsets);
            let [x_2, y_2, z_2, w_2] = L::gather(points, offsets.wrapping_add(L::WIDTH));
            [Self(x, x_2), Self(y, y_2), Self(z, z_2), Self(w, w_2)]
        }
    }

    #[inline(always)]
    unsafe fn scatter(points: *mut Point, offsets: *const PointOffset, [x, y, z, w]: [Self; 4]) {
        unsafe {
            L::scatter(points, offsets, [x.0, y.0, z.0, w.0]);
            L::scatter(points, offsets.wrapping_add(L::WIDTH), [x.1, y.1, z.1, w.1]);
        }
    }
}
