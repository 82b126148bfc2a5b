//! Finds the point of the surface over or under a given one, by a walk over the surface.

use bevy_math::{DVec3, Vec3};

use crate::{
    film::FaceId,
    remesh::project::{Foot, Ground},
};

/// Number of triangles after which a walk ends without a result.
const LONGEST_WALK: usize = 400;

/// Returns the point of the surface at which the line through `p` along `normal` meets it, found by a walk from `start`
/// that crosses no feature. Returns `None` if the walk ends anywhere else.
///
/// Seen along the normal, the walk leaves each triangle over the side beyond which `p` lies furthest.
pub fn shoot(ground: &impl Ground, p: Vec3, normal: Vec3, start: FaceId) -> Option<Foot> {
    let (origin, normal) = (p.as_dvec3(), normal.as_dvec3());
    let mut f = start;
    let mut entry = None;
    for _ in 0..LONGEST_WALK {
        let corners = ground.triangle(f).map(|c| c.as_dvec3() - origin);
        let [a, b, c] = corners;
        // Twice the areas of the triangles between `p` and each side, seen along the normal.
        let areas = [normal.dot(a.cross(b)), normal.dot(b.cross(c)), normal.dot(c.cross(a))];
        let whole: f64 = areas.iter().sum();
        if whole > 0.0 && areas.iter().all(|&area| area >= 0.0) {
            return Some(foot(f, origin, corners, DVec3::new(areas[1], areas[2], areas[0]) / whole));
        }
        let mut order = [0, 1, 2];
        order.sort_by(|&i, &j| areas[i].total_cmp(&areas[j]));
        let next = order.into_iter().filter(|&k| areas[k] < 0.0).map(|k| f.half_edges()[k]).find_map(|h| {
            let t = ground.topology().twin(h).filter(|_| Some(h) != entry && !ground.is_feature(h))?;
            Some(t)
        })?;
        entry = Some(next);
        f = next.face();
    }
    None
}

fn foot(triangle: FaceId, origin: DVec3, [a, b, c]: [DVec3; 3], weights: DVec3) -> Foot {
    let position = (origin + a * weights.x + b * weights.y + c * weights.z).as_vec3();
    Foot { triangle, position, weights: weights.as_vec3() }
}
