//! Every kernel keeps finite points finite, whatever their sizes, and gives the same bits with every instruction set.

use super::{bits, levels, offsets};
use crate::deform::{
    packed::{
        level::{Kernels, SimdLevel},
        pack::{BendPack, BendTargets, LANES, LengthPack, PerLane},
        point::Point,
    },
    tests::draw::Draw,
};
use bevy_math::Vec3;

const PACKS: u64 = 8_000;

/// Points, of which some are free.
fn at(draw: &mut Draw, p: Vec3) -> Point {
    Point(p.extend(draw.below(4).min(1) as f32).to_array())
}

/// A null point, then the corners of a pair in each lane, as [`offsets`] refers to them.
fn pairs(draw: &mut Draw) -> Vec<Point> {
    let mut points = vec![Point::default(); 1 + 4 * LANES];
    for lane in 0..LANES {
        for (corner, p) in draw.pair().into_iter().enumerate() {
            points[1 + corner * LANES + lane] = at(draw, p);
        }
    }
    points
}

fn lanes(mut with: impl FnMut() -> f32) -> PerLane<f32> {
    std::array::from_fn(|_| with())
}

/// Runs `kernel` with every level and compares the bits with those of the scalar twin, all of which must be finite.
fn compare(name: &str, number: u64, points: &[Point], kernel: impl Fn(&Kernels, &mut [Point])) -> Vec<Point> {
    let run = |level| {
        let mut points = points.to_vec();
        kernel(&Kernels::of(level), &mut points);
        points
    };
    let twin = run(SimdLevel::Scalar);
    let broken = twin.iter().position(|p| p.0.iter().any(|x| !x.is_finite()));
    if let Some(broken) = broken {
        let lane = (broken - 1) % LANES;
        let lane: Vec<Point> = (0..(points.len() - 1) / LANES).map(|k| points[1 + k * LANES + lane]).collect();
        panic!("{name} {number}: {:?} from {lane:?}", twin[broken]);
    }
    for level in levels() {
        assert_eq!(bits(&run(level)), bits(&twin), "{name} {number}: {}", level.name());
    }
    twin
}

#[test]
fn bends_keep_every_finite_point_finite_and_no_point_leaps() {
    let mut draw = Draw(3);
    for number in 0..PACKS {
        let points = pairs(&mut draw);
        let rest = std::array::from_fn(|_| lanes(|| draw.size()));
        let folds = std::array::from_fn(|_| lanes(|| 2.0 * draw.share() - 1.0));
        let pack = BendPack { points: offsets(), folds, medians: rest };
        let bent = compare("bend", number, &points, |kernels, points| unsafe {
            (kernels.sweep_bends)(points.as_mut_ptr(), std::slice::from_ref(&pack));
        });
        for lane in 0..LANES {
            let corner = |points: &[Point], k: usize| Vec3::from_slice(&points[1 + k * LANES + lane].0);
            let before = [0, 1, 2, 3].map(|k| corner(&points, k));
            let largest = before.iter().map(|p| p.abs().max_element()).fold(0.0, f32::max);
            let size = before.iter().map(|p| (p - before[0]).abs().max_element()).fold(0.0, f32::max);
            for (k, was) in before.into_iter().enumerate() {
                let leap = (corner(&bent, k) - was).abs().max_element();
                assert!(leap <= 16.0 * size + 1e-6 * largest, "{number}, lane {lane}: {leap} of {before:?}");
            }
        }
    }
}

#[test]
fn lengths_keep_every_finite_point_finite() {
    let mut draw = Draw(4);
    for number in 0..2 * PACKS {
        let points = pairs(&mut draw);
        let pack = LengthPack { points: offsets(), rest: lanes(|| draw.size()) };
        compare("length", number, &points, |kernels, points| unsafe {
            (kernels.sweep_lengths)(points.as_mut_ptr(), std::slice::from_ref(&pack));
        });
    }
}

#[test]
fn momentum_and_half_space_keep_every_finite_point_finite() {
    let mut draw = Draw(5);
    let [awake] = offsets::<1>();
    for number in 0..2 * PACKS {
        let points = pairs(&mut draw);
        let before = pairs(&mut draw);
        let mut plane = || {
            let (normal, rest) = (draw.along().normalize_or_zero(), draw.vector());
            Point(normal.extend(normal.dot(rest)).to_array())
        };
        let planes: Vec<Point> = points.iter().map(|_| plane()).collect();
        let keep = draw.share();
        compare("half-space", number, &points, |kernels, points| unsafe {
            (kernels.project)(points.as_mut_ptr(), planes.as_ptr(), &awake);
        });
        compare("momentum", number, &points, |kernels, points| unsafe {
            let mut before = before.clone();
            (kernels.advance)(points.as_mut_ptr(), before.as_mut_ptr(), planes.as_ptr(), &awake, keep);
            points[1 + LANES..].copy_from_slice(&before[1 + LANES..]);
        });
    }
}

#[test]
fn targets_narrow_to_finite_angles_by_steps_of_any_size() {
    let mut draw = Draw(6);
    for number in 0..PACKS {
        let starts = lanes(|| 6.3 * draw.share());
        let skews = std::array::from_fn(|_| lanes(|| draw.share()));
        let shares = lanes(|| 3.0 * draw.share());
        let (step, limit) = (draw.size(), std::f32::consts::PI * draw.share());
        let run = |level| {
            let (mut pack, mut angles) = (BendPack::NULL, BendTargets { skews, starts, targets: starts, shares });
            let narrowing = unsafe { (Kernels::of(level).narrow)(&mut pack, &mut angles, step, limit) };
            let numbers: Vec<f32> = angles.targets.into_iter().chain(pack.folds.into_iter().flatten()).collect();
            (numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>(), numbers, narrowing)
        };
        let twin = run(SimdLevel::Scalar);
        assert!(twin.1.iter().all(|x| x.is_finite()), "{number}: step {step}, limit {limit}");
        for level in levels() {
            assert_eq!(run(level), twin, "{number}: {}", level.name());
        }
    }
}
