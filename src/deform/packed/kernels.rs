//! The kernels, written once for any [`Lanes`].
//!
//! # Safety
//! All functions need the instruction set of their lanes, and indices within the points.

use super::{
    lanes::vector::Lanes,
    pack::{BendPack, BendTargets, LANES, LengthPack, PerLane},
    point::{Point, PointOffset},
};

/// Vector of three components, each a vector of lanes.
#[derive(Clone, Copy)]
struct Vec3<L>(L, L, L);

impl<L: Lanes> Vec3<L> {
    #[inline(always)]
    unsafe fn sub(self, o: Self) -> Self {
        unsafe { Self(self.0.sub(o.0), self.1.sub(o.1), self.2.sub(o.2)) }
    }

    #[inline(always)]
    unsafe fn add(self, o: Self) -> Self {
        unsafe { Self(self.0.add(o.0), self.1.add(o.1), self.2.add(o.2)) }
    }

    #[inline(always)]
    unsafe fn scale(self, s: L) -> Self {
        unsafe { Self(self.0.mul(s), self.1.mul(s), self.2.mul(s)) }
    }

    #[inline(always)]
    unsafe fn keep(self, mask: L::Mask) -> Self {
        unsafe { Self(self.0.keep(mask), self.1.keep(mask), self.2.keep(mask)) }
    }

    #[inline(always)]
    unsafe fn dot(self, o: Self) -> L {
        unsafe { self.0.mul(o.0).add(self.1.mul(o.1)).add(self.2.mul(o.2)) }
    }

    #[inline(always)]
    unsafe fn cross(self, o: Self) -> Self {
        unsafe {
            Self(
                self.1.mul(o.2).sub(self.2.mul(o.1)),
                self.2.mul(o.0).sub(self.0.mul(o.2)),
                self.0.mul(o.1).sub(self.1.mul(o.0)),
            )
        }
    }
}

#[inline(always)]
unsafe fn split<L: Lanes>([x, y, z, w]: [L; 4]) -> (Vec3<L>, L) {
    (Vec3(x, y, z), w)
}

#[inline(always)]
unsafe fn join<L: Lanes>(v: Vec3<L>, w: L) -> [L; 4] {
    [v.0, v.1, v.2, w]
}

/// Returns the offsets from lane `at` on.
#[inline(always)]
fn offsets_at(offsets: &PerLane<PointOffset>, at: usize) -> *const PointOffset {
    offsets.as_ptr().wrapping_add(at)
}

/// Returns the values from lane `at` on.
#[inline(always)]
fn lanes_at(values: &PerLane<f32>, at: usize) -> *const f32 {
    values.as_ptr().wrapping_add(at)
}

/// Least square of the length of the sum of two unit normals. A smaller one is that of a fully folded pair, which has
/// no neutral direction.
const MIN_NEUTRAL_SQUARED: f32 = 1e-12;

/// Least square of the length of `m` (see [`sweep_bends`]). Below, its reciprocal times what it is multiplied by may
/// leave the range of floats, and squares that it is made of may have vanished. Triangles of ordinary shape are far
/// above: in units of the mean edge it is about 4.
const LEAST_SQUARE: f32 = 1e-36;

/// Largest sum of the squares of an edge and its two medians, in units of the mean edge, for which nothing overflows:
/// with lengths below `l`, no product below exceeds `4 l^10`.
const LARGEST_PAIR: f32 = 1e7;

/// Number of packs that are read forward, as memory is read best, before the run in front of them.
const RUN: usize = 8;

/// Number of packs by which memory is asked for in advance. Caches guess poorly what comes next: a pack is read at
/// several places at once, and after each run the next one lies in front of it.
const AHEAD: usize = 2;
/// Number of groups of points by which their memory is asked for in advance.
const GROUPS_AHEAD: usize = 8;
/// Number of bytes of a line of the cache.
#[cfg(target_arch = "x86_64")]
const LINE: usize = 64;

/// Asks for what lies at `at` to be brought into the cache, where that can be asked for. Changes no result.
#[inline(always)]
fn fetch<T>(at: *const T) {
    #[cfg(target_arch = "x86_64")]
    for line in (0..size_of::<T>()).step_by(LINE) {
        use core::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
        // SAFETY: every x86-64 has the instruction, and it does nothing where there is no memory.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(at.cast::<i8>().wrapping_add(line)) };
    }
    #[cfg(not(target_arch = "x86_64"))]
    let _ = at;
}

