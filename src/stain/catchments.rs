//! Adds up the lengths of cracks that drain to the same place.

use bevy_math::Vec3;

use crate::film::{FilmMesh, VertexId, words::Words};

/// Length of the cracks that drain to each place. A torn edge leads rust from its upper to its lower end; where several
/// torn edges lead to the same place, their lengths add up.
///
/// A forest of original vertices, each pointing to the vertex that it drains to.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Catchments {
    /// Original vertex that each original vertex drains to; itself if it drains no further.
    pub(super) drains: Vec<u32>,
    /// Length in metres of the cracks that drain to each original vertex that drains no further.
    pub(super) lengths: Vec<f32>,
}

impl Catchments {
    /// Creates the catchments of an uncracked film of `vertices` vertices.
    pub fn new(vertices: usize) -> Self {
        Self { drains: (0..vertices as u32).collect(), lengths: vec![0.0; vertices] }
    }

    /// Forgets all cracks.
    pub fn clear(&mut self) {
        self.drains.iter_mut().zip(0..).for_each(|(drain, own)| *drain = own);
        self.lengths.fill(0.0);
    }

    /// Adds a torn edge of `length` metres between two original vertices, of which the one that lies further along
    /// `gravity` is the lower; none if they lie equally deep.
    pub fn drain(&mut self, mesh: &FilmMesh, ends: [VertexId; 2], gravity: Vec3, length: f32) {
        let [a, b] = ends.map(|v| mesh.geometry.rest_positions[v.index()].dot(gravity));
        if a != b {
            let [upper, lower] = if a < b { ends } else { [ends[1], ends[0]] };
            self.connect(upper, lower, length);
        }
    }

    /// Adds a torn edge of `length` metres between two original vertices.
    pub fn connect(&mut self, upper: VertexId, lower: VertexId, length: f32) {
        let root = self.root(lower.index());
        if self.drains[upper.index()] as usize == upper.index() && root != upper.index() {
            self.drains[upper.index()] = root as u32;
            self.lengths[root] += std::mem::take(&mut self.lengths[upper.index()]);
        }
        self.lengths[root] += length;
    }

    /// Returns the vertex to which `v` drains in the end.
    fn root(&mut self, mut v: usize) -> usize {
        while self.drains[v] as usize != v {
            // Path halving, so that later searches are short.
            self.drains[v] = self.drains[self.drains[v] as usize];
            v = self.drains[v] as usize;
        }
        v
    }

    /// Appends where each place drains to, and the lengths.
    pub fn write_state(&self, to: &mut Words) {
        let Self { drains, lengths } = self;
        to.list(drains.iter().copied());
        to.floats(lengths);
    }

    /// Returns the length in metres of the cracks that drain to `original` and no further.
    pub fn length(&self, original: VertexId) -> f32 {
        self.lengths[original.index()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::words::assert_each_counts;

    #[test]
    fn every_field_of_catchments_counts() {
        let changes: [fn(&mut Catchments); 2] = [|places| places.drains[0] = 1, |places| places.lengths[0] = 1.0];
        assert_each_counts(&Catchments::new(2), Catchments::write_state, &changes);
    }
}
