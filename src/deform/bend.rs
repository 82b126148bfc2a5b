//! Bend constraint: the two wings of an edge close on the neutral direction (VC 4.3, appendix).
//!
//! For an edge `p1 p2` with wings `p3` and `p4`, `v` the middle of the edge, `l_i` the length of the median
//! from `v` to the tip of wing `i`, and the neutral direction `n` half-way between the face normals, wing `i`
//! is to make the angle `phi0 / 2` with `n`. With `v_i = v + l_i n` that is a triangle bending constraint on
//! `(p1, p2, p_tip)` and `v_i`: the distance of `v_i` from the centroid `c_i` of the four is to be `d_i`.
//!
//! Differences from the printed appendix:
//! - The printed corrections hold `(v - v_i)`, also inside `u_i`, where `(v - c_i)` is meant, `c_i` being the
//!   centroid: as printed the strain never vanishes and the pair always folds one way. The form here needs no
//!   centroid: `q_i = p1 + p2 - p_tip - v_i`.
//! - The printed `d_i = l_i / 4 sqrt(2 (1 + cos(phi0 / 2)))` is right for wings perpendicular to the edge
//!   only. With the rest altitude over the rest median, `h_i / l_i`, before the cosine, any triangle is at
//!   rest exactly at `phi0`.

use bevy_math::{Vec3, ops};

use super::length::length;
use crate::film::{FilmMesh, HalfEdgeId, Topology};

/// Least length of the sum of two unit normals. A shorter one is that of a fully folded pair, which has no neutral
/// direction.
const MIN_NEUTRAL: f32 = 1e-6;

/// Bend constraint: the two faces of a bound edge close to a target angle (VC 4.3, appendix).
///
/// Angles are dihedral, in 0..2 pi: pi is flat, less a valley, more a mountain, seen from outside.
///
/// ```
/// use std::f32::consts::PI;
///
/// use bevy_coating::{deform::BendConstraint, film::HalfEdgeId};
/// use bevy_math::Vec3;
///
/// // An edge along y, its own face to the left and its twin's to the right: flat, and seen from +z.
/// let points = [Vec3::ZERO, Vec3::Y, Vec3::new(-1.0, 0.5, 0.0), Vec3::new(1.0, 0.5, 0.0)];
/// let mut bend = BendConstraint::new(HalfEdgeId(0), [0, 1, 2, 3], points, PI);
/// bend.narrow(0.1, 0.35);
/// assert_eq!(bend.target, PI - 0.1);
///
/// // Both wings rise and the edge sinks.
/// let corrections = bend.corrections(points, [1.0; 4]).unwrap();
/// assert!(corrections[0].z < 0.0 && corrections[2].z > 0.0 && corrections[3].z > 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BendConstraint {
    /// Half-edge that carries the constraint: the lower one of the edge.
    pub half_edge: HalfEdgeId,
    /// Indices of the four vertices: ends of the edge, tip of the half-edge's own face, tip of its twin's face (p1, p2,
    /// p3, p4).
    pub points: [u32; 4],
    /// Rest altitude over rest median of each wing, in 0..=1.
    pub skew: [f32; 2],
    /// Rest length of each wing's median, in the film's unit.
    pub rest_medians: [f32; 2],
    /// Angle at which the constraint began, in radians.
    pub start: f32,
    /// Target angle phi0 now, in radians.
    pub target: f32,
    /// Four times the distance d of the appendix over the median, of each wing: `sqrt(2 (1 + skew cos(phi0 / 2)))`.
    pub reach: [f32; 2],
}

impl BendConstraint {
    /// Makes a constraint on the vertices `points`, whose rest positions are `rest`. It begins at `angle`, in radians,
    /// which is also its first target.
    pub fn new(half_edge: HalfEdgeId, points: [u32; 4], rest: [Vec3; 4], angle: f32) -> Self {
        let (skew, rest_medians) = shape_at_rest(rest);
        let mut constraint =
            Self { half_edge, points, skew, rest_medians, start: angle, target: angle, reach: [0.0; 2] };
        constraint.set_target(angle);
        constraint
    }

    /// Returns the constraint of the bound edge that `h` carries, which began at `start` (radians).
    pub(super) fn of_edge(mesh: &FilmMesh, h: HalfEdgeId, start: f32) -> Self {
        let points = bend_points(&mesh.topology, h);
        Self::new(h, points, points.map(|v| mesh.geometry.rest_positions[v as usize]), start)
    }

    /// Sets the target angle, in radians.
    pub fn set_target(&mut self, target: f32) {
        self.target = target;
        let cosine = ops::cos(target * 0.5);
        self.reach = self.skew.map(|skew| (2.0 * (1.0 + skew * cosine)).max(0.0).sqrt());
    }

