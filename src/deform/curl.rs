//! How far each edge may curl: film curls at its free edges, and lies flat where it is held all around.
//!
//! A target angle stands for a curvature, so it is narrowed in proportion to the distance of the two faces' centroids.
//! And it is narrowed the less the farther the edge is from a free edge, as every edge of film that is held all around
//! wants to fold and none can. The distance runs over connected film; it changes only where something tore.

mod saved;

use std::collections::VecDeque;

use bevy_math::{Vec3, ops};

use crate::film::{FilmMesh, Grain, HalfEdgeId, Mend, Topology, VertexId, words::Words};

/// Distance of the centroids of two regular faces, in edges: the unit of curvature.
const REGULAR: f32 = 0.577_350_26;

/// Distance in lengths of the reach beyond which nothing curls: the share is below 0.02 there.
const FAR: f32 = 2.0;

/// Part of the square of the mean edge by which the square of the reach is less. Coarse triangles give way more to
/// curls in two directions at once and would lift further: height that a tenth of the separated area of a plate exceeds
/// at age 1, at h = s, s/2, s/4 with a reach of 2 s throughout: 22.7, 14.1, 12.8 mm.
const SMEARED: f32 = 1.8;
/// Least share of the reach that is left.
const LEAST_REACH: f32 = 0.6;

/// Largest share of an edge, whatever the distance of its faces: coarse films do not fold.
const LARGEST: f32 = 3.0;

/// Distances from the free edges of a film that is measured by its grain.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CurlField {
    pub grain: Grain,
    /// Distance over which curls fade, in units of the film's space.
    pub reach: f32,
    /// Share of each edge that is free, by its lower half-edge: the distance of its faces' centroids over that of
    /// regular faces at the grain; 0 at the border.
    full: Vec<f32>,
    /// Distance of each vertex from the nearest free edge; infinite where that is far.
    distances: Vec<f32>,
    /// Point of that free edge.
    nearest: Vec<Vec3>,
    /// Vertices whose distance has changed, in the order in which they are looked at.
    queue: VecDeque<VertexId>,
    /// Vertices whose distance has changed in this step, some of them twice.
    pub changed: Vec<VertexId>,
    /// Step in which the share of each edge was last looked at, by its lower half-edge.
    looked_at: Vec<u32>,
    step: u32,
}

impl CurlField {
    /// Makes the field of a film without free edges. `reach` is in grains.
    pub fn new(mesh: &FilmMesh, grain: Grain, reach: f32) -> Box<Self> {
        let topology = &mesh.topology;
        let centroid = |h: HalfEdgeId| mesh.geometry.rest_centroid(topology, h.face());
        let mut full = vec![0.0; topology.half_edge_count()];
        for h in topology.all_edges() {
            let Some(twin) = topology.rest_twin(h) else { continue };
            let apart = (centroid(h) - centroid(twin)).length_squared().sqrt();
            let share = apart / (REGULAR * grain.length);
            full[h.index()] = if share < LARGEST { share } else { LARGEST };
        }
        let looked_at = vec![0; full.len()];
        let (distances, nearest, queue, changed) = Default::default();
        let reach = reach_on(mesh, grain, reach);
        Box::new(Self { grain, reach, full, distances, nearest, queue, changed, looked_at, step: 0 })
    }

    /// Returns whether this is the field of a film with that grain and that reach, in grains.
    pub fn is_of(&self, mesh: &FilmMesh, grain: Grain, reach: f32) -> bool {
        (self.grain, self.reach) == (grain, reach_on(mesh, grain, reach))
    }

    /// Begins a step.
    pub fn begin(&mut self, topology: &Topology) {
        self.follow(topology);
        self.changed.clear();
        self.step = self.step.checked_add(1).unwrap_or_else(|| {
            self.looked_at.fill(0);
            1
        });
    }

