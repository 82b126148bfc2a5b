//! Where rust comes out: the four rules at each tear (VC 6.1, fig. 9), and how much of a crack drains there.

use bevy_math::Vec3;

use super::{LEAST_PULL, RustSource, StainFields};
use crate::film::{FilmMesh, TearEnd, VertexId};

/// How much crack drains to each place. Every torn edge leads down from its upper end to its lower one; where a crack
/// leads to in the end, the lengths above add up.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Catchments {
    /// Original vertex that each original vertex drains to; itself where nothing leads on.
    drains: Vec<u32>,
    /// Metres of crack that drain to each original vertex that leads no further.
    lengths: Vec<f32>,
}

impl Catchments {
    pub fn new(vertices: usize) -> Self {
        Self { drains: (0..vertices as u32).collect(), lengths: vec![0.0; vertices] }
    }

    /// Adds a torn edge of `length` between originals.
    fn connect(&mut self, upper: VertexId, lower: VertexId, length: f32) {
        let root = self.root(lower.index());
        if self.drains[upper.index()] as usize == upper.index() && root != upper.index() {
            self.drains[upper.index()] = root as u32;
            self.lengths[root] += std::mem::take(&mut self.lengths[upper.index()]);
        }
        self.lengths[root] += length;
    }

    fn root(&mut self, mut v: usize) -> usize {
        while self.drains[v] as usize != v {
            // Halves the way for the next one who asks.
            self.drains[v] = self.drains[self.drains[v] as usize];
            v = self.drains[v] as usize;
        }
        v
    }

    /// Metres of crack that drain to `original` and no further.
    pub fn length(&self, original: VertexId) -> f32 {
        self.lengths[original.index()]
    }
}

/// Judges both ends of a tear at the moment of tearing: a crack's end that lies below the other end becomes a source,
/// one above it does not; a vertex that is no crack's end stays what it is if it lies below and is no source if above
/// (VC 6.1, rules 1 to 4; a tie counts as above). Duplicates are no sources, nor is a vertex along whose surface
/// `gravity` does not pull.
pub(super) fn judge(stains: &mut StainFields, mesh: &FilmMesh, ends: [TearEnd; 2], gravity: Vec3, length: f32) {
    let vertex = |end: TearEnd| match end {
        TearEnd::Opened(v) | TearEnd::Split { kept: v, .. } => v,
    };
    let original = |i: usize| mesh.topology.original(vertex(ends[i]));
    let depths = [0, 1].map(|i| mesh.geometry.rest_positions[original(i).index()].dot(gravity));
    for (i, end) in ends.into_iter().enumerate() {
        let below = depths[i] > depths[1 - i];
        let source = &mut stains.sources[vertex(end).index()];
        match (end, below) {
            (TearEnd::Opened(v), true) if is_steep(mesh, v, gravity) => *source = RustSource::Present,
            (TearEnd::Split { .. }, true) => {}
            _ => end_source(source),
        }
    }
    if depths[0] != depths[1] {
        let (upper, lower) = if depths[0] < depths[1] { (0, 1) } else { (1, 0) };
        stains.catchments.connect(original(upper), original(lower), length);
    }
}

/// Whether `gravity` pulls along the surface at `v`, at rest.
pub(super) fn is_steep(mesh: &FilmMesh, v: VertexId, gravity: Vec3) -> bool {
    let normal = mesh.geometry.rest_normals[v.index()];
    (gravity - normal * gravity.dot(normal)).length_squared() >= LEAST_PULL * LEAST_PULL
}

/// A source is one no more; what never was one stays so.
pub(super) fn end_source(source: &mut RustSource) {
    if *source == RustSource::Present {
        *source = RustSource::Past;
    }
}
