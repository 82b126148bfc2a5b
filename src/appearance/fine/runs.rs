//! Gives faces and edges their places in a part: runs of vertices and triangles that are theirs while they are shown.
//!
//! A face that goes leaves a hole that the next one that comes takes, so nothing else is numbered afresh. All runs of a
//! face are in one place, for they are looked up whenever it moves.

use std::ops::Range;

use super::layout::Layout;
use crate::appearance::part::MeshPart;
use crate::film::{FaceId, HalfEdgeId};

/// Entry of what is not shown.
const NONE: u32 = u32::MAX;

/// First vertices and indices of what belongs to one face.
#[derive(Clone, Copy, Debug)]
struct FaceRuns {
    /// First inner vertex of each of its half-edges that has its own.
    edges: [u32; 3],
    /// First vertex inside.
    inside: u32,
    /// First index of its triangles.
    index: u32,
}

/// Runs of all slots' parts.
#[derive(Clone, Debug, Default)]
pub(super) struct Runs {
    edge_points: usize,
    inner_points: usize,
    indices: usize,
    of: Vec<FaceRuns>,
    /// Holes in each slot's part: first vertices of edges.
    free_edges: Vec<Vec<u32>>,
    /// Holes in each slot's part: first vertices and indices of faces.
    free_faces: Vec<Vec<[u32; 2]>>,
}

impl Runs {
    /// Returns no runs, for faces with this layout.
    pub fn new(layout: &Layout) -> Self {
        Self {
            edge_points: layout.edge_points(),
            inner_points: layout.inner_points(),
            indices: 3 * layout.grid.triangles().len(),
            ..Self::default()
        }
    }

    /// Takes all runs away from `faces` faces in `slots` slots.
    pub fn clear(&mut self, faces: usize, slots: usize) {
        self.of.clear();
        self.of.resize(faces, FaceRuns { edges: [NONE; 3], inside: NONE, index: NONE });
        self.free_edges.clear();
        self.free_edges.resize(slots, Vec::new());
        self.free_faces.clear();
        self.free_faces.resize(slots, Vec::new());
    }

    /// Returns the inner vertices of the edge of `h`, counted along it, if it has its own.
    #[inline]
    pub fn edge(&self, h: HalfEdgeId) -> Option<Range<usize>> {
        let first = self.of[h.face().index()].edges[h.index() % 3];
        (first != NONE).then(|| first as usize..first as usize + self.edge_points)
    }

    /// Returns the vertices inside `f`, if it is shown.
    #[inline]
    pub fn inside(&self, f: FaceId) -> Option<Range<usize>> {
        let first = self.of[f.index()].inside;
        (first != NONE).then(|| first as usize..first as usize + self.inner_points)
    }

    /// Returns the indices of the triangles of `f`, if it is shown.
    #[inline]
    pub fn triangles(&self, f: FaceId) -> Option<Range<usize>> {
        let first = self.of[f.index()].index;
        (first != NONE).then(|| first as usize..first as usize + self.indices)
    }

    /// Returns whether `f` is shown.
    #[inline]
    pub fn has(&self, f: FaceId) -> bool {
        self.of[f.index()].index != NONE
    }

    /// Gives the edge of `h` vertices of its own in the part of slot `slot`, which grows if there is no hole.
    pub fn take_edge(&mut self, h: HalfEdgeId, slot: usize, part: &mut MeshPart) {
        let first = self.free_edges[slot].pop().unwrap_or_else(|| grow(part, self.edge_points));
        self.of[h.face().index()].edges[h.index() % 3] = first;
    }

    /// Takes its vertices away from the edge of `h`.
    pub fn release_edge(&mut self, h: HalfEdgeId, slot: usize) {
        let first = std::mem::replace(&mut self.of[h.face().index()].edges[h.index() % 3], NONE);
        self.free_edges[slot].extend((first != NONE).then_some(first));
    }

    /// Gives `f` vertices inside and triangles in the part of slot `slot`, which grows if there is no hole.
    pub fn take_face(&mut self, f: FaceId, slot: usize, part: &mut MeshPart) {
        let [inside, index] = self.free_faces[slot]
            .pop()
            .unwrap_or_else(|| [grow(part, self.inner_points), part.add_indices(self.indices) as u32]);
        let runs = &mut self.of[f.index()];
        (runs.inside, runs.index) = (inside, index);
    }

    /// Takes its vertices inside and its triangles away from `f`, and leaves triangles without area in the part of slot
    /// `slot`. Returns their indices, if it was shown.
    pub fn release_face(&mut self, f: FaceId, slot: usize, part: &mut MeshPart) -> Option<Range<usize>> {
        let range = self.triangles(f)?;
        let runs = &mut self.of[f.index()];
        self.free_faces[slot].push([runs.inside, runs.index]);
        (runs.inside, runs.index) = (NONE, NONE);
        let indices = &mut part.indices[range.clone()];
        indices.fill(indices.first().copied().unwrap_or_default());
        Some(range)
    }
}

/// Appends so many vertices to a part, and returns the first.
fn grow(part: &mut MeshPart, count: usize) -> u32 {
    let first = part.positions.len();
    part.grow_to(first + count);
    first as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn holes_are_taken_before_a_part_grows() {
        let layout = Layout::new(2);
        let (mut runs, mut part) = (Runs::new(&layout), MeshPart::default());
        runs.clear(3, 1);
        let [a, b, c] = [0, 1, 2].map(FaceId);
        let edge = HalfEdgeId(4);
        runs.take_face(a, 0, &mut part);
        runs.take_face(b, 0, &mut part);
        runs.take_edge(edge, 0, &mut part);
        assert_eq!((runs.inside(b), runs.triangles(b), runs.edge(edge)), (Some(3..6), Some(48..96), Some(6..9)));
        assert_eq!((part.positions.len(), part.indices.len()), (9, 96));
        assert_eq!(runs.release_face(a, 0, &mut part), Some(0..48));
        assert!(!runs.has(a) && runs.has(b) && runs.release_face(a, 0, &mut part).is_none());
        assert!(part.triangles().count() == 0, "nothing has been written");
        runs.release_edge(edge, 0);
        runs.take_face(c, 0, &mut part);
        runs.take_edge(HalfEdgeId(8), 0, &mut part);
        assert_eq!((runs.inside(c), runs.edge(HalfEdgeId(8)), runs.edge(edge)), (Some(0..3), Some(6..9), None));
        assert_eq!((part.positions.len(), part.indices.len()), (9, 96), "the holes served");
    }
}
