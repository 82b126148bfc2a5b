//! The curved patch over a face: a point-normal triangle (Vlachos, Peters, Boyd, Mitchell: Curved PN triangles, 2001).

use bevy_math::{Vec3, Vec3A};

/// Cubic triangle through the three corners of a face, at right angles to their normals.
///
/// Its edges depend on the corners and normals at their own ends alone, so that neighbours meet.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Patch([Vec3A; 10]);

impl Patch {
    /// Returns the patch over a face with these corners and unit normals at them.
    pub fn new(corners: [Vec3A; 3], normals: [Vec3A; 3]) -> Self {
        let third = 1.0 / 3.0;
        let along = |i: usize, j: usize| third_of_the_way(corners[i], normals[i], corners[j]);
        let sides = [along(0, 1), along(1, 0), along(1, 2), along(2, 1), along(2, 0), along(0, 2)];
        let mean = (sides[0] + sides[1] + sides[2] + sides[3] + sides[4] + sides[5]) * (1.0 / 6.0);
        let centre = mean + (mean - (corners[0] + corners[1] + corners[2]) * third) * 0.5;
        let [a, b, c] = corners;
        Self([a, b, c, sides[0], sides[1], sides[2], sides[3], sides[4], sides[5], centre])
    }

    /// Returns the point with the weights of [`weights`].
    #[inline]
    pub fn at(&self, weights: &[f32; 10]) -> Vec3A {
        let [first, rest @ ..] = &self.0;
        rest.iter().zip(&weights[1..]).fold(*first * weights[0], |sum, (&point, &weight)| sum + point * weight)
    }
}

/// Edge of a patch: a cubic curve.
#[derive(Clone, Copy, Debug)]
pub(super) struct Curve([Vec3A; 4]);

impl Curve {
    /// Returns the edge of all patches over faces with these two corners and unit normals at them.
    #[inline]
    pub fn new([a, b]: [Vec3A; 2], [at_a, at_b]: [Vec3A; 2]) -> Self {
        Self([a, third_of_the_way(a, at_a, b), third_of_the_way(b, at_b, a), b])
    }

    /// Returns the point with these weights of the control points.
    #[inline]
    pub fn at(&self, weights: &[f32; 4]) -> Vec3A {
        let [a, b, c, d] = self.0;
        a * weights[0] + b * weights[1] + c * weights[2] + d * weights[3]
    }
}

/// Returns the control point a third of the way from `a` to `b`, in the plane at right angles to the normal at `a`.
#[inline]
fn third_of_the_way(a: Vec3A, normal: Vec3A, b: Vec3A) -> Vec3A {
    let edge = b - a;
    a + (edge - normal * edge.dot(normal)) * (1.0 / 3.0)
}

/// Returns the weights of a patch's control points at the barycentric coordinates `b`, which may lie beyond the face.
#[inline]
pub(super) fn weights(b: Vec3) -> [f32; 10] {
    let Vec3 { x: u, y: v, z: w } = b;
    [
        u * u * u,
        v * v * v,
        w * w * w,
        3.0 * u * u * v,
        3.0 * u * v * v,
        3.0 * v * v * w,
        3.0 * v * w * w,
        3.0 * w * w * u,
        3.0 * w * u * u,
        6.0 * u * v * w,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flat_patches_are_flat_and_curved_ones_bulge() {
        let corners = [Vec3A::ZERO, Vec3A::X, Vec3A::Y];
        let flat = Patch::new(corners, [Vec3A::Z; 3]);
        for b in [Vec3::X, Vec3::new(0.2, 0.3, 0.5), Vec3::new(-0.1, 0.6, 0.5)] {
            let expected = corners[0] * b.x + corners[1] * b.y + corners[2] * b.z;
            assert!(flat.at(&weights(b)).abs_diff_eq(expected, 1e-6), "at {b}");
        }
        // A piece of a unit sphere whose flat face lies as deep as 0.88.
        let piece =
            [(1.0, 0.2, 0.2), (0.6, 0.8, 0.0), (0.6, 0.2, 0.8)].map(|(x, y, z)| Vec3A::new(x, y, z).normalize());
        let round = Patch::new(piece, piece);
        for b in [Vec3::new(0.5, 0.5, 0.0), Vec3::splat(1.0 / 3.0), Vec3::new(0.1, 0.2, 0.7)] {
            let radius = round.at(&weights(b)).length();
            assert!((0.97..1.01).contains(&radius), "at {b}: {radius}");
        }
        assert_eq!(round.at(&weights(Vec3::Y)), piece[1]);
    }

    #[test]
    fn edges_of_patches_are_their_curves() {
        let corners = [Vec3A::ZERO, Vec3A::new(1.0, 0.2, 0.0), Vec3A::new(0.3, 0.9, 0.4)];
        let normals = [Vec3A::Z, Vec3A::new(0.6, 0.0, 0.8), Vec3A::new(0.0, -0.6, 0.8)];
        let patch = Patch::new(corners, normals);
        for k in 0..3 {
            let ends = [k, (k + 1) % 3];
            let curve = Curve::new(ends.map(|i| corners[i]), ends.map(|i| normals[i]));
            for i in 0..=8 {
                let t = i as f32 / 8.0;
                let s = 1.0 - t;
                let on_curve = curve.at(&[s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]);
                let on_patch = patch.at(&weights(Vec3::AXES[ends[0]] * s + Vec3::AXES[ends[1]] * t));
                assert!(on_curve.abs_diff_eq(on_patch, 1e-6), "{on_curve} {on_patch}");
            }
        }
    }
}