    /// Narrows the target by `step`, down to `limit` below the angle at which the constraint began; both in radians.
    #[inline]
    pub fn narrow(&mut self, step: f32, limit: f32) {
        let end = self.start - limit;
        if self.target > end {
            let next = self.target - step;
            self.set_target(if next > end { next } else { end });
        }
    }

    /// Returns the corrections of the four points at `p` with inverse masses `w` (0 fixed, 1 free), or `None` where
    /// nothing can be done: a face without area, a fully folded pair, a tip that already lies where no direction is
    /// left, or all points fixed.
    #[inline]
    pub fn corrections(&self, p: [Vec3; 4], w: [f32; 4]) -> Option<[Vec3; 4]> {
        bend_corrections(p, w, self.reach, self.rest_medians)
    }
}

/// Returns the vertices p1, p2, p3, p4 of the bound edge that `h` carries.
pub(super) fn bend_points(topology: &Topology, h: HalfEdgeId) -> [u32; 4] {
    let tip = topology.rest_twin(h).map_or(topology.apex(h), |twin| topology.apex(twin));
    [topology.origin(h).0, topology.target(h).0, topology.apex(h).0, tip.0]
}

/// Returns altitude over median of both wings of a pair at rest, in 0..=1, and the lengths of their medians.
pub(super) fn shape_at_rest([p1, p2, p3, p4]: [Vec3; 4]) -> ([f32; 2], [f32; 2]) {
    let (middle, edge) = ((p1 + p2) * 0.5, p2 - p1);
    let medians = [p3 - middle, p4 - middle];
    let lengths = medians.map(length);
    // Altitude over median: the sine of the angle between median and edge.
    let sine = |i: usize| {
        let product = length(edge) * lengths[i];
        let sine = length(medians[i].cross(edge)) / product;
        if sine.is_finite() { sine } else { 0.0 }
    };
    ([sine(0), sine(1)], lengths)
}

/// Returns the corrections of the four points of a bend constraint, with `reach` and `rest_medians` as in
/// [`BendConstraint`]. `None` where nothing can be done: a face without area, a fully folded pair, a tip that
/// already lies where no direction is left, all points fixed, or lengths beyond the range of floats.
///
/// In the form that needs no division by partial sums of weights (which are 0 when three points are pinned):
/// `a_i = u_i q_i`, `W = w1 + w2 + w3 + w4`, `W1 = W - w4`, `W2 = W - w3`,
/// `dp1 = -w1 (a1 W2 + a2 W1) / (W (W1 + W2))`, dp2 alike, `dp3 = w3 a1 / W`, `dp4 = w4 a2 / W`.
///
/// A stretched wing corrects less, by the square of rest over current median: otherwise corrections grow
/// with the stretch they cause.
#[inline]
pub(super) fn bend_corrections(
    p: [Vec3; 4],
    w: [f32; 4],
    reach: [f32; 2],
    rest_medians: [f32; 2],
) -> Option<[Vec3; 4]> {
    let [p1, p2, p3, p4] = p;
    let [w1, w2, w3, w4] = w;
    let edge = p2 - p1;
    let (n1, n2) = (edge.cross(p3 - p1), (p4 - p1).cross(edge));
    let (area1, area2) = (length(n1), length(n2));
    if !(area1 > 0.0 && area2 > 0.0) {
        return None;
    }
    let neutral = n1 * (1.0 / area1) + n2 * (1.0 / area2);
    let neutral_length = length(neutral);
    if !(neutral_length >= MIN_NEUTRAL) {
        return None;
    }
    let neutral = neutral * (1.0 / neutral_length);
    let middle = (p1 + p2) * 0.5;
    let wing = |tip: Vec3, reach: f32, rest: f32| {
        let arm = middle - tip;
        let median = length(arm);
        let q = arm - median * neutral;
        let q_length = length(q);
        // The length of a huge vector is infinite.
        if !(q_length > 0.0 && median > 0.0 && q_length < f32::INFINITY && median < f32::INFINITY) {
            return None;
        }
        let stretch = rest / median;
        let damping = if stretch < 1.0 { stretch * stretch } else { 1.0 };
        Some(q * (damping * (1.0 - median * reach / q_length)))
    };
    let (a1, a2) = (wing(p3, reach[0], rest_medians[0])?, wing(p4, reach[1], rest_medians[1])?);
    let total = w1 + w2 + w3 + w4;
    if !(total > 0.0) {
        return None;
    }
    let (without4, without3) = (total - w4, total - w3);
    let whole = 1.0 / total;
    let shared = (a1 * without3 + a2 * without4) * (whole / (without4 + without3));
    Some([-w1 * shared, -w2 * shared, a1 * (w3 * whole), a2 * (w4 * whole)])
}
