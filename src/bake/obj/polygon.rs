//! Cuts polygons into triangles.

use bevy_math::{DVec2, DVec3};
use earcut::Earcut;

/// Thinnest triangle of a fan: twice its area over the square of its longest side. Thinner ones are dropped as slivers
/// when a film is built, and the points between their ends would be open seams then.
const THINNEST: f64 = 1e-6;
/// Polygons of more corners are not tried as fans around each of them, which takes time with the square.
const MOST_FANS: usize = 8;

/// Returns triangles of a polygon as indices of its corners, wound as it is. Corners need not lie in one plane; they
/// are looked at along the normal of the plane that fits best.
///
/// A fan around one corner where that covers the polygon and nothing else, around the first corner if possible: each
/// point inside is covered as often as the polygon runs around it, so triangles that all lie on the polygon's side
/// cover it once. Ear clipping (the crate `earcut`) elsewhere. A polygon without an area becomes a fan.
pub fn triangulate(corners: &[DVec3]) -> Vec<[usize; 3]> {
    let n = corners.len();
    let fan = |first: usize| (1..n.saturating_sub(1)).map(move |k| [first, (first + k) % n, (first + k + 1) % n]);
    if n <= 3 {
        return fan(0).collect();
    }
    let Some(flat) = flattened(corners) else { return fan(0).collect() };
    let place = |i: usize| flat.get(i).copied().unwrap_or_default();
    let is_sound = |triangle: [usize; 3]| is_sound(triangle.map(place));
    let tried = if n <= MOST_FANS { n } else { 1 };
    if let Some(first) = (0..tried).find(|&first| fan(first).all(is_sound)) {
        return fan(first).collect();
    }
    let mut clipped: Vec<u32> = Vec::new();
    Earcut::new().earcut(flat.iter().map(|p| p.to_array()), &[], &mut clipped);
    let inside = |&i: &u32| (i as usize) < n;
    let mut triangles: Vec<[usize; 3]> =
        clipped.as_chunks::<3>().0.iter().filter(|t| t.iter().all(inside)).map(|t| t.map(|i| i as usize)).collect();
    if triangles.is_empty() {
        return fan(0).collect();
    }
    // Ear clipping may wind the other way round, and leaves out corners on straight sides, where neighbours have
    // vertices.
    for triangle in &mut triangles {
        if area(triangle.map(place)) < 0.0 {
            triangle.swap(1, 2);
        }
    }
    take_up_left_out(&mut triangles, n);
    triangles
}

/// Corners as seen along the normal of the polygon's area, which it runs around counter-clockwise; `None` if it has
/// none or a corner is nowhere.
fn flattened(corners: &[DVec3]) -> Option<Vec<DVec2>> {
    let origin = corners.first().copied().filter(|_| corners.iter().all(|p| p.is_finite()))?;
    let spokes: Vec<DVec3> = corners.iter().map(|&p| p - origin).collect();
    let normal = spokes.array_windows().map(|[a, b]| a.cross(*b)).sum::<DVec3>().try_normalize()?;
    let (x, y) = normal.any_orthonormal_pair();
    Some(spokes.iter().map(|p| DVec2::new(p.dot(x), p.dot(y))).collect())
}

/// Twice the area, positive where the corners run counter-clockwise.
fn area([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - a)
}

fn is_sound(triangle @ [a, b, c]: [DVec2; 3]) -> bool {
    let longest = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    area(triangle) > THINNEST * longest
}

