//! Boxes around flat points.

use bevy_math::Vec2;

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
            let turned = points.iter().map(|&p| turn.rotate(p)).map(|p| (p, p));
            let bounds = turned.reduce(|(low, high), (p, q)| (low.min(p), high.max(q)));
            let (low, high) = bounds.unwrap_or_default();
            let area = (high - low).element_product();
            // Turning must pay: upright streaks need fewer texels.
            if area < least * 0.98 {
                least = area;
                best = Self { turn, low, size: high - low };
            }
        }
        best
    }

    /// Area.
    pub fn area(&self) -> f32 {
        self.size.element_product()
    }
}