/// Projects every bend constraint in turn (VC 4.3, appendix), in the form with 4 square roots.
///
/// With `e = p1 - p2`, `v` the middle of the edge, `a_i = v - p_i` the medians of the wings (i = 3, 4),
/// `c3 = e x a3` and `c4 = a4 x e` the normals, `n_i` their lengths, `m = n4 c3 + n3 c4` along the neutral direction,
/// `M = m.m`, `y_i = sqrt(a_i.a_i M)`, `z_i = n_i (a3.c4)`: the cosine of the wing's angle to the neutral direction is
/// `-z_i / y_i`, that of the target is `k_i = skew cos(phi0 / 2)`, and `q_i = a_i - (y_i / M) m` is the direction of
/// the printed correction. Its strain `1 - sqrt(1 + k_i) sqrt(y_i / (y_i - z_i))` is replaced by the rational
/// `-(z_i + k_i y_i) / ((2 + k_i) y_i - z_i)`, which has the same zero and the same slope there and stays bounded.
/// Corrections are shared as in [`bend_corrections`](crate::deform::bend::bend_corrections).
///
/// Finite points stay finite. Pairs that are too thin or too large for the range of floats are left alone, and the
/// strain, which is never beyond -1 to 1, is taken for noise if it comes out beyond -2 to 2.
///
/// The packs begun last, where the film came off last, are solved first: then flakes lift as they do with constraints
/// solved in the order of the mesh; the other way round they lag by some percent.
#[inline(always)]
pub(super) unsafe fn sweep_bends<L: Lanes>(points: *mut Point, packs: &[BendPack]) {
    let mut ahead = packs.rchunks(RUN).flatten();
    for _ in 0..AHEAD {
        ahead.next();
    }
    for pack in packs.rchunks(RUN).flatten() {
        if let Some(next) = ahead.next() {
            fetch(next);
        }
        for at in (0..LANES).step_by(L::WIDTH) {
            // SAFETY: `at` is within the pack and the rest is the caller's.
            unsafe { bend::<L>(points, pack, at) };
        }
    }
}

#[inline(always)]
unsafe fn bend<L: Lanes>(points: *mut Point, pack: &BendPack, at: usize) {
    unsafe {
        let [p1, p2, p3, p4] = &pack.points;
        let offsets = [offsets_at(p1, at), offsets_at(p2, at), offsets_at(p3, at), offsets_at(p4, at)];
        let (p1, w1) = split(L::gather(points, offsets[0]));
        let (p2, w2) = split(L::gather(points, offsets[1]));
        let (p3, w3) = split(L::gather(points, offsets[2]));
        let (p4, w4) = split(L::gather(points, offsets[3]));
        let (zero, one) = (L::splat(0.0), L::splat(1.0));
        let edge = p1.sub(p2);
        let middle = p1.add(p2).scale(L::splat(0.5));
        let (a3, a4) = (middle.sub(p3), middle.sub(p4));
        let (c3, c4) = (edge.cross(a3), a4.cross(edge));
        let (areas3, areas4) = (c3.dot(c3), c4.dot(c4));
        let (n3, n4) = (areas3.sqrt(), areas4.sqrt());
        let m = c3.scale(n4).add(c4.scale(n3));
        let (mm, d) = (m.dot(m), a3.dot(c4));
        let total = w1.add(w2).add(w3).add(w4);
        let (median3, median4) = (a3.dot(a3), a4.dot(a4));
        let bounded = L::splat(LARGEST_PAIR).gt(edge.dot(edge).add(median3).add(median4));
        // A face without area has no normal, a fully folded pair no neutral direction. Comparisons with NaN fail too.
        let areas = areas3.mul(areas4);
        let wide = L::and(mm.gt(areas.mul(L::splat(MIN_NEUTRAL_SQUARED))), mm.gt(L::splat(LEAST_SQUARE)));
        let valid = L::and(wide, L::and(areas.gt(zero), L::and(total.gt(zero), bounded)));
        let reciprocal = one.div(mm).keep(valid);
        let shared = Pair { m, mm, d, reciprocal, valid, bounded };
        let [fold3, fold4] = &pack.folds;
        let [rest3, rest4] = &pack.medians;
        let b3 = shared.wing(a3, median3, n3, lanes_at(fold3, at), lanes_at(rest3, at));
        let b4 = shared.wing(a4, median4, n4, lanes_at(fold4, at), lanes_at(rest4, at));
        let (without3, without4) = (total.sub(w3), total.sub(w4));
        let both = without3.add(without4);
        let share = one.div(total.mul(both)).keep(valid);
        let whole = both.mul(share);
        let edge_part = b3.scale(without3).add(b4.scale(without4)).scale(share);
        // Inverse masses are 0 or 1: leaving out is multiplying.
        let (free1, free2) = (w1.gt(zero), w2.gt(zero));
        L::scatter(points, offsets[0], join(p1.add(edge_part.keep(free1)), w1));
        L::scatter(points, offsets[1], join(p2.add(edge_part.keep(free2)), w2));
        L::scatter(points, offsets[2], join(p3.sub(b3.scale(w3.mul(whole))), w3));
        L::scatter(points, offsets[3], join(p4.sub(b4.scale(w4.mul(whole))), w4));
    }
}

