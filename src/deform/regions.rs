//! Regions of a film: vertices that lie near each other, so that the solver works on one part of memory at a time.

use bevy_math::Vec3;

/// Vertices of a region at most: 128 kB of points, an eighth of a common second-level cache.
const VERTICES: usize = 8192;

/// Region of each vertex, and the number of regions: halves of halves along the longest side, until each is small enough.
pub(super) fn regions_of(rest: &[Vec3]) -> (Vec<u16>, usize) {
    let mut regions = vec![0; rest.len()];
    let mut order: Vec<u32> = (0..rest.len() as u32).collect();
    let mut count = 0;
    // Parts that are left to be halved, the last of them next.
    let mut parts = vec![0..order.len()];
    while let Some(part) = parts.pop() {
        let vertices = &mut order[part.clone()];
        if vertices.len() <= VERTICES {
            vertices.iter().for_each(|&v| regions[v as usize] = count);
            count += 1;
            continue;
        }
        let points = vertices.iter().map(|&v| rest[v as usize]);
        let (min, max) = points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), p| (min.min(p), max.max(p)));
        let axis = (max - min).max_position();
        let middle = vertices.len() / 2;
        vertices.select_nth_unstable_by(middle, |&a, &b| {
            rest[a as usize][axis].total_cmp(&rest[b as usize][axis]).then(a.cmp(&b))
        });
        parts.push(part.start + middle..part.end);
        parts.push(part.start..part.start + middle);
    }
    (regions, usize::from(count).max(1))
}
