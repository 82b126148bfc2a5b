//! Dissolves triangles with three different vertices but no area into their neighbours. Dropping one would tear the
//! surface open.
//!
//! - A *needle* has two corners that almost coincide. Its short edge is collapsed.
//! - A *cap* has its middle vertex on its long edge, as a triangle that fills a T-junction. Every other face at the
//!   long edge is split at that vertex. In a manifold this is an edge flip.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use bevy_math::{DVec3, Vec3};

use super::face::{Face, has_repeats};
use crate::rest::{LIGHT_PIECE, PIECE, Rest, pieces};

/// A triangle counts as without area if its altitude is below this part of its longest edge, and below the welding
/// tolerance. Its angles are then below a ten-thousandth of a degree. Slivers of CAD programs are much fatter and are
/// left to the remesher.
const ALTITUDE: f64 = 1e-6;
/// Altitude of the thickest filler, in altitudes of the thickest triangle without area.
const FILLER: f64 = 4.0;
/// Number of times that caps may bring an edge back that another gave up. With rounding, a cluster of slivers may go
/// round in circles; one that is stopped at its first turn often has another way to go, one at its fourth never had.
const RETURNS: u32 = 4;

/// Dissolves slivers in place. Returns the number of slivers at the start. There must be no duplicate faces.
pub(super) async fn dissolve(faces: &mut Vec<Face>, positions: &[Vec3], tolerance: f64, rest: &mut impl Rest) -> usize {
    let mut slivers = Vec::new();
    for piece in pieces(faces.len(), LIGHT_PIECE) {
        let ranks = piece.map(|f| Some((sliver(&faces[f], positions, tolerance)?.rank(), Reverse(f))));
        slivers.extend(ranks.flatten());
        rest.rest().await;
    }
    let queue = BinaryHeap::from(slivers);
    let count = queue.len();
    if count == 0 {
        return 0;
    }
    let mut work = Dissolver::new(faces, positions, tolerance, queue, rest).await;
    // No edge comes back for ever, so this ends; the number of steps is bounded for the sake of time. Slivers that are
    // left then stay: thin, but watertight.
    let mut steps = 16 * count + 64;
    while steps > 0
        && let Some((_, Reverse(f))) = work.queue.pop()
    {
        work.step(f);
        steps -= 1;
        if steps.is_multiple_of(PIECE) {
            rest.rest().await;
        }
    }
    let mut dead = work.dead.into_iter();
    faces.retain(|_| !dead.next().unwrap_or(false));
    count
}

/// Shape of a triangle without area.
struct Sliver {
    /// Its longest edge runs from this corner to the next.
    long: usize,
    /// Where the third corner lies along the longest edge, 0 to 1.
    along: f64,
    length: f64,
    /// Which end the third corner coincides with, if it does: 0 or 1.
    needle: Option<usize>,
}

impl Sliver {
    /// Returns a rank that puts the longest sliver first, since the face beyond its long edge is rarely a sliver
    /// itself. The bits of a length are in the order of lengths, as none is negative.
    fn rank(&self) -> u64 {
        self.length.to_bits()
    }
}

/// Returns the shape of the face if it has no area.
fn sliver(face: &Face, positions: &[Vec3], tolerance: f64) -> Option<Sliver> {
    let (shape, thickness) = shape(face, positions, tolerance);
    // No number is as thin as can be.
    if thickness > 1.0 { None } else { Some(shape) }
}

/// Returns whether the face has so little area that it can only be there to fill a gap. Rounding of its corners may
/// have made a little more of it than of a triangle without area.
pub(super) fn is_filler(face: &Face, positions: &[Vec3], tolerance: f64) -> bool {
    shape(face, positions, tolerance).1 <= FILLER
}

