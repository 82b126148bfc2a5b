//! Finds how far apart the film's vertices may lie on strips that are narrower than its edges.
//!
//! Equilateral triangles do not fit a strip narrower than they are high. There the film has longer triangles of the same
//! area, so that poles, bars and the rims of sheets take no more than their share of the triangles.

use super::chains::{Chains, NO_CHAIN};
use super::topology::Topology;
use crate::film::HalfEdgeId;
use bevy_math::Vec3;

/// Largest length of an edge on a narrow strip, in target edges.
const LONGEST: f32 = 8.0;

/// Factors by which edges may be longer than the target.
pub(super) struct Sizing {
    /// Factor of each patch: 1 where it is wide.
    pub patches: Vec<f32>,
    /// Factor of each chain: the smaller one of the patches on its sides.
    pub chains: Vec<f32>,
}

impl Sizing {
    /// Measures patches and chains for a film of edge length `target`.
    pub fn new(
        topology: &Topology,
        positions: &[Vec3],
        patch_of: &[u32],
        chain_of: &[u32],
        chains: &Chains,
        target: f32,
    ) -> Self {
        let count = patch_of.iter().map(|&p| p as usize + 1).max().unwrap_or_default();
        let (mut areas, mut perimeters) = (vec![0.0_f64; count], vec![0.0_f64; count]);
        let is_line = |h: HalfEdgeId| chain_of[h.index()] != NO_CHAIN;
        for f in topology.faces() {
            let patch = patch_of[f.index()] as usize;
            let [a, b, c] = topology.corners(f).map(|v| positions[v.index()].as_dvec3());
            areas[patch] += 0.5 * (b - a).cross(c - a).length();
            for h in f.half_edges().into_iter().filter(|&h| is_line(h)) {
                let ends = [topology.origin(h), topology.target(h)].map(|v| positions[v.index()]);
                perimeters[patch] += f64::from(ends[0].distance(ends[1]));
            }
        }
        let height = 0.75_f64.sqrt() * f64::from(target);
        let patches: Vec<f32> = areas
            .iter()
            .zip(&perimeters)
            .map(|(&area, &perimeter)| (height / width(area, perimeter)).clamp(1.0, f64::from(LONGEST)) as f32)
            .collect();
        let mut of_chains = vec![LONGEST; chains.count() as usize];
        for f in topology.faces() {
            for h in f.half_edges().into_iter().filter(|&h| is_line(h)) {
                let factor = &mut of_chains[chain_of[h.index()] as usize];
                *factor = factor.min(patches[patch_of[f.index()] as usize]);
            }
        }
        Self { patches, chains: of_chains }
    }
}

/// Returns the width of the rectangle with this area and perimeter, or of the square with this perimeter where there is
/// no such rectangle.
fn width(area: f64, perimeter: f64) -> f64 {
    let root = (perimeter * perimeter - 16.0 * area).max(0.0).sqrt();
    // Not (perimeter - root) / 4, which cancels on long strips.
    (4.0 * area / (perimeter + root)).max(f64::MIN_POSITIVE)
}
