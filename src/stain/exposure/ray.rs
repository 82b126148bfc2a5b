//! Tests whether rays meet boxes and triangles.

use bevy_math::Vec3;

/// Rounding error that a box test allows for, relative to the distance of the box and to coordinates.
const ROUNDING: f32 = 16.0 * f32::EPSILON;

/// Direction of rays, prepared for the watertight test of Woop, Benthin and Wald, *Watertight Ray/Triangle
/// Intersection*, JCGT 2013: no ray can pass between two triangles that share an edge.
///
/// ```
/// use bevy_coating::stain::exposure::{Ray, TriangleTree};
/// use bevy_math::Vec3;
///
/// let roof = TriangleTree::new([[Vec3::ZERO, Vec3::X, Vec3::Z].map(|p| p + Vec3::Y)]);
/// let up = Ray::new(Vec3::Y);
/// assert!(roof.is_met(&up, Vec3::new(0.2, 0.0, 0.2)));
/// assert!(!roof.is_met(&up, Vec3::new(0.2, 2.0, 0.2)), "the roof is behind it");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Axes in the order x, y, z of the space in which the ray runs along z.
    axes: [usize; 3],
    /// Shear along the first two axes, and scale along the third, that turn the direction into z.
    shear: Vec3,
    /// Reciprocal of each component of the direction; large but finite where the component is 0.
    inverse: Vec3,
}

impl Ray {
    /// Prepares rays along `direction`, which may have any length but zero.
    pub fn new(direction: Vec3) -> Self {
        let z = direction.abs().max_position();
        // Scaled so that its largest component is 1: nothing below can overflow or vanish.
        let direction = direction / direction.abs().max_element();
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let [x, y, z] = axes.map(|axis| direction[axis]);
        // A component of 0 becomes a very small one, so that it can be divided by.
        let steep = |c: f32| if c.abs() < 1e-20 { 1e-20f32.copysign(c) } else { c };
        let inverse = Vec3::from_array(direction.to_array().map(|c| 1.0 / steep(c)));
        Self { axes, shear: Vec3::new(x / z, y / z, 1.0 / z), inverse }
    }

    /// Returns whether the ray from `origin` meets a box. May be true for a box that the ray misses by a rounding
    /// error.
    pub(super) fn meets_box(&self, origin: Vec3, min: Vec3, max: Vec3) -> bool {
        // A ray along an axis may run exactly in a side of the box.
        let margin = min.abs().max(max.abs()).max(origin.abs()) * ROUNDING + Vec3::splat(f32::MIN_POSITIVE);
        let (a, b) = ((min - margin - origin) * self.inverse, (max + margin - origin) * self.inverse);
        let (enter, leave) = (a.min(b), a.max(b));
        let enter = enter - enter.abs() * ROUNDING;
        let leave = leave + leave.abs() * ROUNDING;
        enter.max_element() <= leave.min_element() && leave.min_element() >= 0.0
    }

    /// Returns whether the ray from `origin` meets a triangle, its edges included, from either side.
    pub(super) fn meets_triangle(&self, origin: Vec3, triangle: &[Vec3; 3]) -> bool {
        let [x, y, z] = self.axes;
        let [a, b, c] = triangle.map(|p| {
            let p = p - origin;
            Vec3::new(p[x] - self.shear.x * p[z], p[y] - self.shear.y * p[z], self.shear.z * p[z])
        });
        let weights = [c.x * b.y - c.y * b.x, a.x * c.y - a.y * c.x, b.x * a.y - b.y * a.x];
        if weights.iter().any(|&w| w < 0.0) && weights.iter().any(|&w| w > 0.0) {
            return false;
        }
        let sum = weights[0] + weights[1] + weights[2];
        let distance = weights[0] * a.z + weights[1] * b.z + weights[2] * c.z;
        // A sum of 0 means that the triangle is seen edge on; a negative product that it lies behind the origin.
        sum != 0.0 && distance * sum > 0.0
    }
}
