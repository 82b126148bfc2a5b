//! Looks for narrow necks of the film, and for flaps that hang on them.

use super::forces::{FilmForces, Neck};
use crate::film::{FaceId, FilmMesh, Grain, HalfEdgeId, Topology, VertexId};

/// Area of the smallest flap that a neck gives way to, in squares of the neck's width. What is smaller is no flap but a
/// corner of the film, which a line across always cuts off.
const LEAST_FLAP: f32 = 4.0;
/// Area of the largest flap that is looked for, in faces whose edges are one grain long.
const LARGEST_FLAP: f32 = 60.0;
/// Largest number of vertices that are searched for the other side of a neck: as many as lie within a grain on a film
/// with edges of a fifth of the grain. On finer films necks must be narrower to tear.
const MOST_VERTICES: usize = 100;

/// Buffers of the search for necks.
#[derive(Clone, Debug, Default)]
pub(super) struct NeckScratch {
    /// Vertices at which necks are looked for.
    pub starts: Vec<VertexId>,
    /// Pass in which each vertex became a start.
    started: Vec<u32>,
    pass: u32,
    /// Vertices within the width of a neck, and the search in which each vertex was reached last, with its index here.
    nodes: Vec<Node>,
    reached: Vec<(u32, u32)>,
    search: u32,
    /// Half-edges across the neck, from its far end to its near one.
    pub path: Vec<HalfEdgeId>,
    sides: [Side; 2],
    /// Mark of the last search of a side that reached each face.
    marks: Vec<u32>,
    mark: u32,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    v: VertexId,
    distance: f32,
    /// Half-edge by which it was reached, from the node with the index `from`.
    by: HalfEdgeId,
    from: u32,
    done: bool,
}

/// Faces on one side of a neck, as far as they were searched.
#[derive(Clone, Debug, Default)]
struct Side {
    faces: Vec<FaceId>,
    next: usize,
    area: f32,
    held_by: Option<VertexId>,
    too_large: bool,
}

/// Finding of the search on both sides of a possible neck.
enum Verdict {
    /// A flap hangs on it.
    Flap,
    /// Both sides are held.
    Held([VertexId; 2]),
    /// It is no neck: a line across a corner, round a hole, or between two large parts.
    None,
}

impl NeckScratch {
    pub fn begin_pass(&mut self, vertices: usize) {
        if self.pass == u32::MAX {
            self.started.clear();
            self.pass = 0;
        }
        self.pass += 1;
        self.started.resize(vertices, 0);
        self.starts.clear();
    }

    pub fn is_start(&self, v: VertexId) -> bool {
        self.started[v.index()] == self.pass
    }

    pub fn start_at(&mut self, v: VertexId) {
        if !self.is_start(v) {
            self.started[v.index()] = self.pass;
            self.starts.push(v);
        }
    }

    /// Looks for necks that end at the start with the index `start`. Returns whether a flap hangs on one; `path` then
    /// leads across it. Notes those before it that are held.
    pub fn find(&mut self, mesh: &FilmMesh, forces: &mut FilmForces, grain: Grain, width: f32, start: usize) -> bool {
        let topology = &mesh.topology;
        let at = self.starts[start];
        let is_held = |f: FaceId| forces.predictions.pieces.attached_of(f) > 0;
        let is_edge_of_film = !topology.is_closed_fan(at) && !forces.is_attached(at);
        if !is_edge_of_film || !topology.fan(at).next().is_some_and(|h| is_held(h.face())) {
            return false;
        }
        self.begin_search(topology.vertex_count(), at);
        while let Some(i) = self.nearest() {
            self.nodes[i].done = true;
            let Node { v, distance, .. } = self.nodes[i];
            if i == 0 || topology.is_closed_fan(v) {
                self.reach_beside(mesh, forces, i, width);
                continue;
            }
            self.lead_to(i);
            match self.judge(mesh, forces, grain, distance) {
                Verdict::Flap => return true,
                Verdict::Held(held_by) => forces.necks.push(Neck { at, held_by }),
                Verdict::None => {}
            }
        }
        false
    }

    fn begin_search(&mut self, vertices: usize, at: VertexId) {
        if self.search == u32::MAX {
            self.reached.clear();
            self.search = 0;
        }
        self.search += 1;
        self.reached.resize(vertices, (0, 0));
        self.nodes.clear();
        self.reached[at.index()] = (self.search, 0);
        self.nodes.push(Node { v: at, distance: 0.0, by: HalfEdgeId::NONE, from: 0, done: false });
    }

    /// Returns the nearest node from which the search has not gone on yet.
    fn nearest(&self) -> Option<usize> {
        let open = self.nodes.iter().enumerate().filter(|(_, node)| !node.done);
        open.min_by(|(_, a), (_, b)| a.distance.total_cmp(&b.distance)).map(|(i, _)| i)
    }