/// Quantities that the wings of a pair share; see [`sweep_bends`].
#[derive(Clone, Copy)]
struct Pair<L: Lanes> {
    m: Vec3<L>,
    mm: L,
    d: L,
    reciprocal: L,
    /// Lanes whose pair has a neutral direction and anything free.
    valid: L::Mask,
    /// Lanes in which nothing overflows.
    bounded: L::Mask,
}

impl<L: Lanes> Pair<L> {
    /// Returns `-u q` of the wing with median `a` of the square length `median` and length of normal `n`. (A method, as
    /// a closure might not be inlined, and then every instruction would be a call.)
    #[inline(always)]
    unsafe fn wing(self, a: Vec3<L>, median: L, n: L, fold: *const f32, rest: *const f32) -> Vec3<L> {
        unsafe {
            let (fold, rest, one) = (L::load(fold), L::load(rest), L::splat(1.0));
            let (y, z) = (median.mul(self.mm).sqrt(), n.mul(self.d));
            let q = a.sub(self.m.scale(y.mul(self.reciprocal)));
            let rest_cosine = fold.mul(y);
            let over = z.add(rest_cosine);
            let under = y.add(y).add(rest_cosine).sub(z);
            // A stretched wing corrects less, by the square of rest over current median: otherwise corrections grow
            // with the stretch they cause.
            let stretched = median.gt(rest);
            let over = over.mul(L::select(stretched, rest, one));
            let under = under.mul(L::select(stretched, median, one));
            // Where all is right the strain is at most 1; squares that vanish may make it anything. Both hold only
            // where `under` is above 0.
            let twice = under.add(under);
            let sound = L::and(twice.gt(over), twice.gt(L::splat(0.0).sub(over)));
            let strain = over.div(under).keep(L::and(self.valid, sound));
            // Where it is not bounded, `q` may be infinite, and 0 times infinity is no number.
            q.scale(strain).keep(self.bounded)
        }
    }
}

/// Projects every length constraint in turn (VC 4.2). Finite points stay finite: those too far apart for the range of
/// floats are left alone.
#[inline(always)]
pub(super) unsafe fn sweep_lengths<L: Lanes>(points: *mut Point, packs: &[LengthPack]) {
    let mut ahead = packs.rchunks(RUN).flatten();
    for _ in 0..AHEAD {
        ahead.next();
    }
    for pack in packs.rchunks(RUN).flatten() {
        if let Some(next) = ahead.next() {
            fetch(next);
        }
        for at in (0..LANES).step_by(L::WIDTH) {
            // SAFETY: `at` is within the pack and the rest is the caller's.
            unsafe { length::<L>(points, pack, at) };
        }
    }
}

#[inline(always)]
unsafe fn length<L: Lanes>(points: *mut Point, pack: &LengthPack, at: usize) {
    unsafe {
        let offsets = [offsets_at(&pack.points[0], at), offsets_at(&pack.points[1], at)];
        let (p1, w1) = split(L::gather(points, offsets[0]));
        let (p2, w2) = split(L::gather(points, offsets[1]));
        let rest = L::load(pack.rest.as_ptr().wrapping_add(at));
        let difference = p1.sub(p2);
        let length = difference.dot(difference).sqrt();
        let under = w1.add(w2).mul(length);
        let (zero, infinity) = (L::splat(0.0), L::splat(f32::INFINITY));
        let valid = under.gt(zero);
        // The square of a huge difference is infinite, and the quotient is where a tiny one is to become long at once.
        let quotient = length.sub(rest).div(under);
        let bounded = infinity.gt(length);
        let finite = L::and(valid, quotient.gt(L::splat(f32::NEG_INFINITY)));
        let correction = difference.scale(quotient.keep(finite)).keep(bounded);
        let (free1, free2) = (w1.gt(zero), w2.gt(zero));
        L::scatter(points, offsets[0], join(p1.sub(correction.keep(free1)), w1));
        L::scatter(points, offsets[1], join(p2.add(correction.keep(free2)), w2));
    }
}

