//! Feature lines as polylines over the clean mesh, measured by arc length.
//!
//! Feature edges are joined into chains between fixed vertices: junctions, ends and sharp turns. A film vertex on a
//! chain has one coordinate, its arc length, and moves along the chain only. The two ends of a chain are always
//! different vertices, so the arc length of a fixed vertex on a chain is known.

use std::ops::Range;

use bevy_math::Vec3;

use super::features::Features;
use super::topology::Topology;
use crate::{
    film::{HalfEdgeId, VertexId},
    rest::{LIGHT_PIECE, PIECE, Rest, pieces},
};

/// Index of no chain, for edges that are not features.
pub(super) const NO_CHAIN: u32 = u32::MAX;

/// Turns sharper than this (cosine of 50 degrees), seen at the scale of the film's edges, are corners.
const SHARP_TURN: f32 = 0.643;

/// One directed feature edge of the clean mesh.
#[derive(Clone, Copy)]
struct Link {
    to: VertexId,
    /// The half-edge along the link and the one against it. On a border there is only one of them.
    forward: Option<HalfEdgeId>,
    backward: Option<HalfEdgeId>,
}

/// All chains, in flat arrays.
#[derive(Clone, Debug, Default)]
pub(super) struct Chains {
    ranges: Vec<Range<usize>>,
    vertices: Vec<VertexId>,
    /// Arc length from the chain's start.
    lengths: Vec<f32>,
    /// Half-edges along the chain from each vertex to the next and back.
    forward: Vec<Option<HalfEdgeId>>,
    backward: Vec<Option<HalfEdgeId>>,
}

/// A point on a chain: the half-edge of the clean mesh it lies on, and how far along.
#[derive(Clone, Copy, Debug)]
pub(super) struct ChainPoint {
    pub half_edge: HalfEdgeId,
    pub fraction: f32,
}

impl Chains {
    /// Joins the feature edges into chains. Returns the chains and the chain of every half-edge, and marks the vertices
    /// at which chains end in `fixed`.
    pub async fn new(
        topology: &Topology,
        positions: &[Vec3],
        features: &Features,
        target: f32,
        fixed: &mut [bool],
        rest: &mut impl Rest,
    ) -> (Self, Vec<u32>) {
        let mut links = Vec::new();
        for piece in pieces(topology.vertex_slots(), LIGHT_PIECE) {
            for v in piece.map(VertexId::new) {
                collect_links(topology, features, v, &mut links);
                fixed[v.index()] |= !links.is_empty() && links.len() != 2;
            }
            rest.rest().await;
        }
        let mut chains = Self::default();
        let mut chain_of = vec![NO_CHAIN; 3 * topology.face_slots()];
        let mut seen = vec![false; 3 * topology.face_slots()];
        let mut trace = |start: VertexId, fixed: &mut [bool]| {
            collect_links(topology, features, start, &mut links);
            for first in links.clone() {
                if first.forward.or(first.backward).is_some_and(|h| seen[h.index()]) {
                    continue;
                }
                let mut vertices = vec![start];
                let mut path = Vec::new();
                let mut link = first;
                loop {
                    for h in [link.forward, link.backward].into_iter().flatten() {
                        seen[h.index()] = true;
                    }
                    path.push(link);
                    vertices.push(link.to);
                    if link.to == start || fixed[link.to.index()] {
                        break;
                    }
                    collect_links(topology, features, link.to, &mut links);
                    let Some(&onward) =
                        links.iter().find(|l| !l.forward.or(l.backward).is_some_and(|h| seen[h.index()]))
                    else {
                        break;
                    };
                    link = onward;
                }
                chains.cut_and_add(positions, &vertices, &path, target, fixed, &mut chain_of);
            }
        };
        let ends: Vec<_> = (0..topology.vertex_slots()).map(VertexId::new).filter(|v| fixed[v.index()]).collect();
        for piece in ends.chunks(PIECE) {
            piece.iter().for_each(|&v| trace(v, fixed));
            rest.rest().await;
        }
        // The lines that are left are closed and have no corner.
        for piece in pieces(topology.vertex_slots(), LIGHT_PIECE) {
            piece.map(VertexId::new).for_each(|v| trace(v, fixed));
            rest.rest().await;
        }
        (chains, chain_of)
    }

