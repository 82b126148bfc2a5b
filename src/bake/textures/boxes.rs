//! Puts boxes around flat points.

use bevy_math::{
    Vec2,
    bounding::{Aabb2d, BoundingVolume},
};

/// Turns that are tried, over a quarter turn.
const TURNS: u32 = 16;

/// The smallest box around points, among boxes at some angles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmallestBox {
    /// The box's x axis turned back: rotating points by it puts them upright in the box.
    pub turn: Vec2,
    /// Its corner, after turning.
    pub low: Vec2,
    /// Its sides.
    pub size: Vec2,
}

impl SmallestBox {
    /// Around `points`.
    pub fn around(points: &[Vec2]) -> Self {
        let mut best = Self { turn: Vec2::X, ..Self::default() };
        let mut least = f32::INFINITY;
        for turn in 0..TURNS {
            let turn = Vec2::from_angle(turn as f32 * std::f32::consts::FRAC_PI_2 / TURNS as f32);
            let around = bounds(points.iter().map(|&p| turn.rotate(p)));
            let (low, size) = around.map_or_else(Default::default, |around| (around.min, around.max - around.min));
            let area = size.element_product();
            // Turning must pay: upright streaks need fewer texels.
            if area < least * 0.98 {
                least = area;
                best = Self { turn, low, size };
            }
        }
        best
    }

    /// Area.
    pub fn area(&self) -> f32 {
        self.size.element_product()
    }
}

/// The upright box around points; `None` without any.
pub fn bounds(points: impl Iterator<Item = Vec2>) -> Option<Aabb2d> {
    points.map(|p| Aabb2d { min: p, max: p }).reduce(|a, b| a.merge(&b))
}
