//! Finds how far apart the film's vertices lie where the target edge does not fit the prop.
//!
//! - Equilateral triangles do not fit a strip narrower than they are high. If such strips would take much more than
//!   their share of the triangles, the film has longer triangles of the same area there.
//! - A small part, such as a rivet, would vanish in triangles of the target's size. The film is finer there.

use bevy_math::Vec3;

use super::chains::{Chains, NO_CHAIN};
use super::features::Scale;
use super::target::{count_of_edge, edge_of_area};
use super::topology::Topology;
use crate::film::HalfEdgeId;

/// Largest length of an edge on a narrow strip, in target edges.
const LONGEST: f64 = 8.0;
/// Number of triangles over that asked for up to which narrow strips have triangles as short as all others.
const SPARE: f64 = 1.25;
/// Wanted number of triangles of a small part.
const PART: f64 = 32.0;
/// Number of triangles with which a small part still shows its shape.
pub(super) const LEAST_PART: f64 = 12.0;
/// Largest share of all triangles that small parts may take.
const PARTS_SHARE: f64 = 0.5;

/// Factors by which lengths differ from those of the target.
#[derive(Debug, Default)]
pub(super) struct Sizing {
    /// Factor of the edges in each patch.
    pub patches: Vec<f32>,
    /// Factor of the edges on each chain: the smaller one of the patches on its sides.
    pub chains: Vec<f32>,
    /// Factor of all tolerances in each patch: below 1 on small parts only.
    pub patch_scales: Vec<f32>,
    /// The same for each chain.
    pub chain_scales: Vec<f32>,
    /// Number of small parts that must go without their share of triangles, because there are too many.
    pub starved: u32,
}

/// Measures of a region.
#[derive(Clone, Copy, Default)]
struct Region {
    area: f64,
    perimeter: f64,
    faces: u32,
}

impl Sizing {
    /// Measures patches, chains and parts for a film of this scale.
    pub fn new(
        topology: &Topology,
        positions: &[Vec3],
        patch_of: &[u32],
        chain_of: &[u32],
        chains: &Chains,
        scale: Scale,
    ) -> Self {
        let edge = f64::from(scale.target);
        let count = patch_of.iter().map(|&p| p as usize + 1).max().unwrap_or_default();
        let part_of_patch = parts(topology, patch_of, count);
        let is_line = |h: HalfEdgeId| chain_of[h.index()] != NO_CHAIN;
        let mut patches = vec![Region::default(); count];
        for f in topology.faces() {
            let patch = &mut patches[patch_of[f.index()] as usize];
            let [a, b, c] = topology.corners(f).map(|v| positions[v.index()].as_dvec3());
            patch.area += 0.5 * (b - a).cross(c - a).length();
            patch.faces += 1;
            for h in f.half_edges().into_iter().filter(|&h| is_line(h)) {
                let [a, b] = [topology.origin(h), topology.target(h)].map(|v| positions[v.index()]);
                patch.perimeter += f64::from(a.distance(b));
            }
        }
        let mut sizing = Self::default();
        let scales = sizing.scale_parts(&patches, &part_of_patch, scale);
        // A strip has a triangle at each edge of its rim.
        let needed: f64 =
            patches.iter().map(|patch| count_of_edge(patch.area, scale.target).max(patch.perimeter / edge)).sum();
        let is_crowded = needed > SPARE * f64::from(scale.triangles);
        for (patch, scale) in patches.iter().zip(&scales) {
            let height = 0.75_f64.sqrt() * edge * scale;
            let stretch = if is_crowded { (height / width(patch)).clamp(1.0, LONGEST) } else { 1.0 };
            sizing.patches.push((scale * stretch) as f32);
            sizing.patch_scales.push(*scale as f32);
        }
        sizing.chains = vec![f32::MAX; chains.count() as usize];
        sizing.chain_scales = sizing.chains.clone();
        for f in topology.faces() {
            let patch = patch_of[f.index()] as usize;
            for h in f.half_edges().into_iter().filter(|&h| is_line(h)) {
                let chain = chain_of[h.index()] as usize;
                sizing.chains[chain] = sizing.chains[chain].min(sizing.patches[patch]);
                sizing.chain_scales[chain] = sizing.chain_scales[chain].min(sizing.patch_scales[patch]);
            }
        }
        sizing
    }

    /// Returns the factor by which edges are shorter on each patch because it belongs to a small part.
    fn scale_parts(&mut self, patches: &[Region], part_of: &[u32], scale: Scale) -> Vec<f64> {
        let mut parts = vec![Region::default(); patches.len()];
        for (patch, &part) in patches.iter().zip(part_of) {
            parts[part as usize].area += patch.area;
            parts[part as usize].faces += patch.faces;
        }
        // A part that was modelled with few triangles needs no more.
        let wants = |part: &Region| f64::from(part.faces).min(PART);
        let is_small =
            |part: &&Region| part.faces as f64 > LEAST_PART && count_of_edge(part.area, scale.target) < wants(part);
        let small = parts.iter().filter(is_small).count();
        let affordable = PARTS_SHARE * f64::from(scale.triangles) / small.max(1) as f64;
        let is_affordable = affordable >= LEAST_PART;
        self.starved = if is_affordable { 0 } else { small as u32 };
        let factor = |part: &Region| {
            if !is_affordable || !is_small(&part) {
                return 1.0;
            }
            (f64::from(edge_of_area(part.area / wants(part).min(affordable))) / f64::from(scale.target)).min(1.0)
        };
        part_of.iter().map(|&part| factor(&parts[part as usize])).collect()
    }
}

/// Returns the part of each patch: its lowest patch. A part is all that hangs together.
fn parts(topology: &Topology, patch_of: &[u32], count: usize) -> Vec<u32> {
    let mut parents: Vec<u32> = (0..count as u32).collect();
    fn root(parents: &mut [u32], mut patch: u32) -> u32 {
        while parents[patch as usize] != patch {
            parents[patch as usize] = parents[parents[patch as usize] as usize];
            patch = parents[patch as usize];
        }
        patch
    }
    for h in topology.edges() {
        if let Some(t) = topology.twin(h) {
            let [a, b] = [h, t].map(|h| root(&mut parents, patch_of[h.face().index()]));
            parents[a.max(b) as usize] = a.min(b);
        }
    }
    (0..count as u32).map(|patch| root(&mut parents, patch)).collect()
}

/// Returns the width of the rectangle with the region's area and perimeter, or of a wider one if there is no such
/// rectangle.
fn width(region: &Region) -> f64 {
    let root = (region.perimeter * region.perimeter - 16.0 * region.area).max(0.0).sqrt();
    if region.perimeter <= 0.0 {
        return f64::MAX;
    }
    // As (perimeter - root) / 4, which cancels on long strips. Where there is no rectangle this is the area over the
    // quarter of the perimeter, and regions such as tubes between two rims count as wide.
    (4.0 * region.area / (region.perimeter + root)).max(f64::MIN_POSITIVE)
}