    /// Cuts a polyline at its sharp turns, and into three chains if it is a loop, and adds the chains.
    fn cut_and_add(
        &mut self,
        positions: &[Vec3],
        vertices: &[VertexId],
        path: &[Link],
        target: f32,
        fixed: &mut [bool],
        chain_of: &mut [u32],
    ) {
        let point = |i: usize| positions[vertices[i].index()];
        let mut lengths = vec![0.0];
        for i in 0..path.len() {
            lengths.push(lengths[i] + point(i).distance(point(i + 1)));
        }
        let last = path.len();
        let mut cuts = vec![0];
        cuts.extend(sharp_turns(&point, &lengths, 0.5 * target));
        cuts.push(last);
        if vertices[0] == vertices[last] && cuts.len() < 4 {
            // A loop needs three corners. To those that it has, the vertices nearest to its thirds are added.
            for third in [1.0, 2.0] {
                let wanted = lengths[last] * third / 3.0;
                let nearest = (1..last)
                    .filter(|i| !cuts.contains(i))
                    .min_by(|&i, &j| (lengths[i] - wanted).abs().total_cmp(&(lengths[j] - wanted).abs()));
                cuts.extend(nearest);
            }
            cuts.sort_unstable();
        }
        for cut in cuts.windows(2) {
            let chain = self.ranges.len() as u32;
            let begin = self.vertices.len();
            for i in cut[0]..=cut[1] {
                self.vertices.push(vertices[i]);
                self.lengths.push(lengths[i] - lengths[cut[0]]);
                let link = path.get(i).filter(|_| i < cut[1]);
                self.forward.push(link.and_then(|l| l.forward));
                self.backward.push(link.and_then(|l| l.backward));
                for h in link.into_iter().flat_map(|l| [l.forward, l.backward]).flatten() {
                    chain_of[h.index()] = chain;
                }
            }
            self.ranges.push(begin..self.vertices.len());
            fixed[vertices[cut[0]].index()] = true;
            fixed[vertices[cut[1]].index()] = true;
        }
    }

