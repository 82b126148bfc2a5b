//! Cuts a surface into charts: patches that lie flat without folding over.

use bevy_math::{
    Vec2, Vec3,
    bounding::{Aabb3d, BoundingVolume},
};

use super::{boxes::SmallestBox, coverage::count_overlaps, sets::Sets};

/// Cosine of how far a chart's triangles may lean from its axis: 50 degrees, which squeezes texels to 64 %.
const LEAN: f32 = 0.643;
/// The same for crumbs that are given to a chart beside them: 65 degrees.
const CRUMB_LEAN: f32 = 0.423;
/// How often a chart's axis follows its growth.
const RECENTRED: u32 = 4;
/// Charts of so many triangles are crumbs.
const CRUMB: usize = 3;
/// Cosine of the sharpest edge inside a chart: 60 degrees.
const CREASE: f32 = 0.5;
/// Share of its box that a chart should fill.
const FULLNESS: f32 = 0.4;
/// Boxes that are less than this share of the whole surface may be filled worse.
const LARGE: f32 = 0.01;
/// No neighbour, no chart.
const NONE: u32 = u32::MAX;

/// Triangles that are laid out together.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// Indices of the triangles, ascending.
    pub triangles: Vec<u32>,
    /// Unit vector along which they are looked at; all of them face it.
    pub axis: Vec3,
}

impl Chart {
    /// Two unit vectors that are right and up for one who looks at the chart. Up is as near to +y as it can be.
    pub fn basis(&self) -> [Vec3; 2] {
        let up = if self.axis.y.abs() < 0.9 { Vec3::Y } else { Vec3::Z };
        let right = up.cross(self.axis).normalize_or(Vec3::X);
        [right, self.axis.cross(right)]
    }
}

/// Triangles, which of them share edges, and where they face.
struct Faces<'a> {
    positions: &'a [[f32; 3]],
    indices: &'a [u32],
    /// Unit normals; zero without area.
    normals: Vec<Vec3>,
    /// Twice the areas.
    areas: Vec<f32>,
    /// The triangle across each edge.
    beside: Vec<[u32; 3]>,
}

/// Cuts triangles into charts. Vertices at the same place are one.
pub fn charts(positions: &[[f32; 3]], indices: &[u32]) -> Vec<Chart> {
    let faces = Faces::new(positions, indices);
    let mut groups = faces.grow();
    faces.give_crumbs_away(&mut groups);
    let mut charts = Vec::new();
    let whole_area = faces.areas.iter().sum::<f32>() * 0.5;
    // Halve what does not lie flat well, such as a screw's thread, until all does: single triangles do.
    groups.reverse();
    while let Some(group) = groups.pop() {
        let chart = Chart { axis: faces.axis(&group), triangles: group };
        if faces.is_unfit(&chart, whole_area) {
            groups.extend(faces.halves(&chart.triangles));
        } else {
            charts.push(chart);
        }
    }
    charts
}

impl<'a> Faces<'a> {
    fn new(positions: &'a [[f32; 3]], indices: &'a [u32]) -> Self {
        let count = indices.len() / 3;
        let (mut normals, mut areas) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for t in indices.as_chunks::<3>().0 {
            let [a, b, c] = t.map(|v| Vec3::from(positions[v as usize]));
            let cross = (b - a).cross(c - a);
            normals.push(cross.normalize_or_zero());
            areas.push(cross.length());
        }
        let beside = neighbours(positions, indices);
        Self { positions, indices, normals, areas, beside }
    }

