//! The planar outlines of the test pieces.

use std::f64::consts::{PI, TAU};

use bevy_math::{DVec2, ops};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Largest random displacement of a border point along the border, as a part of the spacing. It keeps the rows of
/// triangles behind the border from lining up, and is small enough that the border edges stay alike.
const JITTER: f64 = 0.06;

/// Convex outline around the origin.
#[derive(Clone, Copy, Debug)]
pub(super) enum Outline {
    /// Square with side 1.
    Square,
    /// Disk with radius 1.
    Disk,
}

impl Outline {
    pub fn area(self) -> f64 {
        match self {
            Self::Square => 1.0,
            Self::Disk => PI,
        }
    }

    pub fn perimeter(self) -> f64 {
        match self {
            Self::Square => 4.0,
            Self::Disk => TAU,
        }
    }

    /// Returns the width, which is also the height.
    pub fn extent(self) -> f64 {
        match self {
            Self::Square => 1.0,
            Self::Disk => 2.0,
        }
    }

    /// Returns the least number of border points that keeps the shape recognisable.
    pub fn min_border(self) -> usize {
        match self {
            Self::Square => 4,
            Self::Disk => 5,
        }
    }

    /// Returns the distance of a point from the border. It is negative outside.
    pub fn depth(self, p: DVec2) -> f64 {
        match self {
            Self::Square => 0.5 - p.abs().max_element(),
            Self::Disk => 1.0 - p.length(),
        }
    }

    /// Returns `count` points on the border, nearly evenly spaced and counter-clockwise. The points of a square lie
    /// exactly on its sides, so that no sliver fits between them and the hull, and include its corners.
    pub fn border(self, count: usize, rng: &mut ChaCha8Rng) -> Vec<DVec2> {
        let mut jitter = || JITTER * rng.random_range(-1.0..1.0);
        match self {
            Self::Square => {
                let corners =
                    [DVec2::new(-0.5, -0.5), DVec2::new(0.5, -0.5), DVec2::new(0.5, 0.5), DVec2::new(-0.5, 0.5)];
                let mut points = Vec::with_capacity(count);
                for side in 0..4 {
                    // Sides differ by one point where the count asks for it.
                    let segments = (count + side) / 4;
                    let (from, to) = (corners[side], corners[(side + 1) % 4]);
                    points.push(from);
                    for i in 1..segments {
                        let along = (i as f64 + jitter()) / segments as f64;
                        // One coordinate is the same at both ends and must stay so to the bit.
                        let between = |a: f64, b: f64| if a == b { a } else { a + (b - a) * along };
                        points.push(DVec2::new(between(from.x, to.x), between(from.y, to.y)));
                    }
                }
                points
            }
            Self::Disk => {
                let start = jitter() / JITTER;
                let angle = |i: usize, jitter: f64| TAU * (i as f64 + start + jitter) / count as f64;
                (0..count)
                    .map(|i| {
                        let (sin, cos) = ops::sin_cos(angle(i, jitter()) as f32);
                        DVec2::new(cos.into(), sin.into()).normalize()
                    })
                    .collect()
            }
        }
    }
}
