//! Finds the lines of the surface along which edges of the film run: creases, borders and seams.
//!
//! A film does not say which creases it follows. But the ends of an edge that follows one lie on it, and no other
//! vertex of the film lies between them.

use std::{cmp::Reverse, collections::BinaryHeap, ops::Range};

use bevy_math::Vec3;

use super::{corners::Corners, ground::FineGround};
use crate::{
    film::{HalfEdgeId, VertexId},
    remesh::project::{Foot, Ground},
    rest::{PIECE, Rest, pieces},
};

/// Weight of a corner up to which a point lies on the opposite side. Only weights at former T-junctions are rounded.
const ON_LINE: f32 = 1e-6;
/// Longest line along which an edge runs, over its length: a little more than a half circle.
const LONGEST: f32 = 1.6;
const NONE: u32 = u32::MAX;

/// Part of an edge of the surface, passed from `from` to `to`.
#[derive(Clone, Copy)]
struct Part {
    /// The lower half-edge of the edge. `from` and `to` are shares of its length.
    edge: HalfEdgeId,
    from: f32,
    to: f32,
}

/// Lines along which edges of the film run.
#[derive(Default)]
pub struct Lines {
    parts: Vec<Part>,
    /// Length of the line up to the end of each part.
    lengths: Vec<f32>,
    /// Parts of each half-edge of the film that leads its edge; none if it follows no line.
    ranges: Vec<Range<usize>>,
    /// Whether each vertex of the film lies on a line.
    is_on_line: Vec<bool>,
}

/// Point on a line, as a point of the triangle on the left and of that on the right.
pub struct LinePoint {
    pub left: Option<Foot>,
    pub right: Option<Foot>,
}

impl Lines {
    pub async fn new(ground: &FineGround, corners: &Corners<'_>, rest: &mut impl Rest) -> Self {
        let mut tracer = Tracer::new(ground, corners);
        rest.rest().await;
        let mut lines = Self { ranges: vec![0..0; corners.half_edges().count()], ..Self::default() };
        lines.is_on_line = tracer.places.iter().map(Option::is_some).collect();
        for piece in pieces(corners.vertex_count(), PIECE) {
            piece.map(VertexId::new).for_each(|v| tracer.trace(v, &mut lines));
            rest.rest().await;
        }
        lines
    }

    /// Returns whether the edge of a leading half-edge runs along a line.
    pub fn is_followed(&self, h: HalfEdgeId) -> bool {
        !self.ranges[h.index()].is_empty()
    }

    /// Returns whether both ends of the edge lie on lines.
    pub fn touches(&self, corners: &Corners, h: HalfEdgeId) -> bool {
        [h, h.next()].iter().all(|&h| self.is_on_line.get(corners.vertex(h).index()).copied().unwrap_or_default())
    }

    /// Makes walls of all lines.
    pub fn raise_walls(&self, ground: &mut FineGround) {
        for part in &self.parts {
            for h in [Some(part.edge), ground.topology().twin(part.edge)].into_iter().flatten() {
                ground.raise_wall(h);
            }
        }
    }

    /// Returns the point at a share of the line along which a leading half-edge runs.
    pub fn point(&self, ground: &FineGround, h: HalfEdgeId, share: f32) -> Option<LinePoint> {
        let range = self.ranges[h.index()].clone();
        let lengths = &self.lengths[range.clone()];
        let wanted = share * lengths.last()?;
        let i = lengths.partition_point(|&length| length < wanted).min(lengths.len() - 1);
        let part = self.parts[range.start + i];
        let (end, start) = (lengths[i], if i == 0 { 0.0 } else { lengths[i - 1] });
        let within = if end > start { ((wanted - start) / (end - start)).clamp(0.0, 1.0) } else { 0.0 };
        let at = part.from + (part.to - part.from) * within;
        let [a, b] = ground.ends(part.edge);
        let position = a.lerp(b, at);
        let near = Some(foot(part.edge, at, position));
        let far = ground.topology().twin(part.edge).map(|t| foot(t, 1.0 - at, position));
        let (left, right) = if part.from < part.to { (near, far) } else { (far, near) };
        Some(LinePoint { left, right })
    }
}

