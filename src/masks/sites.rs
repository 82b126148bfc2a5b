//! Values of the prop's corners at the vertices of a film.

use bevy_math::Vec4;

use super::ground::MaskGround;

/// Returns at each vertex the mean of `value` over the corners of the faces there. `value` is given what the prop's
/// corner attribute is at a corner of the film: `attribute` reads it, by the number of the prop's corner. 0 where a
/// vertex has no faces.
pub(super) fn mean_at_corners(
    ground: &MaskGround,
    vertices: usize,
    attribute: impl Fn(usize) -> Option<Vec4>,
    value: impl Fn(Vec4) -> f32,
) -> Vec<f32> {
    let mut sums = vec![(0.0f32, 0.0f32); vertices];
    for (&v, site) in ground.built.triangles.iter().flatten().zip(&ground.built.sites) {
        let first = 3 * site.triangle as usize;
        let corners = [0, 1, 2].map(|k| attribute(first + k).unwrap_or_default());
        let weights = site.weights;
        let [a, b, c] = corners;
        let found = value(a * weights.x + b * weights.y + c * weights.z);
        if let Some((sum, count)) = sums.get_mut(v as usize) {
            *sum += found;
            *count += 1.0;
        }
    }
    sums.into_iter().map(|(sum, count)| if count > 0.0 { sum / count } else { 0.0 }).collect()
}