    /// Reaches the neighbours of the node with the index `from` over bound edges that may tear.
    fn reach_beside(&mut self, mesh: &FilmMesh, forces: &FilmForces, from: usize, width: f32) {
        let topology = &mesh.topology;
        let Node { v, distance, .. } = self.nodes[from];
        for by in topology.fan(v).filter(|&h| topology.bound_twin(h).is_some()) {
            let to = topology.target(by);
            let distance = distance + mesh.geometry.rest_lengths[by.index()];
            let may_tear = || forces.bindings[topology.edge(by).index()].may_tear();
            if distance > width || forces.is_attached(to) || !may_tear() {
                continue;
            }
            let node = Node { v: to, distance, by, from: from as u32, done: false };
            let (search, known) = self.reached[to.index()];
            if search != self.search {
                if self.nodes.len() < MOST_VERTICES {
                    self.reached[to.index()] = (self.search, self.nodes.len() as u32);
                    self.nodes.push(node);
                }
            } else if distance < self.nodes[known as usize].distance {
                self.nodes[known as usize] = node;
            }
        }
    }

    /// Makes `path` lead from the node with the index `end` to the start.
    fn lead_to(&mut self, end: usize) {
        self.path.clear();
        let mut node = self.nodes[end];
        while let Some(by) = node.by.get() {
            self.path.push(by);
            node = self.nodes[node.from as usize];
        }
    }

    /// Searches both sides of `path`, which is `width` long, one face in turn, until it is known what it cuts off.
    fn judge(&mut self, mesh: &FilmMesh, forces: &FilmForces, grain: Grain, width: f32) -> Verdict {
        let topology = &mesh.topology;
        self.begin_sides(topology);
        let Self { sides, path, marks, mark, .. } = self;
        let is_cut = |h: HalfEdgeId, twin: HalfEdgeId| path.iter().any(|&p| p == h || p == twin);
        loop {
            for (side, searched) in sides.iter_mut().enumerate() {
                let Side { faces, next, area, held_by, too_large } = searched;
                if held_by.is_some() || *too_large {
                    continue;
                }
                let Some(&f) = faces.get(*next) else {
                    return if *area >= LEAST_FLAP * width * width { Verdict::Flap } else { Verdict::None };
                };
                *next += 1;
                *area += mesh.geometry.rest_area_of(topology, f);
                *too_large = *area > LARGEST_FLAP * grain.face_area();
                *held_by = topology.corners(f).into_iter().find(|&v| forces.is_attached(v));
                for h in f.half_edges() {
                    let Some(twin) = topology.bound_twin(h).filter(|&twin| !is_cut(h, twin)) else { continue };
                    let reached = &mut marks[twin.face().index()];
                    if *reached == *mark + 1 - side as u32 {
                        return Verdict::None;
                    }
                    if *reached != *mark + side as u32 {
                        *reached = *mark + side as u32;
                        faces.push(twin.face());
                    }
                }
            }
            let [a, b] = [&sides[0], &sides[1]];
            match (a.held_by, b.held_by) {
                (Some(a), Some(b)) => return Verdict::Held([a, b]),
                (Some(v), None) if b.too_large => return Verdict::Held([v, v]),
                (None, Some(v)) if a.too_large => return Verdict::Held([v, v]),
                (None, None) if a.too_large && b.too_large => return Verdict::None,
                _ => {}
            }
        }
    }

    /// Begins a search of both sides with the faces at `path`.
    fn begin_sides(&mut self, topology: &Topology) {
        if self.marks.len() != topology.face_count() || self.mark > u32::MAX - 4 {
            self.marks.clear();
            self.marks.resize(topology.face_count(), 0);
            self.mark = 0;
        }
        self.mark += 2;
        for (i, side) in self.sides.iter_mut().enumerate() {
            *side = Side { faces: std::mem::take(&mut side.faces), ..Side::default() };
            side.faces.clear();
            let mark = self.mark + i as u32;
            for &p in &self.path {
                let half_edge = if i == 0 { Some(p) } else { topology.bound_twin(p) };
                if let Some(f) = half_edge.map(HalfEdgeId::face).filter(|f| self.marks[f.index()] != mark) {
                    self.marks[f.index()] = mark;
                    side.faces.push(f);
                }
            }
        }
    }
}

#[cfg(test)]
impl NeckScratch {
    /// Counts the vertices at which a flap hangs on a neck of at most `width`.
    pub fn count(&mut self, mesh: &FilmMesh, forces: &mut FilmForces, width: f32) -> usize {
        let grain = forces.grain().unwrap();
        self.begin_pass(mesh.topology.vertex_count());
        for v in mesh.topology.all_vertices().filter(|&v| mesh.topology.has_faces(v)) {
            self.start_at(v);
        }
        let necks = forces.necks.clone();
        let count = (0..self.starts.len()).filter(|&i| self.find(mesh, forces, grain, width, i)).count();
        forces.necks = necks;
        count
    }
}