/// Returns the point at a share of a half-edge.
fn foot(h: HalfEdgeId, share: f32, position: Vec3) -> Foot {
    let k = h.index() % 3;
    let mut weights = [0.0; 3];
    weights[k] = 1.0 - share;
    weights[(k + 1) % 3] = share;
    Foot { triangle: h.face(), position, weights: Vec3::from_array(weights) }
}

/// Place of a vertex of the film on a line.
#[derive(Clone, Copy)]
enum Place {
    Vertex(VertexId),
    Edge(HalfEdgeId, f32),
}

/// End of a part: a vertex of the film, or of the surface where there is none of the film.
#[derive(Clone, Copy)]
enum Stop {
    Film(VertexId),
    Surface(VertexId),
}

/// Part that was reached, and the one before it.
struct Step {
    part: Part,
    stop: Stop,
    previous: usize,
    length: f32,
}

struct Tracer<'a> {
    ground: &'a FineGround,
    corners: &'a Corners<'a>,
    /// Place of each vertex of the film that lies on a line.
    places: Vec<Option<Place>>,
    /// Vertex of the film at each vertex of the surface.
    at_vertex: Vec<u32>,
    /// Edge, share of its length, and vertex of the film there, sorted.
    at_edge: Vec<(HalfEdgeId, f32, VertexId)>,
    /// Leading half-edges with their first and second vertex, sorted.
    edges: Vec<(VertexId, VertexId, HalfEdgeId)>,
    /// Vertex of the film from which each vertex of the surface was last reached.
    reached: Vec<u32>,
    steps: Vec<Step>,
    /// Steps by length. The bits of numbers that are not negative are in the order of the numbers.
    open: BinaryHeap<Reverse<(u32, usize)>>,
}

impl<'a> Tracer<'a> {
    fn new(ground: &'a FineGround, corners: &'a Corners<'a>) -> Self {
        let vertices = ground.topology().vertex_slots();
        let mut tracer = Self {
            ground,
            corners,
            places: vec![None; corners.vertex_count()],
            at_vertex: vec![NONE; vertices],
            at_edge: Vec::new(),
            edges: Vec::new(),
            reached: vec![NONE; vertices],
            steps: Vec::new(),
            open: BinaryHeap::new(),
        };
        for h in corners.half_edges() {
            let v = corners.vertex(h);
            if corners.leads(h) && corners.is_known(h.face()) {
                tracer.edges.push((v, corners.vertex(h.next()), h));
            }
            if tracer.places.get(v.index()).is_some_and(Option::is_none) {
                tracer.places[v.index()] = corners.foot(h).and_then(|foot| tracer.place(&foot));
            }
        }
        tracer.edges.sort_unstable();
        for (v, place) in tracer.places.iter().enumerate() {
            match *place {
                Some(Place::Vertex(at)) => tracer.at_vertex[at.index()] = v as u32,
                Some(Place::Edge(edge, share)) => tracer.at_edge.push((edge, share, VertexId::new(v))),
                None => {}
            }
        }
        tracer.at_edge.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        tracer
    }

    fn place(&self, foot: &Foot) -> Option<Place> {
        let half_edges = foot.triangle.half_edges();
        let is_zero = foot.weights.to_array().map(|w| w <= ON_LINE);
        let topology = self.ground.topology();
        if let Some(k) = (0..3).find(|&k| is_zero[(k + 1) % 3] && is_zero[(k + 2) % 3]) {
            let v = topology.origin(half_edges[k]);
            return topology.spokes(v).any(|(h, _)| self.ground.is_line(h)).then_some(Place::Vertex(v));
        }
        let k = (0..3).find(|&k| is_zero[(k + 2) % 3])?;
        let h = half_edges[k];
        let share = foot.weights[(k + 1) % 3].clamp(0.0, 1.0);
        let edge = self.lower(h);
        self.ground.is_line(h).then_some(Place::Edge(edge, if edge == h { share } else { 1.0 - share }))
    }

    fn lower(&self, h: HalfEdgeId) -> HalfEdgeId {
        self.ground.topology().twin(h).map_or(h, |t| t.min(h))
    }

