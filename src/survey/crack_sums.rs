//! Adds up cracks: how many there are, how long, and how wide they gape.

use bevy_math::Vec3;

use super::{covers, ratings::size::size_class, view::FilmView};
use crate::film::{HalfEdgeId, VertexId};

/// Widths in metres up to which a crack belongs to the size classes 0 to 4 of ISO 4628-4; wider ones are class 5. The
/// standard says "visible only under magnification", "just visible", "clearly visible", and for the last two "up to
/// 1 mm" and "more than 1 mm"; an eye sees 0.1 mm, and 0.01 mm under tenfold magnification.
pub(super) const CRACK_WIDTHS: [f64; 5] = [0.01e-3, 0.1e-3, 0.2e-3, 0.5e-3, 1e-3];

/// Cracks of a film, with the buffers of counting them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct CrackSums {
    /// Torn edges between two faces that are both still there, one half-edge for each.
    edges: Vec<HalfEdgeId>,
    /// For each original vertex another one of the same crack; itself for the last.
    linked: Vec<u32>,
    /// Number of cracks: torn edges that hang together.
    pub count: u32,
    /// Length of the cracks in each size class, in metres.
    pub lengths: [f64; 6],
    /// Area of rusted metal that is seen in cracks, in square metres.
    pub rusted: f64,
}

impl CrackSums {
    /// Finds the cracks of a film. Edges at removed faces are no cracks any more, but outlines of bare metal.
    pub fn find(&mut self, view: FilmView) {
        let topology = &view.mesh.topology;
        let torn = topology.torn().iter().enumerate().filter(|(_, torn)| **torn);
        let is_there = |h: HalfEdgeId| topology.is_live(h.face()) && !view.is_hidden(h.face());
        let between =
            |&h: &HalfEdgeId| topology.rest_twin(h).is_some_and(|twin| h < twin && is_there(h) && is_there(twin));
        self.edges.clear();
        self.edges.extend(torn.map(|(h, _)| HalfEdgeId::new(h)).filter(between));
        self.linked.clear();
        self.linked.extend(0..topology.original_vertex_count() as u32);
        self.count = 0;
        let (mut ends, mut links) = (0, 0);
        for i in 0..self.edges.len() {
            let h = self.edges[i];
            let [a, b] = [topology.origin(h), topology.target(h)].map(|v| topology.original(v));
            ends += u32::from(self.is_new(a));
            ends += u32::from(self.is_new(b));
            links += u32::from(self.link(a, b));
        }
        // Every link makes one crack of two.
        self.count = ends - links;
    }

    /// Returns whether no crack has come to a vertex so far, and notes that one has.
    fn is_new(&mut self, v: VertexId) -> bool {
        let linked = &mut self.linked[v.index()];
        let known = *linked & KNOWN != 0;
        *linked |= KNOWN;
        !known
    }

    /// Makes one crack of those at two vertices. Returns whether they were two.
    fn link(&mut self, a: VertexId, b: VertexId) -> bool {
        let (a, b) = (self.last(a.0), self.last(b.0));
        self.linked[a as usize] = b | KNOWN;
        a != b
    }

    /// Returns the last vertex of the crack at `v`.
    fn last(&mut self, mut v: u32) -> u32 {
        loop {
            let next = self.linked[v as usize] & !KNOWN;
            if next == v {
                return v;
            }
            // Path halving, so that later searches are short.
            let after = self.linked[next as usize] & !KNOWN;
            self.linked[v as usize] = after | KNOWN;
            v = after;
        }
    }

    /// Measures how wide the cracks gape now, and the rust that is seen in them.
    pub fn measure(&mut self, view: FilmView) {
        (self.lengths, self.rusted) = ([0.0; 6], 0.0);
        let (topology, geometry) = (&view.mesh.topology, &view.mesh.geometry);
        for &h in &self.edges {
            let Some(twin) = topology.rest_twin(h) else { continue };
            let ends = [(topology.origin(h), topology.target(twin)), (topology.target(h), topology.origin(twin))];
            let width = ends.map(|(one, other)| gap(view, one, other)).iter().sum::<f32>() / 2.0;
            let length = f64::from(geometry.rest_lengths[h.index()]);
            if let Some(sum) = self.lengths.get_mut(size_class(f64::from(width), &CRACK_WIDTHS) as usize) {
                *sum += length;
            }
            // Where the sides of a crack are far apart, other film lies between them.
            let seen = f64::from(width.min(geometry.mean_edge));
            let corrosion =
                ends.map(|(v, _)| view.stains.corrosion.get(topology.original(v).index()).copied().unwrap_or_default());
            self.rusted += length * seen * f64::from(covers::rusted((corrosion[0] + corrosion[1]) / 2.0));
        }
    }
}

/// Mark of the vertices to which a crack has come. Films have far fewer vertices.
const KNOWN: u32 = 1 << 31;

/// Returns how far apart two film vertices of one place are, along the metal.
fn gap(view: FilmView, one: VertexId, other: VertexId) -> f32 {
    let geometry = &view.mesh.geometry;
    let apart = geometry.positions[one.index()] - geometry.positions[other.index()];
    let normal: Vec3 = geometry.rest_normals[one.index()];
    (apart - normal * apart.dot(normal)).length()
}