/// Divides the triangles beside which corners were left out.
fn take_up_left_out(triangles: &mut Vec<[usize; 3]>, count: usize) {
    let mut used = vec![false; count];
    for &i in triangles.iter().flatten() {
        if let Some(used) = used.get_mut(i) {
            *used = true;
        }
    }
    let Some(start) = used.iter().position(|&used| used) else { return };
    for step in 1..count {
        let i = (start + step) % count;
        let is_used = |i: usize| used.get(i) == Some(&true);
        if is_used(i) {
            continue;
        }
        let before = (i + count - 1) % count;
        let Some(after) = (1..count).map(|k| (i + k) % count).find(|&k| is_used(k)) else { return };
        let beside = triangles.iter_mut().find_map(|triangle| {
            let [a, b, c] = *triangle;
            let sides = [([a, b], c), ([b, c], a), ([c, a], b)];
            let (_, apex) = sides.into_iter().find(|&(side, _)| side == [before, after])?;
            Some((triangle, apex))
        });
        if let Some((triangle, apex)) = beside {
            *triangle = [before, i, apex];
            triangles.push([i, after, apex]);
            if let Some(used) = used.get_mut(i) {
                *used = true;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn points(flat: &[[f64; 2]]) -> Vec<DVec3> {
        flat.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect()
    }

    fn areas(corners: &[DVec3], triangles: &[[usize; 3]]) -> Vec<f64> {
        triangles.iter().map(|t| (corners[t[1]] - corners[t[0]]).cross(corners[t[2]] - corners[t[0]]).z * 0.5).collect()
    }

    #[test]
    fn concave_polygons_are_covered_once() {
        // An arrow of nine corners, and a letter U, both ways round.
        let arrow = [[0., 0.], [2., 0.], [2., 9.], [5., 6.], [5., 9.], [1., 13.], [-3., 9.], [-3., 6.], [0., 9.]];
        let u = [[0., 0.], [5., 0.], [5., 4.], [4., 4.], [4., 1.], [1., 1.], [1., 4.], [0., 4.]];
        for (outline, area) in [(&arrow[..], 43.0), (&u[..], 11.0)] {
            let mut corners = points(outline);
            for sign in [1.0, -1.0] {
                let areas = areas(&corners, &triangulate(&corners));
                assert_eq!(areas.len(), outline.len() - 2);
                assert!(areas.iter().all(|&a| a * sign > 0.0), "{areas:?}");
                assert!((areas.iter().sum::<f64>() * sign - area).abs() < 1e-9, "{areas:?}");
                corners.reverse();
            }
        }
    }

    #[test]
    fn convex_polygons_are_fans_around_their_first_corner() {
        let square = points(&[[0., 0.], [1., 0.], [1., 1.], [0., 1.]]);
        assert_eq!(triangulate(&square), [[0, 1, 2], [0, 2, 3]]);
        // A dart: only the fan around its notch covers it.
        let dart = points(&[[0., 0.], [2., 1.], [0., 2.], [0.5, 1.]]);
        assert_eq!(areas(&dart, &triangulate(&dart)).iter().sum::<f64>(), 1.5);
    }

    /// Neighbours have vertices there, and open seams would become of them.
    #[test]
    fn corners_on_straight_sides_are_kept() {
        let comb: Vec<[f64; 2]> =
            (0..=20).map(|i| [f64::from(i), 0.0]).chain([[20., 1.], [10., 0.5], [0., 1.]]).collect();
        let corners = points(&comb);
        let triangles = triangulate(&corners);
        assert_eq!(triangles.len(), corners.len() - 2);
        assert!((0..corners.len()).all(|i| triangles.iter().flatten().any(|&k| k == i)), "{triangles:?}");
        assert!((areas(&corners, &triangles).iter().sum::<f64>() - 15.0).abs() < 1e-9);
    }

    #[test]
    fn polygons_without_an_area_are_fans() {
        for corners in [points(&[[0., 0.]; 5]), vec![DVec3::NAN; 6], points(&[[0., 0.], [1., 0.], [2., 0.], [3., 0.]])]
        {
            assert_eq!(triangulate(&corners).len(), corners.len() - 2);
        }
        assert!(triangulate(&[]).is_empty() && triangulate(&[DVec3::ZERO]).is_empty());
    }

    proptest! {
        /// Outlines that do not cross themselves: points around a middle, at any distance.
        #[test]
        fn outlines_keep_their_area(radii in proptest::collection::vec(0.1f64..10.0, 4..40), tilt in 0.0f64..3.0) {
            let turn = bevy_math::DQuat::from_rotation_x(tilt);
            let n = radii.len() as f64;
            let corners: Vec<DVec3> = radii.iter().enumerate().map(|(i, r)| {
                let angle = std::f64::consts::TAU * i as f64 / n;
                turn * DVec3::new(r * cosine(angle), r * cosine(angle - std::f64::consts::FRAC_PI_2), 0.0)
            }).collect();
            let vector = |a: DVec3, b: DVec3, c: DVec3| (b - a).cross(c - a) * 0.5;
            let whole: DVec3 = corners.windows(2).map(|p| vector(DVec3::ZERO, p[0], p[1])).sum::<DVec3>()
                + vector(DVec3::ZERO, corners[corners.len() - 1], corners[0]);
            let triangles = triangulate(&corners);
            let part = |&[a, b, c]: &[usize; 3]| vector(corners[a], corners[b], corners[c]);
            let parts: Vec<DVec3> = triangles.iter().map(part).collect();
            prop_assert!((parts.iter().copied().sum::<DVec3>() - whole).length() < 1e-9 * whole.length());
            let sum: f64 = parts.iter().map(|p| p.length()).sum();
            prop_assert!((sum - whole.length()).abs() < 1e-9 * sum, "{} {}", sum, whole.length());
        }

        #[test]
        fn nothing_panics(corners in proptest::collection::vec(proptest::array::uniform3(-3i32..3), 0..14)) {
            let corners: Vec<DVec3> = corners.iter().map(|c| DVec3::from(c.map(f64::from))).collect();
            let triangles = triangulate(&corners);
            prop_assert!(triangles.iter().flatten().all(|&i| i < corners.len()));
        }
    }

    fn cosine(angle: f64) -> f64 {
        f64::from(bevy_math::ops::cos(angle as f32))
    }
}
