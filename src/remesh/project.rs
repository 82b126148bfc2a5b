//! Projects points onto the surface by walking over it.
//!
//! The walk starts at the last known triangle and goes to neighbouring triangles that are closer, never across a
//! feature. So a point stays in its own patch and on its own side of a thin wall, which a search for the nearest
//! triangle in space would not ensure. A walk is a few steps long.

use bevy_math::Vec3;

use super::topology::Topology;
use crate::film::{FaceId, HalfEdgeId};

/// Triangles over which points walk.
pub(super) trait Ground {
    fn topology(&self) -> &Topology;
    /// Returns the corner positions of the triangle.
    fn triangle(&self, f: FaceId) -> [Vec3; 3];
    /// Returns whether no walk may cross this edge.
    fn is_feature(&self, h: HalfEdgeId) -> bool;
}

/// Point on the clean surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Foot {
    pub triangle: FaceId,
    pub position: Vec3,
    /// Barycentric weights of the triangle's corners.
    pub weights: Vec3,
}

/// Number of steps after which a walk ends.
const LONGEST_WALK: usize = 1000;

/// Returns the point of the surface nearest to `p`, found by a walk from `start`.
pub(super) fn project(ground: &impl Ground, p: Vec3, start: FaceId) -> Foot {
    let mut foot = nearest_on_triangle(ground, p, start);
    let mut distance = foot.position.distance_squared(p);
    for _ in 0..LONGEST_WALK {
        let mut better = None;
        let mut visit = |f: FaceId| {
            let candidate = nearest_on_triangle(ground, p, f);
            let d = candidate.position.distance_squared(p);
            if d < distance {
                distance = d;
                better = Some(candidate);
            }
        };
        around(ground, &foot, &mut visit);
        match better {
            Some(next) => foot = next,
            None => break,
        }
    }
    foot
}

/// Visits the triangles that share the point with its own triangle, across edges that are no features.
fn around(ground: &impl Ground, foot: &Foot, visit: &mut dyn FnMut(FaceId)) {
    let topology = ground.topology();
    let half_edges = foot.triangle.half_edges();
    let w = foot.weights.to_array();
    let across = |h: HalfEdgeId| topology.twin(h).filter(|_| !ground.is_feature(h));
    for k in 0..3 {
        // Half-edge k is opposite corner k + 2: the point lies on it if the weight of that corner is 0.
        if w[(k + 2) % 3] > 0.0 {
            continue;
        }
        if w[k] > 0.0 && w[(k + 1) % 3] > 0.0 {
            if let Some(t) = across(half_edges[k]) {
                visit(t.face());
            }
            return;
        }
    }
    let Some(k) = (0..3).find(|&k| w[(k + 1) % 3] <= 0.0 && w[(k + 2) % 3] <= 0.0) else { return };
    let start = half_edges[k];
    let mut h = start;
    while let Some(t) = across(h.previous()) {
        h = t;
        if h == start {
            return;
        }
        visit(h.face());
    }
    h = start;
    while let Some(t) = across(h) {
        h = t.next();
        if h == start {
            return;
        }
        visit(h.face());
    }
}

/// Returns the distance of `p` from a triangle.
pub(super) fn distance_to_triangle(p: Vec3, [a, b, c]: [Vec3; 3]) -> f32 {
    let weights = nearest_weights(p, a, b, c);
    p.distance(a * weights.x + b * weights.y + c * weights.z)
}

/// Returns the point of a triangle nearest to `p` (Ericson, Real-Time Collision Detection, 5.1.5).
pub(super) fn nearest_on_triangle(ground: &impl Ground, p: Vec3, f: FaceId) -> Foot {
    let [a, b, c] = ground.triangle(f);
    let weights = nearest_weights(p, a, b, c);
    Foot { triangle: f, position: a * weights.x + b * weights.y + c * weights.z, weights }
}

/// Computes in double precision, since sums of products are too inexact on slivers.
pub(super) fn nearest_weights(p: Vec3, a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    let [p, a, b, c] = [p, a, b, c].map(|v| v.as_dvec3());
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return Vec3::X;
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return Vec3::Y;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let t = (d1 / (d1 - d3)) as f32;
        return Vec3::new(1.0 - t, t, 0.0);
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return Vec3::Z;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let t = (d2 / (d2 - d6)) as f32;
        return Vec3::new(1.0 - t, 0.0, t);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let t = ((d4 - d3) / ((d4 - d3) + (d5 - d6))) as f32;
        return Vec3::new(0.0, 1.0 - t, t);
    }
    let normal = ab.cross(ac);
    let square = normal.length_squared();
    if square <= 0.0 {
        return Vec3::X;
    }
    let v = (normal.dot(ap.cross(ac)) / square).clamp(0.0, 1.0);
    let w = (normal.dot(ab.cross(ap)) / square).clamp(0.0, 1.0 - v);
    Vec3::new((1.0 - v - w) as f32, v as f32, w as f32)
}
