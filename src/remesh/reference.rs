//! The clean surface, with its features, onto which the film is projected.

use bevy_math::Vec3;

use super::chains::{Chains, NO_CHAIN};
use super::features::{Features, Scale};
use super::noise::drop_noise;
use super::project::Ground;
use super::sizing::Sizing;
use super::topology::Topology;
use crate::{
    film::{FaceId, HalfEdgeId},
    rest::Rest,
    surface::{CleanSurface, Surface},
};

/// Clean surface with its features, onto which the film is projected.
pub(super) struct Reference<'a> {
    pub topology: Topology,
    pub positions: &'a [Vec3],
    /// Corner positions of each triangle, stored together because projection reads little else.
    pub triangles: Vec<[Vec3; 3]>,
    /// Chain that each half-edge lies on, or [`NO_CHAIN`].
    pub chain_of: Vec<u32>,
    pub chains: Chains,
    /// Whether each vertex is fixed: the film has a vertex there.
    pub fixed: Vec<bool>,
    /// Patch of each triangle: see `Features::patches`.
    pub patches: Vec<u32>,
    pub sizing: Sizing,
    /// Factor of the distances from the surface that are allowed.
    pub closeness: f32,
}

impl<'a> Reference<'a> {
    /// Prepares the surface for a film of this scale.
    pub async fn new(surface: &Surface, clean: &'a CleanSurface, scale: Scale, rest: &mut impl Rest) -> Self {
        let positions = &clean.positions;
        let topology = Topology::new(&clean.triangles, positions.len(), rest).await;
        let normals: Vec<Vec3> = topology
            .faces()
            .map(|f| {
                let [a, b, c] = topology.corners(f).map(|v| positions[v.index()]);
                (b - a).cross(c - a).normalize_or_zero()
            })
            .collect();
        rest.rest().await;
        let mut features = Features::find(surface, clean, &topology, &normals, scale, rest).await;
        let target = scale.target;
        drop_noise(&mut features, &topology, positions, target, rest).await;
        let mut fixed = features.rigid_vertices(&topology);
        let (chains, chain_of) = Chains::new(&topology, positions, &features, target, &mut fixed, rest).await;
        let patches = features.patches(&topology);
        rest.rest().await;
        let sizing = Sizing::new(&topology, positions, &patches, &chain_of, &chains, scale);
        rest.rest().await;
        let triangles = topology.faces().map(|f| topology.corners(f).map(|v| positions[v.index()])).collect();
        Self { topology, positions, triangles, chain_of, chains, fixed, patches, sizing, closeness: 1.0 }
    }

    /// Returns the largest distance of a chain from the chord between two arc lengths, over the scale of the part.
    pub fn strays(&self, chain: u32, from: f32, to: f32) -> f32 {
        self.chains.deviation(self.positions, chain, from, to) / self.sizing.chain_scales[chain as usize]
    }
}

impl Ground for Reference<'_> {
    #[inline]
    fn topology(&self) -> &Topology {
        &self.topology
    }

    #[inline]
    fn triangle(&self, f: FaceId) -> [Vec3; 3] {
        self.triangles[f.index()]
    }

    /// Returns whether the film must follow this edge.
    #[inline]
    fn is_feature(&self, h: HalfEdgeId) -> bool {
        self.chain_of[h.index()] != NO_CHAIN
    }
}