    /// Makes room for the vertices that were added: each is at a free edge.
    fn follow(&mut self, topology: &Topology) {
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

    /// Lets vertex `to` have what `from` had, whose faces it takes.
    pub fn take(&mut self, from: VertexId, to: VertexId) {
        self.distances[to.index()] = self.distances[from.index()];
        self.nearest[to.index()] = self.nearest[from.index()];
    }

    /// Forgets the free edges around the places of a mend, and every distance from them. What has another free edge
    /// beside it carries that on next. All vertices at the places count as changed.
    pub fn forget_around(&mut self, mesh: &FilmMesh, mend: &Mend) {
        let (topology, rest) = (&mesh.topology, &mesh.geometry.rest_positions);
        let bits = |p: Vec3| p.to_array().map(f32::to_bits);
        let mut points: Vec<[u32; 3]> = mend.originals.iter().map(|v| bits(rest[v.index()])).collect();
        points.sort_unstable();
        // Nearly all others lie outside the box around these.
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for v in &mend.originals {
            (low, high) = (low.min(rest[v.index()]), high.max(rest[v.index()]));
        }
        let is_in_box = |p: Vec3| p.cmpge(low).all() && p.cmple(high).all();
        let mut forgotten = Vec::new();
        for (i, (distance, nearest)) in self.distances.iter_mut().zip(&mut self.nearest).enumerate() {
            if *distance < f32::INFINITY && is_in_box(*nearest) && points.binary_search(&bits(*nearest)).is_ok() {
                (*distance, *nearest) = (f32::INFINITY, Vec3::ZERO);
                forgotten.push(VertexId::new(i));
            }
        }
        for &v in mend.here.iter().chain(&mend.left) {
            (self.distances[v.index()], self.nearest[v.index()]) = (f32::INFINITY, Vec3::ZERO);
            forgotten.push(v);
        }
        for &v in &forgotten {
            for n in topology.fan(v).flat_map(|h| [topology.target(h), topology.apex(h)]) {
                if self.distances[n.index()] < f32::INFINITY {
                    self.queue.push_back(n);
                }
            }
        }
        self.changed.append(&mut forgotten);
    }

    /// Carries distances on over connected film.
    pub fn spread(&mut self, mesh: &FilmMesh) {
        let far = FAR * self.reach;
        while let Some(v) = self.queue.pop_front() {
            let from = self.nearest[v.index()];
            for h in mesh.topology.fan(v) {
                self.reach_from(mesh, from, far, mesh.topology.target(h));
                // Where nothing follows in the fan, the last neighbour is no face's next corner.
                if mesh.topology.bound_twin(h.previous()).is_none() {
                    self.reach_from(mesh, from, far, mesh.topology.apex(h));
                }
            }
        }
    }

    /// Notes that `n` lies by a straight line from the point `from` of a free edge, if that is nearer than what it has.
    fn reach_from(&mut self, mesh: &FilmMesh, from: Vec3, far: f32, n: VertexId) {
        let distance = (mesh.geometry.rest_positions[n.index()] - from).length_squared().sqrt();
        if distance < far && distance < self.distances[n.index()] {
            self.distances[n.index()] = distance;
            self.nearest[n.index()] = from;
            self.queue.push_back(n);
            self.changed.push(n);
        }
    }

    /// Calls `act` with each edge at a vertex whose distance has changed in this step, once, and with the share of what
    /// the settings say by which its target narrows.
    pub fn for_changed(&mut self, topology: &Topology, mut act: impl FnMut(HalfEdgeId, f32)) {
        for &v in &self.changed {
            for h in topology.fan(v).flat_map(|h| [h, h.previous()]) {
                let edge = topology.edge(h);
                if std::mem::replace(&mut self.looked_at[edge.index()], self.step) != self.step {
                    act(edge, share_of(self.full[edge.index()], &self.distances, self.reach, topology, edge));
                }
            }
        }
    }

    /// Returns by which share of what the settings say the target at `edge` narrows.
    pub fn share(&self, topology: &Topology, edge: HalfEdgeId) -> f32 {
        share_of(self.full[edge.index()], &self.distances, self.reach, topology, edge)
    }

    /// Appends all that decides later distances.
    pub fn write_state(&self, to: &mut Words) {
        let Self { grain, reach, full: _, distances, nearest, queue: _, changed: _, looked_at: _, step: _ } = self;
        to.float(grain.length);
        to.float(*reach);
        to.floats(distances);
        to.vectors(nearest);
    }
}

/// Returns the share of `edge`: the whole of it at a free edge, less the farther from it.
fn share_of(full: f32, distances: &[f32], reach: f32, topology: &Topology, edge: HalfEdgeId) -> f32 {
    let x = (distances[topology.origin(edge).index()] + distances[topology.target(edge).index()]) * 0.5 / reach;
    if x < FAR { full * ops::exp(-x * x) } else { 0.0 }
}

/// Returns the reach on the film `mesh`, in units of its space, of a `reach` in grains.
fn reach_on(mesh: &FilmMesh, grain: Grain, reach: f32) -> f32 {
    let (reach, edge) = (reach * grain.length, mesh.geometry.mean_edge);
    let left = reach * reach - SMEARED * edge * edge;
    let least = LEAST_REACH * reach;
    if left > least * least { left.sqrt() } else { least }
}