/// Returns the shape that the face has if it has no area, and its altitude over the largest of such a one.
fn shape(face: &Face, positions: &[Vec3], tolerance: f64) -> (Sliver, f64) {
    let p = face.points(positions);
    let lengths = [0, 1, 2].map(|k| p[k].distance(p[(k + 1) % 3]));
    let long = (0..3).fold(0, |best, k| if lengths[k] > lengths[best] { k } else { best });
    let (a, b, c) = (p[long], p[(long + 1) % 3], p[(long + 2) % 3]);
    let length = lengths[long];
    let altitude = (b - a).cross(c - a).length() / length;
    // Coordinates are rounded to f32, which alone may lift the middle vertex off the edge.
    let rounding = 2.0 * f64::from(f32::EPSILON) * p.iter().fold(DVec3::ZERO, |m, p| m.max(p.abs())).max_element();
    let limit = (ALTITUDE * length).min(tolerance).max(rounding);
    let short = [lengths[(long + 2) % 3], lengths[(long + 1) % 3]];
    let end = usize::from(short[1] < short[0]);
    let shape = Sliver {
        long,
        along: ((c - a).dot(b - a) / (length * length)).clamp(0.0, 1.0),
        length,
        needle: (short[end] <= 2.0 * limit).then_some(end),
    };
    (shape, altitude / limit)
}

/// Faces by rank, then lowest index.
type Queue = BinaryHeap<(u64, Reverse<usize>)>;

struct Dissolver<'a> {
    faces: &'a mut Vec<Face>,
    positions: &'a [Vec3],
    tolerance: f64,
    dead: Vec<bool>,
    /// Sorted vertices of each face before any change; of a part of a face, those of the whole face. `None` of fillers:
    /// two of them on the same vertices are no sheet with two sides but one place that was filled twice.
    origin: Vec<Option<[u32; 3]>>,
    /// Edges that caps gave up, and how often.
    given_up: BTreeMap<[u32; 2], u32>,
    /// Faces at each vertex, in no particular order. Some may be dead or no longer at the vertex.
    at_vertex: Vec<Vec<u32>>,
    queue: Queue,
}

impl<'a> Dissolver<'a> {
    async fn new(
        faces: &'a mut Vec<Face>,
        positions: &'a [Vec3],
        tolerance: f64,
        queue: Queue,
        rest: &mut impl Rest,
    ) -> Self {
        let mut at_vertex = vec![Vec::new(); positions.len()];
        let mut origin = Vec::with_capacity(faces.len());
        for piece in pieces(faces.len(), LIGHT_PIECE) {
            for f in piece {
                let face = &faces[f];
                for v in face.vertices {
                    at_vertex[v as usize].push(f as u32);
                }
                origin.push((!is_filler(face, positions, tolerance)).then(|| sorted(face.vertices)));
            }
            rest.rest().await;
        }
        let dead = vec![false; faces.len()];
        Self { faces, positions, tolerance, dead, origin, given_up: BTreeMap::new(), at_vertex, queue }
    }

    fn step(&mut self, f: usize) {
        if self.dead[f] {
            return;
        }
        // The face may have changed since it was queued.
        let Some(sliver) = sliver(&self.faces[f], self.positions, self.tolerance) else { return };
        let corner = |k: usize| (sliver.long + k) % 3;
        let [a, b, c] = [0, 1, 2].map(|k| self.faces[f].vertices[corner(k)]);
        match sliver.needle {
            Some(end) => {
                let other = [a, b][end];
                self.collapse(c.max(other), c.min(other));
            }
            None => {
                let beyond = self.live_faces_with(a, b);
                let mut opposite = beyond.iter().flat_map(|&g| self.faces[g].vertices).filter(|v| ![a, b].contains(v));
                if opposite.any(|d| self.given_up.get(&ends(c, d)).is_some_and(|times| *times >= RETURNS)) {
                    return;
                }
                *self.given_up.entry(ends(a, b)).or_default() += 1;
                self.dead[f] = true;
                let apex = (c, self.faces[f].corners[corner(2)]);
                for g in beyond.into_iter().filter(|&g| g != f) {
                    self.split(g, a, b, apex, sliver.along);
                }
            }
        }
    }

