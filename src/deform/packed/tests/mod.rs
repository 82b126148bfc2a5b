//! Every instruction set against the scalar twin, bit for bit; the kernels against the plain forms.

mod finite;
mod levels;

use bevy_math::{Vec3, ops};
use proptest::prelude::*;

use self::levels::levels;
use super::{
    kernels,
    lanes::{self, vector::Lanes},
    level::{Kernels, SimdLevel},
    pack::{BendPack, BendTargets, LANES, LengthPack},
    point::{Point, PointOffset},
};
use crate::{
    deform::{
        bend::{BendConstraint, bend_corrections},
        length::length_corrections,
    },
    film::{HalfEdgeId, signed_dihedral},
};

/// Returns the bits of `points`. Nothing that is not finite is to be among them, and so no NaN, which has many bit
/// patterns.
fn bits(points: &[Point]) -> Vec<[u32; 4]> {
    assert!(points.iter().flat_map(|p| p.0).all(f32::is_finite));
    points.iter().map(|p| p.0.map(f32::to_bits)).collect()
}

/// Coordinates as they occur, and such as break things: zeros of both signs, huge and tiny ones.
fn coordinate() -> impl Strategy<Value = f32> {
    prop_oneof![
        20 => -3.0f32..3.0,
        1 => prop::sample::select(vec![0.0, -0.0, 1e-30, -1e-42, 1e18, -1e30]),
    ]
}

fn point() -> impl Strategy<Value = Point> {
    ([coordinate(), coordinate(), coordinate()], prop::bool::ANY)
        .prop_map(|([x, y, z], free)| Point([x, y, z, if free { 1.0 } else { 0.0 }]))
}

/// A null plane, then so many random ones, with normals no longer than about 1.
fn planes(count: usize) -> impl Strategy<Value = Vec<Point>> {
    let plane = ((-1.0f32..1.0, -1.0f32..1.0, -1.0f32..1.0), coordinate());
    prop::collection::vec(plane.prop_map(|((x, y, z), distance)| Point([x, y, z, distance])), count).prop_map(
        |mut planes| {
            planes.insert(0, Point::default());
            planes
        },
    )
}

/// A null point, then so many random ones.
fn points(count: usize) -> impl Strategy<Value = Vec<Point>> {
    prop::collection::vec(point(), count).prop_map(|mut points| {
        points.insert(0, Point::default());
        points
    })
}

/// Lane `i` of list `k` gets point `1 + k * 32 + i`.
fn offsets<const N: usize>() -> [[PointOffset; LANES]; N] {
    std::array::from_fn(|k| std::array::from_fn(|i| PointOffset::new(1 + k * LANES + i)))
}

fn floats(range: std::ops::Range<f32>) -> impl Strategy<Value = [f32; LANES]> {
    prop::collection::vec(range, LANES).prop_map(|values| values.try_into().unwrap())
}

fn bend_pack() -> impl Strategy<Value = BendPack> {
    ([floats(-1.0..1.0), floats(-1.0..1.0)], [floats(0.0..2.0), floats(0.0..2.0)])
        .prop_map(|(folds, medians)| BendPack { points: offsets(), folds, medians })
}

