//! How far each edge may curl: film curls at its free edges, and lies flat where it is held all around.
//!
//! A target angle stands for a curvature, so it is narrowed in proportion to the distance of the two faces' centroids.
//! And it is narrowed the less the farther the edge is from a free edge, as every edge of film that is held all around
//! wants to fold and none can. The distance runs over connected film; it changes only where something tore.

use std::collections::VecDeque;

use bevy_math::{Vec3, ops};

use super::constraints::FilmConstraints;
use crate::{
    film::{FilmChanges, FilmMesh, Grain, HalfEdgeId, Topology, VertexId, words::Words},
    settings::CoatingSettings,
};

/// Distance of the centroids of two regular faces, in edges: the unit of curvature.
const REGULAR: f32 = 0.577_350_26;

/// Distance in lengths of the reach beyond which nothing curls: the share is below 0.002 there.
const FAR: f32 = 2.5;

/// Largest share of an edge, whatever the distance of its faces: coarse films do not fold.
const LARGEST: f32 = 3.0;

/// Distances from the free edges of a film that is measured by its grain.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CurlField {
    grain: Grain,
    /// Distance over which curls fade, in units of the film's space.
    reach: f32,
    /// Distance of each vertex from the nearest free edge; infinite where that is far.
    distances: Vec<f32>,
    /// Point of that free edge.
    nearest: Vec<Vec3>,
    /// Vertices whose distance has changed, in the order in which they are looked at.
    queue: VecDeque<VertexId>,
    /// Vertices whose distance has changed in this step, some of them twice.
    changed: Vec<VertexId>,
}

impl CurlField {
    fn new(grain: Grain, reach: f32) -> Box<Self> {
        let (distances, nearest, queue, changed) = Default::default();
        Box::new(Self { grain, reach: reach * grain.length, distances, nearest, queue, changed })
    }

    /// Makes room for the vertices that were added: each is at a free edge.
    fn follow(&mut self, topology: &Topology) {
        self.distances.resize(topology.vertex_count(), f32::INFINITY);
        self.nearest.resize(topology.vertex_count(), Vec3::ZERO);
    }

    /// Notes that `v` lies at a free edge.
    fn seed(&mut self, mesh: &FilmMesh, v: VertexId) {
        if self.distances[v.index()] > 0.0 && mesh.topology.has_faces(v) {
            self.distances[v.index()] = 0.0;
            self.nearest[v.index()] = mesh.geometry.rest_positions[v.index()];
            self.queue.push_back(v);
            self.changed.push(v);
        }
    }

    /// Notes that the ends of the torn edge of `h`, on both of its sides, lie at a free edge.
    fn seed_torn(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        let topology = &mesh.topology;
        for side in [Some(h), topology.rest_twin(h)].into_iter().flatten() {
            self.seed(mesh, topology.origin(side));
            self.seed(mesh, topology.target(side));
        }
    }

    /// Notes the border edges at `v`, which has separated, whose other end has separated too.
    fn seed_border(&mut self, mesh: &FilmMesh, v: VertexId, is_free: impl Fn(VertexId) -> bool) {
        let topology = &mesh.topology;
        for h in topology.fan(v).flat_map(|h| [h, h.previous()]) {
            let ends = [topology.origin(h), topology.target(h)];
            if topology.rest_twin(h).is_none() && ends.into_iter().all(&is_free) {
                ends.into_iter().for_each(|end| self.seed(mesh, end));
            }
        }
    }

    /// Carries distances on over connected film.
    fn spread(&mut self, mesh: &FilmMesh) {
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
    fn share(&self, mesh: &FilmMesh, h: HalfEdgeId) -> f32 {
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
    pub(super) fn write_state(&self, to: &mut Words) {
        let Self { grain, reach, distances, nearest, queue: _, changed: _ } = self;
        to.float(grain.length);
        to.float(*reach);
        to.floats(distances);
        to.vectors(nearest);
    }
}

/// Brings the targets of bends in step with the free edges after the fracture of this step, on a film that is measured
/// by its [grain](crate::settings::Rules::Grain); by the paper's rules every edge curls by what the settings say. Call it
/// after [`update_constraints`](super::update_constraints). Does nothing if nothing fractured.
///
/// The target of an edge narrows by [`bend_limit`](crate::settings::DeformSettings::bend_limit) times d / (0.577 s)
/// exp(-(x / r)^2): d is the distance of its faces' centroids and s the grain, so that a free strip bends to the same
/// curvature on every film; x is the distance from the nearest free edge over connected film (torn edges, edges of
/// removed faces, and the open border where it has separated), and r the
/// [`curl_reach`](crate::settings::DeformSettings::curl_reach).
///
/// ```
/// use bevy_coating::{
///     deform::{FilmConstraints, follow_free_edges, update_constraints},
///     film::{FilmChanges, FilmMesh},
///     settings::{CoatingSettings, Rules},
/// };
/// use bevy_math::Vec3;
///
/// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE], &[[0, 1, 2], [2, 1, 3]])?;
/// let mut constraints = FilmConstraints::new(&mesh);
/// let mut settings = CoatingSettings::default();
/// settings.scale.rules = Rules::Grain;
/// let mut changes = FilmChanges::default();
/// changes.separated.extend(mesh.topology.all_vertices());
///
/// update_constraints(&mesh, &mut constraints, &changes);
/// follow_free_edges(&mesh, &mut constraints, &settings, &changes);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn follow_free_edges(
    mesh: &FilmMesh,
    constraints: &mut FilmConstraints,
    settings: &CoatingSettings,
    changes: &FilmChanges,
) {
    if !changes.fractured() {
        return;
    }
    let topology = &mesh.topology;
    let Some(grain) = settings.scale.grain_of(&mesh.geometry) else {
        if constraints.take_curl().is_some() {
            topology.all_edges().for_each(|h| constraints.set_share(mesh, h, 1.0));
        }
        return;
    };
    let fresh = CurlField::new(grain, settings.deform.curl_reach);
    let before = constraints.take_curl();
    let known = before.filter(|field| (field.grain, field.reach) == (fresh.grain, fresh.reach));
    let is_new = known.is_none();
    let mut field = known.unwrap_or(fresh);
    field.follow(topology);
    field.changed.clear();
    let is_free = |v: VertexId| !constraints.is_attached(v);
    if is_new {
        for h in topology.all_half_edges().filter(|&h| topology.is_live(h.face())) {
            if topology.is_torn(h) || topology.rest_twin(h).is_some_and(|twin| !topology.is_live(twin.face())) {
                field.seed_torn(mesh, h);
            }
        }
        topology.all_vertices().filter(|&v| is_free(v)).for_each(|v| field.seed_border(mesh, v, is_free));
    } else {
        changes.torn.iter().for_each(|&h| field.seed_torn(mesh, h));
        for v in changes.removed.iter().flat_map(|&f| topology.corners(f)) {
            field.seed(mesh, v);
        }
        changes.separated.iter().for_each(|&v| field.seed_border(mesh, v, is_free));
    }
    field.spread(mesh);
    if is_new {
        topology.all_edges().for_each(|h| constraints.set_share(mesh, h, field.share(mesh, h)));
    } else {
        for i in 0..field.changed.len() {
            for h in topology.fan(field.changed[i]).flat_map(|h| [h, h.previous()]) {
                let edge = topology.edge(h);
                constraints.set_share(mesh, edge, field.share(mesh, edge));
            }
        }
    }
    constraints.put_curl(field);
}