/// Returns `p`, lifted onto its plane if it is below (VC 5).
#[inline(always)]
unsafe fn above<L: Lanes>(p: Vec3<L>, normal: Vec3<L>, distance: L) -> Vec3<L> {
    unsafe {
        let height = normal.dot(p).sub(distance);
        let below = L::splat(0.0).gt(height);
        p.sub(normal.scale(height.keep(below)))
    }
}

/// Lifts onto their planes those points (VC 5) that are below, of the points at `offsets`.
#[inline(always)]
pub(super) unsafe fn project<L: Lanes>(points: *mut Point, planes: *const Point, offsets: &[PointOffset]) {
    for group in offsets.chunks_exact(L::WIDTH) {
        // SAFETY: the caller's.
        unsafe {
            let (p, w) = split(L::gather(points, group.as_ptr()));
            let (normal, distance) = split(L::gather(planes, group.as_ptr()));
            L::scatter(points, group.as_ptr(), join(above(p, normal, distance), w));
        }
    }
}

/// Moves the points at `offsets` on by `keep` of what they moved since `before`, which becomes where
/// they are now; then the half-space.
#[inline(always)]
pub(super) unsafe fn advance<L: Lanes>(
    points: *mut Point,
    before: *mut Point,
    planes: *const Point,
    offsets: &[PointOffset],
    keep: f32,
) {
    let mut ahead = offsets.get(GROUPS_AHEAD * L::WIDTH..).unwrap_or_default().chunks_exact(L::WIDTH);
    for group in offsets.chunks_exact(L::WIDTH) {
        // Points of a group mostly lie in one line or two.
        if let Some([next, ..]) = ahead.next() {
            fetch(next.of(points));
            fetch(next.of(before));
            fetch(next.of(planes));
        }
        // SAFETY: the caller's.
        unsafe {
            let (p, w) = split(L::gather(points, group.as_ptr()));
            let (last, unused) = split(L::gather(before, group.as_ptr()));
            let (normal, distance) = split(L::gather(planes, group.as_ptr()));
            let next = p.add(p.sub(last).scale(L::splat(keep)));
            L::scatter(before, group.as_ptr(), join(p, unused));
            L::scatter(points, group.as_ptr(), join(above(next, normal, distance), w));
        }
    }
}

/// Narrows the targets of a pack by `step`, down to `limit` below where they began, both times the share of each, and
/// renews its folds. Returns
/// whether any may still narrow.
#[inline(always)]
pub(super) unsafe fn narrow<L: Lanes>(pack: &mut BendPack, angles: &mut BendTargets, step: f32, limit: f32) -> bool {
    let mut ends = [0.0; LANES];
    for at in (0..LANES).step_by(L::WIDTH) {
        // SAFETY: `at` is within the pack and the rest is the caller's.
        unsafe {
            let share = L::load(angles.shares.as_ptr().wrapping_add(at));
            let end = L::load(angles.starts.as_ptr().wrapping_add(at)).sub(L::splat(limit).mul(share));
            let target = L::load(angles.targets.as_ptr().wrapping_add(at));
            let next = target.sub(L::splat(step).mul(share));
            let next = L::select(next.gt(end), next, end);
            let target = L::select(target.gt(end), next, target);
            target.store(angles.targets.as_mut_ptr().wrapping_add(at));
            target.sub(end).store(ends.as_mut_ptr().wrapping_add(at));
            let cosine = cosine_of_half(target);
            for i in 0..2 {
                let skew = L::load(angles.skews[i].as_ptr().wrapping_add(at));
                skew.mul(cosine).store(pack.folds[i].as_mut_ptr().wrapping_add(at));
            }
        }
    }
    ends.iter().any(|&left| left > 0.0)
}

/// Returns `cos(angle / 2)` for angles in -2 pi to 2 pi, to a few units of the last place of 1:
/// `1 - 2 sin^2(angle / 4)` with the sine's series up to the 11th power.
#[inline(always)]
unsafe fn cosine_of_half<L: Lanes>(angle: L) -> L {
    unsafe {
        let x = angle.mul(L::splat(0.25));
        let squared = x.mul(x);
        let terms = [1.0 / 362_880.0, -1.0 / 5_040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0];
        let mut sum = L::splat(-1.0 / 39_916_800.0);
        for term in terms {
            sum = sum.mul(squared).add(L::splat(term));
        }
        let sine = sum.mul(x);
        L::splat(1.0).sub(sine.mul(sine).mul(L::splat(2.0)))
    }
}
