//! The clean surface, with the lines that may bound the film's faces.

use bevy_math::Vec3;

use crate::{
    film::{FaceId, HalfEdgeId},
    remesh::{features::CREASE, project::Ground, seams::Seams, topology::Topology},
    rest::{LIGHT_PIECE, Rest, pieces},
    surface::{CleanSurface, Surface},
};

/// Clean surface over which points of faces are sought.
pub struct FineGround {
    topology: Topology,
    triangles: Vec<[Vec3; 3]>,
    /// Whether each half-edge lies on a crease, border or seam. The film follows all borders and seams, but not every
    /// crease.
    is_line: Vec<bool>,
    /// Whether each half-edge is one that no point crosses: a seam, or a crease that the film follows.
    is_wall: Vec<bool>,
}

impl FineGround {
    pub async fn new(surface: &Surface, clean: &CleanSurface, rest: &mut impl Rest) -> Self {
        let topology = Topology::new(&clean.triangles, clean.positions.len(), rest).await;
        let triangles: Vec<_> = clean.triangles.iter().map(|t| t.map(|v| clean.positions[v as usize])).collect();
        let normals: Vec<Vec3> = triangles.iter().map(|[a, b, c]| (b - a).cross(c - a).normalize_or_zero()).collect();
        rest.rest().await;
        let seams = Seams::new(surface, clean, rest).await;
        let mut is_line = vec![false; 3 * triangles.len()];
        let mut is_wall = is_line.clone();
        for half_edges in pieces(topology.half_edge_slots(), LIGHT_PIECE) {
            for h in topology.edges_in(half_edges) {
                let Some(t) = topology.twin(h) else {
                    is_line[h.index()] = true;
                    continue;
                };
                let is_seam = seams.divide(h, t, false);
                let is_crease = || normals[h.face().index()].dot(normals[t.face().index()]) < CREASE;
                let is_either = is_seam || is_crease();
                for h in [h, t] {
                    is_line[h.index()] = is_either;
                    is_wall[h.index()] = is_seam;
                }
            }
            rest.rest().await;
        }
        Self { topology, triangles, is_line, is_wall }
    }

    pub fn is_line(&self, h: HalfEdgeId) -> bool {
        self.is_line[h.index()]
    }

    /// Makes a wall of an edge that the film follows.
    pub fn raise_wall(&mut self, h: HalfEdgeId) {
        self.is_wall[h.index()] = true;
    }

    /// Returns the end points of a half-edge.
    pub fn ends(&self, h: HalfEdgeId) -> [Vec3; 2] {
        let triangle = self.triangles[h.face().index()];
        let k = h.index() % 3;
        [triangle[k], triangle[(k + 1) % 3]]
    }
}

impl Ground for FineGround {
    #[inline]
    fn topology(&self) -> &Topology {
        &self.topology
    }

    #[inline]
    fn triangle(&self, f: FaceId) -> [Vec3; 3] {
        self.triangles[f.index()]
    }

    #[inline]
    fn is_feature(&self, h: HalfEdgeId) -> bool {
        self.is_wall[h.index()]
    }
}
