//! Where the vertices of a film lie in memory: near each other if they are near each other in space.

use bevy_math::Vec3;

/// Largest number of vertices of a region: 128 kB of points, an eighth of a common second-level cache. Smaller regions
/// would leave more lanes of packs empty.
const REGION: usize = 8192;
/// Largest number of vertices of a part that is not halved any further: a kilobyte of points.
const PART: usize = 64;

/// Order of the vertices of a film, and its regions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layout {
    /// Vertices in the order in which they lie in memory, region after region.
    pub order: Vec<u32>,
    /// Region of each vertex.
    pub region_of: Vec<u16>,
    /// Number of regions; at least 1.
    pub regions: usize,
}

impl Layout {
    /// Lays out the vertices at `rest`: halves of halves, along their longest side.
    pub fn new(rest: &[Vec3]) -> Self {
        let mut region_of = vec![0; rest.len()];
        let mut order: Vec<u32> = (0..rest.len() as u32).collect();
        let mut regions = 0;
        // Parts that are left to be halved, the last of them next, and whether they are within a region.
        let mut parts = vec![(0..order.len(), false)];
        while let Some((part, within)) = parts.pop() {
            let vertices = &mut order[part.clone()];
            if !within && vertices.len() <= REGION {
                vertices.iter().for_each(|&v| region_of[v as usize] = regions);
                regions += 1;
            }
            if vertices.len() <= PART {
                continue;
            }
            let within = within || vertices.len() <= REGION;
            let points = vertices.iter().map(|&v| rest[v as usize]);
            let (min, max) =
                points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), p| (min.min(p), max.max(p)));
            let axis = (max - min).max_position();
            let middle = vertices.len() / 2;
            vertices.select_nth_unstable_by(middle, |&a, &b| {
                rest[a as usize][axis].total_cmp(&rest[b as usize][axis]).then(a.cmp(&b))
            });
            parts.push((part.start + middle..part.end, within));
            parts.push((part.start..part.start + middle, within));
        }
        Self { order, region_of, regions: usize::from(regions).max(1) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_vertex_occurs_once_and_regions_follow_each_other() {
        for n in [0usize, 1, 63, 64, 65, 8192, 8193, 30_000] {
            let rest: Vec<Vec3> =
                (0..n).map(|i| Vec3::new((i * 7919 % 10_007) as f32, (i * 104_729 % 9973) as f32, 0.0)).collect();
            let layout = Layout::new(&rest);
            let mut seen = layout.order.clone();
            seen.sort_unstable();
            assert!(seen.iter().copied().eq(0..n as u32), "{n}");
            let regions: Vec<u16> = layout.order.iter().map(|&v| layout.region_of[v as usize]).collect();
            assert!(regions.is_sorted());
            let mut sizes = vec![0; layout.regions];
            regions.iter().for_each(|&r| sizes[r as usize] += 1);
            assert!(sizes.iter().all(|&size| size <= REGION && (n == 0 || size > 0)), "{n}: {sizes:?}");
        }
    }

    #[test]
    fn neighbours_in_memory_are_near_in_space() {
        let n = 100u32;
        let rest: Vec<Vec3> = (0..n * n).map(|i| Vec3::new((i % n) as f32, (i / n) as f32, 0.0)).collect();
        let layout = Layout::new(&rest);
        let steps = layout.order.windows(2).map(|pair| rest[pair[0] as usize].distance(rest[pair[1] as usize]));
        let mean = steps.sum::<f32>() / (n * n - 1) as f32;
        // In random order it would be 52.
        assert!(mean < 6.0, "{mean}");
    }
}