    fn neighbours(&self, f: u32) -> impl Iterator<Item = u32> + use<'_> {
        self.beside[f as usize].into_iter().filter(|&g| g != NONE)
    }

    /// Whether two triangles face about the same way. Those without area go with anything.
    fn faces(&self, f: u32, axis: Vec3, cosine: f32) -> bool {
        let normal = self.normals[f as usize];
        normal == Vec3::ZERO || normal.dot(axis) >= cosine
    }

    /// Grows charts from their first triangles.
    fn grow(&self) -> Vec<Vec<u32>> {
        let mut taken = vec![false; self.normals.len()];
        let mut groups = Vec::new();
        for seed in 0..self.normals.len() as u32 {
            if taken[seed as usize] {
                continue;
            }
            let mut group = self.grow_along(self.axis_around(seed), seed, &mut taken);
            // A chart grows away from those before it, so its axis follows, and it can grow further.
            for _ in 0..RECENTRED {
                let axis = self.axis(&group);
                if !self.faces(seed, axis, LEAN) {
                    break;
                }
                group.iter().for_each(|&f| taken[f as usize] = false);
                group = self.grow_along(axis, seed, &mut taken);
            }
            group.sort_unstable();
            groups.push(group);
        }
        groups
    }

    /// Takes what hangs smoothly together with `seed` and faces `axis`.
    fn grow_along(&self, axis: Vec3, seed: u32, taken: &mut [bool]) -> Vec<u32> {
        let (mut group, mut next) = (vec![seed], 0);
        taken[seed as usize] = true;
        while let Some(&f) = group.get(next) {
            next += 1;
            for g in self.neighbours(f) {
                let smooth = self.areas[f as usize] == 0.0 || self.faces(g, self.normals[f as usize], CREASE);
                if !taken[g as usize] && smooth && self.faces(g, axis, LEAN) {
                    taken[g as usize] = true;
                    group.push(g);
                }
            }
        }
        group
    }

    /// Axis of a chart that grows from `seed`: the mean normal of it and what lies smoothly beside it.
    fn axis_around(&self, seed: u32) -> Vec3 {
        let own = self.normals[seed as usize];
        let beside = self.neighbours(seed).filter(|&g| self.faces(g, own, CREASE));
        let sum: Vec3 = beside.map(|g| self.normals[g as usize] * self.areas[g as usize]).sum();
        let mean = (sum + own * self.areas[seed as usize]).normalize_or(own);
        if own.dot(mean) >= LEAN { mean } else { own }
    }

    /// Gives small groups to a group beside them that they face.
    fn give_crumbs_away(&self, groups: &mut Vec<Vec<u32>>) {
        let mut group_of = vec![NONE; self.normals.len()];
        for (i, group) in groups.iter().enumerate() {
            group.iter().for_each(|&f| group_of[f as usize] = i as u32);
        }
        let axes: Vec<Vec3> = groups.iter().map(|group| self.axis(group)).collect();
        for i in 0..groups.len() {
            if groups[i].len() > CRUMB {
                continue;
            }
            let mut beside = groups[i].iter().flat_map(|&f| self.neighbours(f)).map(|g| group_of[g as usize]);
            let home = beside.find(|&other| {
                let fits = |&f: &u32| self.faces(f, axes[other as usize], CRUMB_LEAN);
                other as usize != i && groups[other as usize].len() > CRUMB && groups[i].iter().all(fits)
            });
            if let Some(home) = home {
                let crumb = std::mem::take(&mut groups[i]);
                crumb.iter().for_each(|&f| group_of[f as usize] = home);
                groups[home as usize].extend(crumb);
                groups[home as usize].sort_unstable();
            }
        }
        groups.retain(|group| !group.is_empty());
    }

    /// Mean normal of a group, or the normal of its largest triangle if not all of them face that.
    fn axis(&self, group: &[u32]) -> Vec3 {
        let sum: Vec3 = group.iter().map(|&f| self.normals[f as usize] * self.areas[f as usize]).sum();
        let mean = sum.normalize_or(Vec3::Z);
        if group.iter().all(|&f| self.faces(f, mean, 0.2)) {
            return mean;
        }
        let largest = group.iter().copied().max_by(|&f, &g| self.areas[f as usize].total_cmp(&self.areas[g as usize]));
        largest.map_or(mean, |f| self.normals[f as usize].normalize_or(mean))
    }

    /// Whether a chart lies on itself when it is laid flat, or wastes so much of its box that halves are better.
    fn is_unfit(&self, chart: &Chart, whole_area: f32) -> bool {
        if chart.triangles.len() < 2 {
            return false;
        }
        if chart.triangles.iter().any(|&f| !self.faces(f, chart.axis, 0.0)) {
            return true;
        }
        let [right, up] = chart.basis();
        let flat = |v: u32| {
            let p = Vec3::from(self.positions[v as usize]);
            Vec2::new(p.dot(right), p.dot(up))
        };
        let corners = |&f: &u32| std::array::from_fn(|i| flat(self.indices[f as usize * 3 + i]));
        let triangles: Vec<[Vec2; 3]> = chart.triangles.iter().map(corners).collect();
        let area: f32 = chart.triangles.iter().map(|&f| self.areas[f as usize] * 0.5).sum();
        let around = SmallestBox::around(triangles.as_flattened()).area();
        let sprawls = around * FULLNESS > area && around > whole_area * LARGE;
        sprawls || count_overlaps(&triangles).0 > 0
    }

    /// Two halves of a group along its longest side, cut further into what hangs together.
    fn halves(&self, group: &[u32]) -> Vec<Vec<u32>> {
        let middle = |f: u32| -> Vec3 {
            let corners = &self.indices[f as usize * 3..][..3];
            corners.iter().map(|&v| Vec3::from(self.positions[v as usize])).sum::<Vec3>() / 3.0
        };
        let points = group.iter().map(|&f| middle(f).into()).map(|p| Aabb3d { min: p, max: p });
        let around = points.reduce(|a, b| a.merge(&b));
        let size = around.map_or(Vec3::ZERO, |around| (around.max - around.min).into());
        let axis = if size.x >= size.max_element() { 0 } else { if size.y >= size.max_element() { 1 } else { 2 } };
        let mut sorted = group.to_vec();
        sorted.sort_by(|&f, &g| middle(f)[axis].total_cmp(&middle(g)[axis]).then(f.cmp(&g)));
        let (low, high) = sorted.split_at(sorted.len() / 2);
        [high, low].into_iter().flat_map(|half| self.components(half)).collect()
    }

    /// Cuts a group into what hangs together across edges.
    fn components(&self, group: &[u32]) -> Vec<Vec<u32>> {
        let mut members = group.to_vec();
        members.sort_unstable();
        let mut sets = Sets::new(members.len());
        for (i, &f) in members.iter().enumerate() {
            for j in self.neighbours(f).filter_map(|g| members.binary_search(&g).ok()) {
                sets.join(i as u32, j as u32);
            }
        }
        sets.groups().into_iter().map(|set| set.into_iter().map(|i| members[i as usize]).collect()).collect()
    }
}

