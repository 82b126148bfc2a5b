//! How far each edge may curl: film curls at its free edges, and lies flat where it is held all around.
//!
//! A target angle stands for a curvature, so it is narrowed in proportion to the distance of the two faces' centroids.
//! And it is narrowed the less the farther the edge is from a free edge, as every edge of film that is held all around
//! wants to fold and none can. The distance runs over connected film; it changes only where something tore.

use std::collections::VecDeque;

use bevy_math::{Vec3, ops};

use crate::film::{FilmMesh, Grain, HalfEdgeId, Topology, VertexId, words::Words};

/// Distance of the centroids of two regular faces, in edges: the unit of curvature.
const REGULAR: f32 = 0.577_350_26;

/// Distance in lengths of the reach beyond which nothing curls: the share is below 0.002 there.
const FAR: f32 = 2.5;

/// Largest share of an edge, whatever the distance of its faces: coarse films do not fold.
const LARGEST: f32 = 3.0;

/// Distances from the free edges of a film that is measured by its grain.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CurlField {
    pub grain: Grain,
    /// Distance over which curls fade, in units of the film's space.
    pub reach: f32,
    /// Distance of each vertex from the nearest free edge; infinite where that is far.
    distances: Vec<f32>,
    /// Point of that free edge.
    nearest: Vec<Vec3>,
    /// Vertices whose distance has changed, in the order in which they are looked at.
    queue: VecDeque<VertexId>,
    /// Vertices whose distance has changed in this step, some of them twice.
    pub changed: Vec<VertexId>,
}

impl CurlField {
    pub fn new(grain: Grain, reach: f32) -> Box<Self> {
        let (distances, nearest, queue, changed) = Default::default();
        Box::new(Self { grain, reach: reach * grain.length, distances, nearest, queue, changed })
    }

    /// Makes room for the vertices that were added: each is at a free edge.
    pub fn follow(&mut self, topology: &Topology) {
        self.distances.resize(topology.vertex_count(), f32::INFINITY);
        self.nearest.resize(topology.vertex_count(), Vec3::ZERO);
    }

    /// Notes that `v` lies at a free edge.
    pub fn seed(&mut self, mesh: &FilmMesh, v: VertexId) {
        if self.distances[v.index()] > 0.0 && mesh.topology.has_faces(v) {
            self.distances[v.index()] = 0.0;
            self.nearest[v.index()] = mesh.geometry.rest_positions[v.index()];
            self.queue.push_back(v);
            self.changed.push(v);
        }
    }

    /// Notes that the ends of the torn edge of `h`, on both of its sides, lie at a free edge.
    pub fn seed_torn(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        let topology = &mesh.topology;
        for side in [Some(h), topology.rest_twin(h)].into_iter().flatten() {
            self.seed(mesh, topology.origin(side));
            self.seed(mesh, topology.target(side));
        }
    }

    /// Notes the border edges at `v`, which has separated, whose other end has separated too.
    pub fn seed_border(&mut self, mesh: &FilmMesh, v: VertexId, is_free: impl Fn(VertexId) -> bool) {
        let topology = &mesh.topology;
        for h in topology.fan(v).flat_map(|h| [h, h.previous()]) {
            let ends = [topology.origin(h), topology.target(h)];
            if topology.rest_twin(h).is_none() && ends.into_iter().all(&is_free) {
                ends.into_iter().for_each(|end| self.seed(mesh, end));
            }
        }
    }

    /// Carries distances on over connected film.
    pub fn spread(&mut self, mesh: &FilmMesh) {
        let far = FAR * self.reach;
        while let Some(v) = self.queue.pop_front() {
            let from = self.nearest[v.index()];
            for h in mesh.topology.fan(v) {
                for n in [mesh.topology.target(h), mesh.topology.apex(h)] {
                    let distance = (mesh.geometry.rest_positions[n.index()] - from).length_squared().sqrt();
                    if distance < far && distance < self.distances[n.index()] {
                        self.distances[n.index()] = distance;
                        self.nearest[n.index()] = from;
                        self.queue.push_back(n);
                        self.changed.push(n);
                    }
                }
            }
        }
    }

    /// Returns by which share of what the settings say the target of the bend at `h` narrows.
    pub fn share(&self, mesh: &FilmMesh, h: HalfEdgeId) -> f32 {
        let topology = &mesh.topology;
        let Some(twin) = topology.rest_twin(h) else { return 0.0 };
        let apart =
            mesh.geometry.rest_centroid(topology, h.face()) - mesh.geometry.rest_centroid(topology, twin.face());
        let bend = apart.length_squared().sqrt() / (REGULAR * self.grain.length);
        let ends = [topology.origin(h), topology.target(h)].map(|v| self.distances[v.index()]);
        let x = (ends[0] + ends[1]) * 0.5 / self.reach;
        if bend < LARGEST { bend * ops::exp(-x * x) } else { LARGEST * ops::exp(-x * x) }
    }

    /// Appends all that decides later distances.
    pub fn write_state(&self, to: &mut Words) {
        let Self { grain, reach, distances, nearest, queue: _, changed: _ } = self;
        to.float(grain.length);
        to.float(*reach);
        to.floats(distances);
        to.vectors(nearest);
    }
}