    /// Traces the lines from a vertex of the film to all next ones, the shortest way first.
    fn trace(&mut self, v: VertexId, lines: &mut Lines) {
        let Some(place) = self.places[v.index()] else { return };
        let first = self.edges.partition_point(|edge| edge.0 < v);
        let outgoing: Vec<_> = self.edges[first..].iter().take_while(|edge| edge.0 == v).copied().collect();
        let reach = outgoing.iter().fold(0.0, |reach: f32, edge| reach.max(LONGEST * self.corners.length(edge.2)));
        if reach <= 0.0 {
            return;
        }
        self.steps.clear();
        self.open.clear();
        match place {
            Place::Vertex(at) => self.branch(v, at, usize::MAX, reach),
            Place::Edge(edge, share) => {
                for ahead in [true, false] {
                    self.advance(edge, share, ahead, usize::MAX, reach);
                }
            }
        }
        while let Some(Reverse((_, i))) = self.open.pop() {
            match self.steps[i].stop {
                Stop::Surface(at) => self.branch(v, at, i, reach),
                Stop::Film(end) => {
                    for &(_, _, h) in outgoing.iter().filter(|edge| edge.1 == end) {
                        self.follow(h, i, lines);
                    }
                }
            }
        }
    }

    /// Goes on from a vertex of the surface along all lines that meet there, once for each vertex of the film.
    fn branch(&mut self, v: VertexId, at: VertexId, previous: usize, reach: f32) {
        if std::mem::replace(&mut self.reached[at.index()], v.0) == v.0 {
            return;
        }
        let ground = self.ground;
        for (h, _) in ground.topology().spokes(at).filter(|&(h, _)| ground.is_line(h)) {
            let edge = self.lower(h);
            let ahead = ground.topology().origin(edge) == at;
            self.advance(edge, if ahead { 0.0 } else { 1.0 }, ahead, previous, reach);
        }
    }

    /// Goes on along an edge to the next vertex.
    fn advance(&mut self, edge: HalfEdgeId, from: f32, ahead: bool, previous: usize, reach: f32) {
        let topology = self.ground.topology();
        let begin = self.at_edge.partition_point(|x| x.0 < edge);
        let mut same = self.at_edge[begin..].iter().take_while(|x| x.0 == edge);
        let next = if ahead { same.find(|x| x.1 > from) } else { same.filter(|x| x.1 < from).last() };
        let (stop, to) = match next {
            Some(&(_, share, v)) => (Stop::Film(v), share),
            None => {
                let (end, to) = if ahead { (topology.target(edge), 1.0) } else { (topology.origin(edge), 0.0) };
                let film = VertexId(self.at_vertex[end.index()]).get();
                (film.map_or(Stop::Surface(end), Stop::Film), to)
            }
        };
        let [a, b] = self.ground.ends(edge);
        let before = self.steps.get(previous).map_or(0.0, |step| step.length);
        let length = before + a.distance(b) * (to - from).abs();
        if length <= reach {
            self.open.push(Reverse((length.to_bits(), self.steps.len())));
            self.steps.push(Step { part: Part { edge, from, to }, stop, previous, length });
        }
    }

    /// Makes the half-edge follow the line that ends with step `last`, unless it already follows a shorter one, or the
    /// line has no surface on a side on which the film has a face.
    fn follow(&self, h: HalfEdgeId, last: usize, lines: &mut Lines) {
        if lines.is_followed(h) || self.steps[last].length > LONGEST * self.corners.length(h) {
            return;
        }
        let start = lines.parts.len();
        let mut at = last;
        while let Some(step) = self.steps.get(at) {
            lines.parts.push(step.part);
            at = step.previous;
        }
        lines.parts[start..].reverse();
        let topology = self.ground.topology();
        let fits = lines.parts[start..].iter().all(|part| {
            let has_far = topology.twin(part.edge).is_some();
            let is_ahead = part.from < part.to;
            has_far || is_ahead && self.corners.twin(h).is_none()
        });
        if !fits {
            lines.parts.truncate(start);
            return;
        }
        let mut length = 0.0;
        for part in &lines.parts[start..] {
            let [a, b] = self.ground.ends(part.edge);
            length += a.distance(b) * (part.to - part.from).abs();
            lines.lengths.push(length);
        }
        lines.ranges[h.index()] = start..lines.parts.len();
    }
}