    fn live_faces_with(&self, a: u32, b: u32) -> Vec<usize> {
        let mut found: Vec<_> = self.at_vertex[a as usize]
            .iter()
            .map(|&g| g as usize)
            .filter(|&g| !self.dead[g] && self.faces[g].vertices.contains(&a) && self.faces[g].vertices.contains(&b))
            .collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    fn collapse(&mut self, from: u32, to: u32) {
        let mut moved = std::mem::take(&mut self.at_vertex[from as usize]);
        moved.sort_unstable();
        moved.dedup();
        moved.retain(|&g| !self.dead[g as usize] && self.faces[g as usize].vertices.contains(&from));
        for &g in &moved {
            let vertices = &mut self.faces[g as usize].vertices;
            *vertices = vertices.map(|v| if v == from { to } else { v });
            self.at_vertex[to as usize].push(g);
        }
        for g in moved {
            self.settle(g as usize);
        }
    }

    /// Splits face `g` at the vertex `apex` (with its surface corner) that lies on its edge `a`, `b`, at
    /// `along` from `a`.
    fn split(&mut self, g: usize, a: u32, b: u32, apex: (u32, u32), along: f64) {
        let corner_of = |v: u32| self.faces[g].vertices.iter().position(|w| *w == v);
        let (Some(i), Some(j)) = (corner_of(a), corner_of(b)) else { return };
        let mut half = self.faces[g].clone();
        let weight = half.weights[i].lerp(half.weights[j], along as f32);
        // `g` keeps `a`, the new half keeps `b`.
        for (face, k) in [(&mut self.faces[g], j), (&mut half, i)] {
            face.vertices[k] = apex.0;
            face.corners[k] = apex.1;
            face.weights[k] = weight;
        }
        let new = self.faces.len();
        for v in half.vertices {
            self.at_vertex[v as usize].push(new as u32);
        }
        self.at_vertex[apex.0 as usize].push(g as u32);
        self.faces.push(half);
        self.origin.push(self.origin[g]);
        self.dead.push(false);
        self.settle(g);
        self.settle(new);
    }

    /// Checks a face after a change. Drops it if a vertex repeats or another face has come to lie on it; queues it if
    /// it has no area.
    fn settle(&mut self, g: usize) {
        if self.dead[g] {
            return;
        }
        if has_repeats(self.faces[g].vertices) {
            self.dead[g] = true;
        } else if let Some(other) = self.folded_onto(g) {
            // The two faces lie on each other and enclose no volume. Without them the faces around them meet.
            self.dead[g] = true;
            self.dead[other] = true;
        } else if let Some(sliver) = sliver(&self.faces[g], self.positions, self.tolerance) {
            self.queue.push((sliver.rank(), Reverse(g)));
        }
    }

    /// Returns another face on the same vertices, unless the two were the sides of one sheet from the start: two
    /// triangles with area on the same vertices.
    fn folded_onto(&self, g: usize) -> Option<usize> {
        let vertices = sorted(self.faces[g].vertices);
        let others = self.at_vertex[vertices[0] as usize].iter().map(|&h| h as usize);
        others
            .filter(|&h| h != g && !self.dead[h] && sorted(self.faces[h].vertices) == vertices)
            .filter(|&h| !self.is_sheet(g, h))
            .min()
    }

    fn is_sheet(&self, g: usize, h: usize) -> bool {
        // Two parts of one triangle that have come to lie on each other are none.
        self.faces[g].source != self.faces[h].source && self.origin[g].is_some() && self.origin[g] == self.origin[h]
    }
}

/// Returns an edge, whichever way it runs.
fn ends(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn sorted(mut vertices: [u32; 3]) -> [u32; 3] {
    vertices.sort_unstable();
    vertices
}
