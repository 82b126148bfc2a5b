//! Measures triangles: the nearest point of one, and where a ray meets it.

use bevy_math::Vec3;

/// Rounding of barycentric coordinates up to which a ray meets a triangle, so that none slips through between two.
const SLACK: f32 = 1e-5;

/// Returns the barycentric coordinates of the point of a triangle that is nearest to `point`.
pub(super) fn nearest(point: Vec3, [a, b, c]: [Vec3; 3]) -> Vec3 {
    // The regions of Ericson, Real-Time Collision Detection, 5.1.5.
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return Vec3::X;
    }
    let bp = point - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return Vec3::Y;
    }
    let cp = point - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return Vec3::Z;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = ratio(d1, d1 - d3);
        return Vec3::new(1.0 - t, t, 0.0);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = ratio(d2, d2 - d6);
        return Vec3::new(1.0 - t, 0.0, t);
    }
    let va = d3 * d6 - d5 * d4;
    let (along, back) = (d4 - d3, d5 - d6);
    if va <= 0.0 && along >= 0.0 && back >= 0.0 {
        let t = ratio(along, along + back);
        return Vec3::new(0.0, 1.0 - t, t);
    }
    let whole = va + vb + vc;
    let (v, w) = (ratio(vb, whole), ratio(vc, whole));
    Vec3::new(1.0 - v - w, v, w)
}

/// Returns `part / whole`; 0 where a triangle without extent leaves nothing to divide by.
fn ratio(part: f32, whole: f32) -> f32 {
    let ratio = part / whole;
    if ratio.is_finite() { ratio } else { 0.0 }
}

/// Place at which a ray meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hit {
    /// Distance along the ray.
    pub distance: f32,
    /// Barycentric coordinates.
    pub barycentric: Vec3,
    /// Whether the ray comes from behind: from where the triangle's corners are clockwise.
    pub back: bool,
}

/// Returns where the ray from `origin` along the unit vector `direction` meets a triangle.
#[inline]
pub(super) fn hit(origin: Vec3, direction: Vec3, [a, b, c]: [Vec3; 3]) -> Option<Hit> {
    let (ab, ac) = (b - a, c - a);
    // Moeller and Trumbore, from both sides.
    let across = direction.cross(ac);
    let volume = ab.dot(across);
    let from = origin - a;
    let (size, sign) = (volume.abs(), volume.signum());
    let slack = SLACK * size;
    let v = from.dot(across) * sign;
    if !(v >= -slack && v <= size + slack) {
        return None;
    }
    let other = from.cross(ab);
    let w = direction.dot(other) * sign;
    if !(w >= -slack && v + w <= size + slack && size > 0.0) {
        return None;
    }
    let distance = ac.dot(other) * sign / size;
    let (v, w) = (v / size, w / size);
    let inside = Vec3::new(1.0 - v - w, v, w).max(Vec3::ZERO);
    let barycentric = inside / inside.element_sum();
    (distance >= 0.0 && barycentric.is_finite()).then_some(Hit { distance, barycentric, back: volume < 0.0 })
}

/// Returns the point of a triangle with these barycentric coordinates.
#[inline]
pub(super) fn at([a, b, c]: [Vec3; 3], barycentric: Vec3) -> Vec3 {
    a * barycentric.x + b * barycentric.y + c * barycentric.z
}

/// Returns the unit normal of a triangle, or zero if it has no area.
pub(super) fn normal([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: [Vec3; 3] = [Vec3::ZERO, Vec3::new(2.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0)];

    /// Points on a lattice in and around the triangle.
    fn lattice() -> impl Iterator<Item = Vec3> {
        (0..1000).map(|i| Vec3::new((i % 10) as f32, (i / 10 % 10) as f32, (i / 100) as f32) * 0.37 - 1.3)
    }

    #[test]
    fn no_point_of_a_triangle_is_nearer_than_the_nearest() {
        let flat = [Vec3::ZERO, Vec3::X, Vec3::X * 2.0];
        for corners in [CORNERS, flat, [Vec3::ONE; 3]] {
            for point in lattice() {
                let found = nearest(point, corners);
                assert!(found.min_element() > -1e-6 && (found.element_sum() - 1.0).abs() < 1e-5, "{found}");
                let distance = at(corners, found).distance(point);
                for i in 0..66u32 {
                    let (v, w) = ((i % 11) as f32 * 0.1, (i / 11) as f32 * 0.1);
                    let other = Vec3::new((1.0 - v - w).max(0.0), v, w);
                    let other = other / other.element_sum();
                    assert!(at(corners, other).distance(point) >= distance - 1e-5, "{point}: {found}, {other}");
                }
            }
        }
    }

    #[test]
    fn rays_meet_what_lies_before_them() {
        let from = Vec3::new(0.5, 0.25, 3.0);
        let found = hit(from, Vec3::NEG_Z, CORNERS).expect("a hit");
        assert_eq!((found.distance, found.back), (3.0, false));
        assert!(at(CORNERS, found.barycentric).abs_diff_eq(Vec3::new(0.5, 0.25, 0.0), 1e-6));
        assert!(hit(from - 6.0 * Vec3::Z, Vec3::Z, CORNERS).expect("a hit").back);
        assert_eq!(hit(from, Vec3::Z, CORNERS), None, "behind");
        assert_eq!(hit(from, Vec3::X, CORNERS), None, "along it");
        assert_eq!(hit(from + 2.0 * Vec3::X, Vec3::NEG_Z, CORNERS), None, "beside it");
        assert_eq!(hit(from, Vec3::NEG_Z, [Vec3::ZERO; 3]), None, "no extent");
        // None slips through between two triangles.
        let other = [CORNERS[1], Vec3::new(2.0, 1.0, 0.0), CORNERS[2]];
        for i in 0..=100 {
            let t = i as f32 / 100.0;
            let origin = CORNERS[1].lerp(CORNERS[2], t) + Vec3::new(0.3, 0.2, 0.9);
            let direction = Vec3::new(-0.3, -0.2, -0.9).normalize();
            assert!([CORNERS, other].iter().any(|&corners| hit(origin, direction, corners).is_some()), "{t}");
        }
    }
}