proptest! {
    #[test]
    fn bends_are_the_same_bits_at_every_level(points in points(4 * LANES), pack in bend_pack()) {
        let solve = |level| {
            let mut points = points.clone();
            unsafe { (Kernels::of(level).sweep_bends)(points.as_mut_ptr(), std::slice::from_ref(&pack)) };
            bits(&points)
        };
        let twin = solve(SimdLevel::Scalar);
        for level in levels() {
            prop_assert_eq!(&solve(level), &twin, "{}", level.name());
        }
    }

    #[test]
    fn lengths_are_the_same_bits_at_every_level(points in points(2 * LANES), rest in floats(0.0..2.0)) {
        let pack = LengthPack { points: offsets(), rest };
        let solve = |level| {
            let mut points = points.clone();
            unsafe { (Kernels::of(level).sweep_lengths)(points.as_mut_ptr(), std::slice::from_ref(&pack)) };
            bits(&points)
        };
        let twin = solve(SimdLevel::Scalar);
        for level in levels() {
            prop_assert_eq!(&solve(level), &twin, "{}", level.name());
        }
    }

    #[test]
    fn momentum_and_half_space_are_the_same_bits_at_every_level(
        now in points(LANES), before in points(LANES), planes in planes(LANES), keep in 0.0f32..1.0,
    ) {
        let [awake] = offsets::<1>();
        let run = |level| {
            let (mut now, mut before) = (now.clone(), before.clone());
            let kernels = Kernels::of(level);
            unsafe {
                (kernels.advance)(now.as_mut_ptr(), before.as_mut_ptr(), planes.as_ptr(), &awake, keep);
                (kernels.project)(now.as_mut_ptr(), planes.as_ptr(), &awake);
            }
            (bits(&now), bits(&before))
        };
        let twin = run(SimdLevel::Scalar);
        for level in levels() {
            prop_assert_eq!(&run(level), &twin, "{}", level.name());
        }
    }

    #[test]
    fn narrowing_is_the_same_bits_at_every_level_and_its_cosine_is_right(
        starts in floats(0.1..6.2), skews in [floats(0.0..1.0), floats(0.0..1.0)],
        shares in prop_oneof![Just([1.0; LANES]), floats(0.0..3.0)], step in 0.0f32..0.5, limit in 0.0f32..3.0,
    ) {
        let run = |level| {
            let mut pack = BendPack::NULL;
            let mut angles = BendTargets { skews, starts, targets: starts, shares };
            let narrow = Kernels::of(level).narrow;
            let narrowing = unsafe { narrow(&mut pack, &mut angles, step, limit) };
            (pack, angles, narrowing)
        };
        let twin = run(SimdLevel::Scalar);
        for level in levels() {
            prop_assert_eq!(&run(level), &twin, "{}", level.name());
        }
        let (pack, angles, narrowing) = twin;
        prop_assert_eq!(narrowing, (0..LANES).any(|i| angles.targets[i] > starts[i] - limit * shares[i]));
        for i in 0..LANES {
            let expected = starts[i] - shares[i] * if step < limit { step } else { limit };
            prop_assert!((angles.targets[i] - expected).abs() < 2e-6);
            for (skew, fold) in [0, 1].map(|wing| (skews[wing][i], pack.folds[wing][i])) {
                prop_assert!((fold - skew * ops::cos(angles.targets[i] * 0.5)).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn a_packed_length_is_the_plain_one(a in point_near(), b in point_near(), rest in 0.1f32..2.0, free in 1u8..4) {
        let w = [free & 1, free >> 1].map(f32::from);
        let Some(d) = length_corrections([a, b], w, rest) else { return Ok(()) };
        let mut points = [Point::default(), at(a, w[0]), at(b, w[1])];
        let mut pack = LengthPack::NULL;
        (pack.points[0][5], pack.points[1][5], pack.rest[5]) = (PointOffset::new(1), PointOffset::new(2), rest);
        unsafe { kernels::sweep_lengths::<lanes::scalar::Scalar>(points.as_mut_ptr(), &[pack]) };
        prop_assert!((xyz(points[1]) - a - d[0]).length() < 1e-5 && (xyz(points[2]) - b - d[1]).length() < 1e-5);
        prop_assert_eq!(points[0], Point::default());
    }

    #[test]
    fn a_packed_bend_goes_the_way_of_the_plain_one(
        angle in 1.5f32..4.8, turn in -0.2f32..0.2, heights in [0.5f32..1.2, 0.5f32..1.2], free in 1u8..16,
    ) {
        let (sin, cos) = ops::sin_cos(angle);
        let tips = [Vec3::new(-heights[0], 0.4, 0.0), Vec3::new(-cos * heights[1], 0.6, sin * heights[1])];
        let p = [Vec3::ZERO, Vec3::Y, tips[0], tips[1]];
        let start = signed_dihedral(p[0], p[1], p[2], p[3]).unwrap();
        let mut plain = BendConstraint::new(HalfEdgeId(0), [0, 1, 2, 3], p, start);
        plain.set_target(plain.start + turn);
        let w = [0, 1, 2, 3].map(|i| if free & (1 << i) != 0 { 1.0 } else { 0.0 });
        let d = bend_corrections(p, w, plain.reach, plain.rest_medians).unwrap();
        let mut points = [Point::default(), at(p[0], w[0]), at(p[1], w[1]), at(p[2], w[2]), at(p[3], w[3])];
        let mut pack = BendPack::NULL;
        for i in 0..4 {
            pack.points[i][9] = PointOffset::new(i + 1);
        }
        for i in 0..2 {
            pack.folds[i][9] = plain.skew[i] * ops::cos(plain.target * 0.5);
            pack.medians[i][9] = plain.rest_medians[i] * plain.rest_medians[i];
        }
        unsafe { kernels::sweep_bends::<lanes::scalar::Scalar>(points.as_mut_ptr(), &[pack]) };
        // The strain of a wing that rests at the cosine k and is at c is `1 - sqrt(x)` in the printed form and `(1 - x)
        // / (1 + x)` here, with `x = (1 + k) / (1 + c)`: they differ by the share s / 2 of the strain s, to first
        // order. A wing's pull moves no point farther than its share of the mass.
        let edge = (p[1] - p[0]).normalize();
        let altitudes = tips.map(|tip| (tip - edge * edge.dot(tip)).normalize());
        let neutral = {
            let normals = [edge.cross(altitudes[0]), altitudes[1].cross(edge)];
            (normals[0] + normals[1]).normalize()
        };
        let (mut strain, mut pull) = (0.0f32, 0.0f32);
        for i in 0..2 {
            let median = tips[i] - Vec3::Y * 0.5;
            let (cosine, rest) = (neutral.dot(median) / median.length(), plain.skew[i] * ops::cos(plain.target * 0.5));
            strain = strain.max((1.0 - ((1.0 + rest) / (1.0 + cosine)).sqrt()).abs());
            let free = bend_corrections(p, [1.0; 4], plain.reach, plain.rest_medians).unwrap();
            pull = pull.max(4.0 * free[i + 2].length());
        }
        let share = pull / w.iter().sum::<f32>();
        for i in 0..4 {
            let moved = xyz(points[i + 1]) - p[i];
            let allowed = 0.6 * strain * share + 2e-6;
            prop_assert!((moved - d[i]).length() <= allowed, "{i}: {moved} for {}, strain {strain}", d[i]);
        }
        prop_assert_eq!(points[0], Point::default());
    }
}

fn point_near() -> impl Strategy<Value = Vec3> {
    (-1.0f32..1.0, -1.0f32..1.0, -1.0f32..1.0).prop_map(|(x, y, z)| Vec3::new(x, y, z))
}

fn at(p: Vec3, mass: f32) -> Point {
    Point(p.extend(mass).to_array())
}

fn xyz(Point([x, y, z, _]): Point) -> Vec3 {
    Vec3::new(x, y, z)
}

#[test]
fn degenerate_pairs_and_lengths_are_left_alone() {
    let folded = [Vec3::ZERO, Vec3::Y, Vec3::new(-1.0, 0.5, 0.0), Vec3::new(-1.0, 0.5, 0.0)];
    for p in [[Vec3::ZERO, Vec3::Y, Vec3::Y * 0.5, Vec3::X], folded, [Vec3::ONE; 4]] {
        let mut points = [Point::default(), at(p[0], 1.0), at(p[1], 1.0), at(p[2], 1.0), at(p[3], 1.0)];
        let before = points;
        let mut pack = BendPack::NULL;
        for i in 0..4 {
            pack.points[i][0] = PointOffset::new(i + 1);
        }
        (pack.medians[0][0], pack.medians[1][0]) = (1.0, 1.0);
        unsafe { (Kernels::of(SimdLevel::best()).sweep_bends)(points.as_mut_ptr(), &[pack]) };
        assert_eq!(points, before);
    }
    let mut points = [Point::default(), at(Vec3::ONE, 1.0), at(Vec3::ONE, 1.0)];
    let before = points;
    let mut pack = LengthPack::NULL;
    (pack.points[0][0], pack.points[1][0], pack.rest[0]) = (PointOffset::new(1), PointOffset::new(2), 1.0);
    unsafe { (Kernels::of(SimdLevel::best()).sweep_lengths)(points.as_mut_ptr(), &[pack]) };
    assert_eq!(points, before);
}

#[test]
fn what_is_held_does_not_move_even_where_corrections_are_infinite() {
    let mut points = [Point::default(), at(Vec3::ONE, 0.0), at(Vec3::splat(1e30), 1.0)];
    let held = points[1];
    let mut pack = LengthPack::NULL;
    (pack.points[0][0], pack.points[1][0], pack.rest[0]) = (PointOffset::new(1), PointOffset::new(2), 1.0);
    for level in levels() {
        unsafe { (Kernels::of(level).sweep_lengths)(points.as_mut_ptr(), std::slice::from_ref(&pack)) };
        assert_eq!(points[1], held);
    }
}

#[test]
fn vectors_are_as_wide_as_packs_allow() {
    fn fits<L: Lanes>() {
        assert_eq!(LANES % L::WIDTH, 0);
    }
    fits::<lanes::scalar::Scalar>();
    #[cfg(target_arch = "x86_64")]
    fits::<lanes::pair::Pair<lanes::avx512::Avx512>>();
}