/// For each edge of each triangle the triangle that runs against it there, if there is exactly one.
fn neighbours(positions: &[[f32; 3]], indices: &[u32]) -> Vec<[u32; 3]> {
    let places = places(positions);
    let mut edges: Vec<(u32, u32, u32)> = Vec::with_capacity(indices.len());
    for (t, triangle) in indices.as_chunks::<3>().0.iter().enumerate() {
        let [a, b, c] = triangle.map(|v| places[v as usize]);
        for (i, (from, to)) in [(a, b), (b, c), (c, a)].into_iter().enumerate() {
            edges.push((from.min(to), from.max(to), (t * 6 + i * 2 + usize::from(from > to)) as u32));
        }
    }
    edges.sort_unstable();
    let mut beside = vec![[NONE; 3]; indices.len() / 3];
    for same in edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        if let &[(.., a), (.., b)] = same
            && a % 2 != b % 2
        {
            beside[a as usize / 6][a as usize % 6 / 2] = b / 6;
            beside[b as usize / 6][b as usize % 6 / 2] = a / 6;
        }
    }
    beside
}

/// A number for each vertex, the same for vertices at the same place.
fn places(positions: &[[f32; 3]]) -> Vec<u32> {
    let key = |v: u32| positions[v as usize].map(f32::to_bits);
    let mut sorted: Vec<u32> = (0..positions.len() as u32).collect();
    sorted.sort_unstable_by_key(|&v| (key(v), v));
    let mut places = vec![0; positions.len()];
    for group in sorted.chunk_by(|&a, &b| key(a) == key(b)) {
        group.iter().for_each(|&v| places[v as usize] = group[0]);
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of squares along `path`, `width` wide along z.
    fn strip(path: &[Vec2], width: f32) -> (Vec<[f32; 3]>, Vec<u32>) {
        let positions = path.iter().flat_map(|p| [[p.x, p.y, 0.0], [p.x, p.y, width]]).collect();
        let indices = (0..path.len() as u32 - 1).map(|i| 2 * i).flat_map(|i| [i, i + 1, i + 2, i + 2, i + 1, i + 3]);
        (positions, indices.collect())
    }

    #[test]
    fn a_cube_has_six_charts() {
        // Corners shared: the creases alone must cut.
        let positions: Vec<[f32; 3]> =
            (0..8).map(|i| [(i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2 & 1) as f32]).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let indices: Vec<u32> = quads.iter().flat_map(|&[a, b, c, d]| [a, b, c, a, c, d]).collect();
        let charts = charts(&positions, &indices);
        assert_eq!(charts.len(), 6);
        assert!(charts.iter().all(|chart| chart.triangles.len() == 2));
        assert_eq!(charts[0].axis, Vec3::NEG_Z);
    }

    #[test]
    fn a_pipe_is_cut_so_that_every_triangle_faces_its_axis() {
        let turn = |i: u32| Vec2::from_angle(i as f32 * std::f32::consts::TAU / 36.0);
        let (positions, indices) = strip(&(0..=36).map(turn).collect::<Vec<_>>(), 3.0);
        let charts = charts(&positions, &indices);
        assert!((3..=5).contains(&charts.len()), "{}", charts.len());
        let faces = Faces::new(&positions, &indices);
        for chart in &charts {
            assert!(chart.triangles.iter().all(|&f| faces.normals[f as usize].dot(chart.axis) > 0.4), "{chart:?}");
        }
        assert_eq!(charts.iter().map(|chart| chart.triangles.len()).sum::<usize>(), 72);
    }

    /// All of it faces up, but it runs twice around: laid flat at once, it would lie on itself.
    #[test]
    fn a_spiral_ramp_is_cut_where_it_would_lie_on_itself() {
        let turn = |i: u32| {
            let way = Vec2::from_angle(i as f32 * std::f32::consts::TAU / 36.0);
            [way * 2.0, way * 3.0].map(|p| [p.x, p.y, i as f32 * 0.02])
        };
        let positions: Vec<[f32; 3]> = (0..=72).flat_map(turn).collect();
        let (_, indices) = strip(&[Vec2::ZERO; 73], 1.0);
        let charts = charts(&positions, &indices);
        assert!((2..=6).contains(&charts.len()), "{}", charts.len());
    }
}