    /// Iterates over the vertices of a chain with their arc lengths.
    pub fn points(&self, chain: u32) -> impl Iterator<Item = (VertexId, f32)> + '_ {
        let range = self.ranges[chain as usize].clone();
        self.vertices[range.clone()].iter().copied().zip(self.lengths[range].iter().copied())
    }

    pub fn count(&self) -> u32 {
        self.ranges.len() as u32
    }

    /// Returns the arc length of the end of the chain that is the fixed vertex `v`.
    pub fn end(&self, chain: u32, v: VertexId) -> f32 {
        let range = &self.ranges[chain as usize];
        if self.vertices[range.start] == v { 0.0 } else { self.lengths[range.end - 1] }
    }

    /// Returns the index, in the flat arrays, of the chain's edge at arc length `s`.
    fn edge_at(&self, chain: u32, s: f32) -> usize {
        let range = self.ranges[chain as usize].clone();
        let after = self.lengths[range.clone()].partition_point(|&l| l <= s);
        range.start + after.saturating_sub(1).min(range.len().saturating_sub(2))
    }

    fn fraction(&self, edge: usize, s: f32) -> f32 {
        let (from, to) = (self.lengths[edge], self.lengths[edge + 1]);
        if to > from { ((s - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// Returns the point of the chain at arc length `s`.
    pub fn position(&self, positions: &[Vec3], chain: u32, s: f32) -> Vec3 {
        let edge = self.edge_at(chain, s);
        let at = |i: usize| positions[self.vertices[i].index()];
        at(edge).lerp(at(edge + 1), self.fraction(edge, s))
    }

    /// Returns the point at arc length `s` on the left side of the chain, as seen when walking `along` its arc length
    /// (or against it). On a border the only side is returned.
    pub fn side(&self, chain: u32, s: f32, along: bool) -> Option<ChainPoint> {
        let edge = self.edge_at(chain, s);
        let fraction = self.fraction(edge, s);
        let forward = self.forward[edge].map(|half_edge| ChainPoint { half_edge, fraction });
        let backward = self.backward[edge].map(|half_edge| ChainPoint { half_edge, fraction: 1.0 - fraction });
        if along { forward.or(backward) } else { backward.or(forward) }
    }

    /// Returns the largest distance of the chain from the chord between two of its points.
    pub fn deviation(&self, positions: &[Vec3], chain: u32, from: f32, to: f32) -> f32 {
        let (from, to) = if from <= to { (from, to) } else { (to, from) };
        let (a, b) = (self.position(positions, chain, from), self.position(positions, chain, to));
        let range = self.ranges[chain as usize].clone();
        let lengths = &self.lengths[range.clone()];
        let inner = lengths.partition_point(|&l| l <= from)..lengths.partition_point(|&l| l < to);
        inner.map(|i| distance_to_segment(positions[self.vertices[range.start + i].index()], a, b)).fold(0.0, f32::max)
    }
}

/// Collects the feature edges around a vertex.
fn collect_links(topology: &Topology, features: &Features, v: VertexId, links: &mut Vec<Link>) {
    links.clear();
    let mut last = None;
    for h in topology.ring(v) {
        if features.is_kept(h) {
            links.push(Link { to: topology.target(h), forward: Some(h), backward: topology.twin(h) });
        }
        last = Some(h);
    }
    if let Some(h) = last.map(HalfEdgeId::previous)
        && topology.twin(h).is_none()
    {
        links.push(Link { to: topology.origin(h), forward: None, backward: Some(h) });
    }
}

/// Returns the inner points at which the polyline turns sharply, measured over the length `reach` ahead and back. Of
/// several such points within that length only the sharpest is returned.
fn sharp_turns(point: &dyn Fn(usize) -> Vec3, lengths: &[f32], reach: f32) -> Vec<usize> {
    let last = lengths.len() - 1;
    let at = |s: f32| {
        let i = lengths.partition_point(|&l| l <= s).clamp(1, last);
        let span = lengths[i] - lengths[i - 1];
        let t = if span > 0.0 { ((s - lengths[i - 1]) / span).clamp(0.0, 1.0) } else { 0.0 };
        point(i - 1).lerp(point(i), t)
    };
    let turn: Vec<f32> = (0..=last)
        .map(|i| {
            let s = lengths[i];
            if i == 0 || i == last {
                return 1.0;
            }
            let back = (point(i) - at((s - reach).max(0.0))).normalize_or_zero();
            let ahead = (at((s + reach).min(lengths[last])) - point(i)).normalize_or_zero();
            back.dot(ahead)
        })
        .collect();
    (1..last)
        .filter(|&i| {
            turn[i] < SHARP_TURN
                && (1..last)
                    .rev()
                    .skip_while(|&j| j >= i)
                    .take_while(|&j| lengths[i] - lengths[j] < reach)
                    .all(|j| turn[j] > turn[i])
                && (i + 1..last).take_while(|&j| lengths[j] - lengths[i] < reach).all(|j| turn[j] >= turn[i])
        })
        .collect()
}

fn distance_to_segment(p: Vec3, a: Vec3, b: Vec3) -> f32 {
    let ab = b - a;
    let t = (p - a).dot(ab) / ab.length_squared().max(f32::MIN_POSITIVE);
    p.distance(a + ab * t.clamp(0.0, 1.0))
}
