//! The grid of points by which a face is shown finer than it is simulated.

use bevy_math::Vec3;

/// Grid of `n` times `n` small triangles over a face, with n = 2^level.
///
/// Its points are numbered in rows that run along the face's first half-edge: the first point is corner 0, the last
/// corner 2.
///
/// ```
/// use bevy_coating::film::FaceGrid;
/// use bevy_math::Vec3;
///
/// let grid = FaceGrid::new(1);
/// assert_eq!((grid.points().len(), grid.triangles().len()), (6, 4));
/// assert_eq!(grid.points()[1], Vec3::new(0.5, 0.5, 0.0), "in the middle of the first edge");
/// assert_eq!(grid.edge(0), [0, 1, 2], "from corner 0 to corner 1");
/// assert_eq!(grid.edge(2), [5, 3, 0], "from corner 2 to corner 0");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceGrid {
    level: u32,
    points: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    edges: [Vec<u32>; 3],
}

impl FaceGrid {
    /// Highest level: 256 triangles a face.
    pub const MOST: u32 = 4;

    /// Returns the grid of `level`, at most [`MOST`](Self::MOST). Level 0 is the face itself.
    pub fn new(level: u32) -> Self {
        let level = level.min(Self::MOST);
        let n = 1u32 << level;
        // Number of points in the rows before row j.
        let before = |j: u32| j * (n + 1) - j * j.saturating_sub(1) / 2;
        let at = |i: u32, j: u32| before(j) + i;
        let mut grid = Self { level, ..Self::default() };
        for j in 0..=n {
            for i in 0..=n - j {
                let [b, c] = [i, j].map(|steps| steps as f32 / n as f32);
                grid.points.push(Vec3::new((n - i - j) as f32 / n as f32, b, c));
                if i + j < n {
                    grid.triangles.push([at(i, j), at(i + 1, j), at(i, j + 1)]);
                }
                if i + j + 1 < n {
                    grid.triangles.push([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                }
            }
        }
        grid.edges = [
            (0..=n).map(|i| at(i, 0)).collect(),
            (0..=n).map(|i| at(n - i, i)).collect(),
            (0..=n).map(|i| at(0, n - i)).collect(),
        ];
        grid
    }

    /// Returns the level.
    pub fn level(&self) -> u32 {
        self.level
    }

    /// Returns the barycentric coordinates of each point in the face's three corners.
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// Returns the points of this grid that are those of `coarser`, whose level is not above that of this.
    ///
    /// ```
    /// use bevy_coating::film::FaceGrid;
    ///
    /// let (fine, coarse) = (FaceGrid::new(3), FaceGrid::new(1));
    /// let same = fine.points_of(&coarse);
    /// assert!(same.iter().zip(coarse.points()).all(|(&i, &point)| fine.points()[i as usize] == point));
    /// ```
    pub fn points_of(&self, coarser: &Self) -> Vec<u32> {
        let step = 1 << (self.level - coarser.level.min(self.level));
        let (n, rows) = (1u32 << self.level, 1u32 << coarser.level);
        let before = |j: u32| j * (n + 1) - j * j.saturating_sub(1) / 2;
        (0..=rows).flat_map(|j| (0..=rows - j).map(move |i| before(j * step) + i * step)).collect()
    }

    /// Returns the points of each small triangle, wound as the face.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns the points of the small triangle at the barycentric coordinates `b`, and the weights of these points at
    /// `b`. Where `b` lies beyond the face, it is the nearest small triangle, and a weight is negative.
    ///
    /// ```
    /// use bevy_coating::film::FaceGrid;
    /// use bevy_math::Vec3;
    ///
    /// let grid = FaceGrid::new(2);
    /// let b = Vec3::new(0.3, 0.6, 0.1);
    /// let (points, weights) = grid.locate(b);
    /// let [p, q, r] = points.map(|i| grid.points()[i as usize]);
    /// assert!((p * weights.x + q * weights.y + r * weights.z).abs_diff_eq(b, 1e-6));
    /// ```
    pub fn locate(&self, b: Vec3) -> ([u32; 3], Vec3) {
        let n = 1u32 << self.level;
        let (x, y) = (b.y * n as f32, b.z * n as f32);
        // Conversions of floats saturate, so nothing is out of range however far `b` lies off.
        let j = (y.max(0.0) as u32).min(n - 1);
        let i = (x.max(0.0) as u32).min(n - 1 - j);
        let (x, y) = (x - i as f32, y - j as f32);
        let at = |i: u32, j: u32| j * (n + 1) - j * j.saturating_sub(1) / 2 + i;
        let (origin, right, up) = (at(i, j), at(i + 1, j), at(i, j + 1));
        // The triangle across the diagonal, if there is one.
        if x + y > 1.0 && i + j + 1 < n {
            return ([at(i + 1, j + 1), up, right], Vec3::new(x + y - 1.0, 1.0 - x, 1.0 - y));
        }
        ([origin, right, up], Vec3::new(1.0 - x - y, x, y))
    }

    /// Returns the points along the half-edge `k` of the face, from its origin to its target; none unless `k` is 0, 1
    /// or 2.
    pub fn edge(&self, k: usize) -> &[u32] {
        self.edges.get(k).map_or(&[], Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use bevy_math::Vec2;

    use super::*;

    #[test]
    fn places_are_found_in_and_beyond_the_face() {
        for level in 0..=FaceGrid::MOST {
            let grid = FaceGrid::new(level);
            for step in 0..400u32 {
                let (x, y) = ((step % 20) as f32 / 16.0 - 0.1, (step / 20) as f32 / 16.0 - 0.1);
                let b = Vec3::new(1.0 - x - y, x, y);
                let (points, weights) = grid.locate(b);
                assert!(grid.triangles().iter().any(|t| points.iter().all(|p| t.contains(p))), "{points:?}");
                let [p, q, r] = points.map(|i| grid.points()[i as usize]);
                assert!((p * weights.x + q * weights.y + r * weights.z).abs_diff_eq(b, 1e-5));
                let inside = b.min_element() >= 0.0;
                assert!(!inside || weights.min_element() > -1e-5, "{b}: {weights}");
            }
            assert_eq!(grid.locate(Vec3::X), (grid.triangles()[0], Vec3::X));
        }
    }

    #[test]
    fn grids_cover_the_face() {
        for level in 0..=FaceGrid::MOST {
            let grid = FaceGrid::new(level);
            let n = 1usize << level;
            assert_eq!((grid.points().len(), grid.triangles().len()), ((n + 1) * (n + 2) / 2, n * n));
            // Seen in the plane of two of the coordinates, the small triangles have the same area and winding.
            for t in grid.triangles() {
                let [a, b, c] = t.map(|i| grid.points()[i as usize]).map(|b| Vec2::new(b.y, b.z));
                let area = (b - a).perp_dot(c - a);
                assert!((area * (n * n) as f32 - 1.0).abs() < 1e-4, "{area}");
            }
            for k in 0..3 {
                let edge: Vec<_> = grid.edge(k).iter().map(|&i| grid.points()[i as usize]).collect();
                let ends = [k, (k + 1) % 3].map(|corner| Vec3::AXES[corner]);
                assert_eq!([edge[0], edge[n]], ends);
                assert!(edge.iter().all(|b| b[(k + 2) % 3] == 0.0));
                assert!(edge.windows(2).all(|pair| pair[0][k] > pair[1][k]));
            }
        }
        assert_eq!(FaceGrid::new(9), FaceGrid::new(FaceGrid::MOST));
        assert!(FaceGrid::new(1).edge(3).is_empty());
    }
}
