//! How the points of a face's grid divide among its corners, its edges and its inside.

use bevy_math::{Vec3, Vec3A};

use super::patch::weights;
use crate::film::FaceGrid;

/// Part of a face that a point of its grid belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// The corner with this number.
    Corner(usize),
    /// The half-edge with this number, and which of its inner points it is, counted along it.
    Edge(usize, usize),
    /// Which of the points inside it is.
    Inside(usize),
}

/// Place on a face, with the weights there of a patch's control points.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// Barycentric coordinates.
    pub b: Vec3,
    pub weights: [f32; 10],
}

/// Place on an edge.
#[derive(Clone, Copy, Debug)]
pub(super) struct EdgeSpot {
    /// Shares of its two ends.
    pub shares: [f32; 2],
    /// Weights of the control points of its curve.
    pub weights: [f32; 4],
}

/// The points of a grid by what they belong to.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Layout {
    pub grid: FaceGrid,
    /// Role of each point of the grid.
    pub(super) roles: Vec<Role>,
    /// Inner points of an edge.
    pub(super) edge: Vec<EdgeSpot>,
    /// Inner points of each of the three half-edges, as places on the face.
    pub(super) edges: [Vec<Vec3>; 3],
    /// Points inside.
    pub(super) inside: Vec<Spot>,
}

impl Spot {
    pub fn new(b: Vec3) -> Self {
        Self { b, weights: weights(b) }
    }
}

impl EdgeSpot {
    fn new(t: f32) -> Self {
        let s = 1.0 - t;
        Self { shares: [s, t], weights: [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t] }
    }

    /// Returns the mean of what is at the two ends.
    #[inline]
    pub fn mix(&self, [a, b]: [Vec3A; 2]) -> Vec3A {
        a * self.shares[0] + b * self.shares[1]
    }
}

impl Layout {
    /// Returns the layout of the grid of `level`.
    pub fn new(level: u32) -> Self {
        let grid = FaceGrid::new(level);
        let mut roles = vec![None; grid.points().len()];
        for k in 0..3 {
            let row = grid.edge(k);
            for (i, &point) in row.iter().enumerate().take(row.len() - 1) {
                roles[point as usize] = Some(if i == 0 { Role::Corner(k) } else { Role::Edge(k, i - 1) });
            }
        }
        let mut inside = Vec::new();
        for (role, &b) in roles.iter_mut().zip(grid.points()) {
            if role.is_none() {
                *role = Some(Role::Inside(inside.len()));
                inside.push(Spot::new(b));
            }
        }
        let n = grid.edge(0).len() - 1;
        let on_edge = |k: usize| grid.edge(k)[1..n].iter().map(|&point| grid.points()[point as usize]).collect();
        Self {
            roles: roles.into_iter().flatten().collect(),
            edge: (1..n).map(|i| EdgeSpot::new(i as f32 / n as f32)).collect(),
            edges: [0, 1, 2].map(on_edge),
            inside,
            grid,
        }
    }

    /// Returns the number of points inside an edge.
    #[inline]
    pub fn edge_points(&self) -> usize {
        self.edge.len()
    }

    /// Returns the number of points inside a face.
    #[inline]
    pub fn inner_points(&self) -> usize {
        self.inside.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_has_one_role() {
        for level in 1..=FaceGrid::MOST {
            let layout = Layout::new(level);
            let points = layout.grid.points();
            assert_eq!(layout.roles.len(), points.len());
            assert_eq!(points.len(), 3 + 3 * layout.edge_points() + layout.inner_points());
            for (role, &b) in layout.roles.iter().zip(points) {
                let own = match *role {
                    Role::Corner(k) => Vec3::AXES[k],
                    Role::Edge(k, i) => {
                        let [from, to] = layout.edge[i].shares;
                        let along = Vec3::AXES[k] * from + Vec3::AXES[(k + 1) % 3] * to;
                        assert_eq!(layout.edges[k][i], along);
                        along
                    }
                    Role::Inside(i) => layout.inside[i].b,
                };
                assert_eq!(own, b, "{role:?}");
            }
            for spot in &layout.edge {
                assert!((spot.weights.iter().sum::<f32>() - 1.0).abs() < 1e-6);
                assert_eq!(spot.mix([Vec3A::ONE; 2]), Vec3A::ONE);
            }
        }
    }
}
