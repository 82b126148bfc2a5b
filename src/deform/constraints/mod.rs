//! The constraints of a film, and their upkeep.
//!
//! Which constraints there are is decided by fracture (see [`update_constraints`](super::update_constraints)). Those that
//! anything can move lie in the packs of the packed solver, the others are parked: nothing is kept of them but their
//! angles, as all else follows from the film.

mod validate;

use super::{
    BendConstraint, LengthConstraint, SolverQuality,
    bend::shape_at_rest,
    packed::{BendLane, Blocked, LengthLane, Motion, Points, Region, SimdLevel},
    regions::Layout,
};
use crate::{
    film::{FilmMesh, Geometry, HalfEdgeId, Topology, VertexId},
    settings::DeformSettings,
};

/// No constraint, in place of its lane.
const NONE: u32 = u32::MAX;
/// A constraint that nothing moves.
const PARKED: u32 = u32::MAX - 1;

/// Constraints of a film. A bound edge has at most one length and one bend constraint, carried by its lower half-edge;
/// a torn edge one length constraint for each half-edge whose face is live.
///
/// The order in which constraints are solved follows from the order of fracture alone. It decides later bits, so it is
/// part of the film's state.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component))]
pub struct FilmConstraints {
    pub(super) points: Points,
    pub(super) regions: Vec<Region>,
    /// Lane of the constraint that each half-edge carries.
    length_lanes: Vec<u32>,
    bend_lanes: Vec<u32>,
    /// Angle at which the bend that each half-edge carries began, and its target when it was parked, in radians.
    angles: Vec<[f32; 2]>,
    /// Numbers of length and bend constraints.
    counts: [usize; 2],
    /// Counts what the plain solver needs to know of.
    pub(super) revision: u64,
    /// Whether `points` are where the film is: the plain solver moves the film alone.
    pub(super) points_outdated: bool,
    /// Settings and quality of the last step.
    pub(super) settings: Option<(DeformSettings, SolverQuality)>,
    pub(super) rest: super::sleep::SleepMarks,
    pub(super) plain: super::plain::PlainConstraints,
    blocked: Blocked,
    spare_bends: Vec<(u32, BendLane)>,
    spare_lengths: Vec<(u32, LengthLane)>,
}

impl FilmConstraints {
    /// No constraints: those of a fresh film, all of whose vertices are attached.
    pub fn new(mesh: &FilmMesh) -> Self {
        let geometry = &mesh.geometry;
        let half_edges = mesh.topology.half_edge_count();
        let layout = Layout::new(&geometry.rest_positions);
        Self {
            points: Points::new(&geometry.rest_positions, &geometry.rest_normals, geometry.mean_edge, &layout),
            regions: vec![Region::default(); layout.regions],
            length_lanes: vec![NONE; half_edges],
            bend_lanes: vec![NONE; half_edges],
            angles: vec![[0.0; 2]; half_edges],
            rest: super::sleep::SleepMarks::new(mesh.topology.vertex_count()),
            ..Self::default()
        }
    }

    /// Number of length constraints.
    pub fn length_count(&self) -> usize {
        self.counts[0]
    }

    /// Number of bend constraints.
    pub fn bend_count(&self) -> usize {
        self.counts[1]
    }

    /// Number of length and of bend constraints that sweeps visit: those at a vertex that is awake.
    pub fn active_counts(&self) -> [usize; 2] {
        self.regions
            .iter()
            .map(|region| region.counts())
            .fold([0; 2], |sum, [bends, lengths]| [sum[0] + lengths, sum[1] + bends])
    }

    /// Number of packs of length and of bend constraints, of 32 lanes each.
    pub fn pack_counts(&self) -> [usize; 2] {
        self.regions
            .iter()
            .map(|region| region.packs())
            .fold([0; 2], |sum, [bends, lengths]| [sum[0] + lengths, sum[1] + bends])
    }

    /// Projects every active bend constraint once, as sweeps do, without moving the film: for benchmarks.
    pub fn sweep_bends(&mut self, level: SimdLevel) {
        self.points.sweep_bends(&self.regions, level);
    }

    /// Projects every active length constraint once, as sweeps do, without moving the film: for benchmarks.
    pub fn sweep_lengths(&mut self, level: SimdLevel) {
        self.points.sweep_lengths(&self.regions, level);
    }

    /// Vertices that move.
    pub fn awake(&self) -> impl Iterator<Item = VertexId> + '_ {
        self.points.awake().map(VertexId::new)
    }

    /// Number of vertices that move.
    pub fn awake_count(&self) -> usize {
        self.points.awake_count()
    }

    /// What `v` does.
    pub(super) fn motion(&self, v: VertexId) -> Motion {
        self.points.motion(v.index())
    }

    /// Whether `v` is held by the metal: its inverse mass is 0 whatever happens.
    pub fn is_attached(&self, v: VertexId) -> bool {
        self.motion(v) == Motion::Attached
    }

    /// Whether `v` is free but moves too little to be looked at.
    pub fn is_asleep(&self, v: VertexId) -> bool {
        self.motion(v) == Motion::Asleep
    }

    /// The length constraint that `h` carries.
    pub fn length_of(&self, mesh: &FilmMesh, h: HalfEdgeId) -> Option<LengthConstraint> {
        (self.length_lanes[h.index()] != NONE).then(|| LengthConstraint {
            half_edge: h,
            ends: [mesh.topology.origin(h).0, mesh.topology.target(h).0],
            rest: mesh.geometry.rest_lengths[h.index()],
        })
    }

    /// All length constraints, sorted by half-edge.
    pub fn lengths<'a>(&'a self, mesh: &'a FilmMesh) -> impl Iterator<Item = LengthConstraint> + 'a {
        let [carriers, _] = self.carriers();
        carriers.filter_map(|h| self.length_of(mesh, h))
    }

    /// The bend constraint that `h` carries.
    pub fn bend_of(&self, mesh: &FilmMesh, h: HalfEdgeId) -> Option<BendConstraint> {
        let target = match self.bend_lanes[h.index()] {
            NONE => return None,
            PARKED => self.angles[h.index()][1],
            lane => self.region(&mesh.topology, h).bend(lane, &self.points).target,
        };
        let mut bend = self.bend_at_rest(mesh, h);
        bend.set_target(target);
        Some(bend)
    }

    fn bend_at_rest(&self, mesh: &FilmMesh, h: HalfEdgeId) -> BendConstraint {
        let points = bend_points(&mesh.topology, h);
        let rest = points.map(|v| mesh.geometry.rest_positions[v as usize]);
        BendConstraint::new(h, points, rest, self.angles[h.index()][0])
    }

    fn region(&self, topology: &Topology, h: HalfEdgeId) -> &Region {
        &self.regions[self.region_index(topology, h)]
    }

    /// The region whose packs hold what `h` carries. Duplicates are in the region of their vertex, so it stays.
    fn region_index(&self, topology: &Topology, h: HalfEdgeId) -> usize {
        if self.regions.len() == 1 {
            return 0;
        }
        self.points.region_of(topology.origin(h).index())
    }

    /// Puts a length constraint on the edge of `h`, or on `h` alone if the edge is torn; none twice.
    pub(super) fn ensure_length(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        let topology = &mesh.topology;
        let carrier = topology.bound_twin(h).map_or(h, |twin| twin.min(h));
        if self.length_lanes[carrier.index()] != NONE || !topology.is_live(carrier.face()) {
            return;
        }
        self.length_lanes[carrier.index()] = PARKED;
        self.counts[0] += 1;
        self.revision += 1;
        self.unpark_length(mesh, carrier);
    }

    /// Puts a bend constraint on the edge of `h`, starting at the current angle; none twice, and none on an
    /// edge that is torn or at the border.
    pub(super) fn ensure_bend(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        let Some(twin) = mesh.topology.bound_twin(h) else { return };
        let carrier = h.min(twin);
        if self.bend_lanes[carrier.index()] != NONE || !mesh.topology.is_live(carrier.face()) {
            return;
        }
        let angle = angle_now(mesh, carrier);
        self.angles[carrier.index()] = [angle; 2];
        self.bend_lanes[carrier.index()] = PARKED;
        self.counts[1] += 1;
        self.revision += 1;
        self.unpark_bend(mesh, carrier);
        // Its target is about to narrow.
        for v in bend_points(&mesh.topology, carrier) {
            self.wake(mesh, VertexId(v));
        }
    }

    /// Takes the length constraint off `h`.
    pub(super) fn remove_length(&mut self, topology: &Topology, h: HalfEdgeId) {
        let lane = std::mem::replace(&mut self.length_lanes[h.index()], NONE);
        if lane != NONE {
            self.counts[0] -= 1;
            self.revision += 1;
        }
        if lane < PARKED {
            let region = self.region_index(topology, h);
            self.regions[region].remove_length(lane, &self.points);
        }
    }

    /// Takes the bend constraint off `h`.
    pub(super) fn remove_bend(&mut self, topology: &Topology, h: HalfEdgeId) {
        let lane = std::mem::replace(&mut self.bend_lanes[h.index()], NONE);
        if lane != NONE {
            self.counts[1] -= 1;
            self.revision += 1;
        }
        if lane < PARKED {
            let region = self.region_index(topology, h);
            self.regions[region].remove_bend(lane, &self.points);
        }
    }

    /// Makes the constraints that `h` carries, if any, refer to the vertices that it has now.
    pub(super) fn refresh(&mut self, topology: &Topology, h: HalfEdgeId) {
        let region = self.region_index(topology, h);
        let (length, bend) = (self.length_lanes[h.index()], self.bend_lanes[h.index()]);
        if length < PARKED {
            let ends = [topology.origin(h).0, topology.target(h).0];
            self.regions[region].move_length(length, ends, &self.points);
        }
        if bend < PARKED {
            self.regions[region].move_bend(bend, bend_points(topology, h), &self.points);
        }
        self.revision += 1;
    }

    /// A vertex was appended: a copy of `kept`.
    pub(super) fn duplicate(&mut self, kept: VertexId) {
        self.points.duplicate(kept.index());
        self.rest.append(kept.index());
    }

    /// `v` has separated.
    pub(super) fn free(&mut self, v: VertexId) {
        if self.motion(v) == Motion::Attached {
            self.points.wake(v.index());
            self.rest.mark(v.index(), &self.points);
        }
    }

    /// Wakes `v` if it sleeps, and the constraints at it.
    pub(super) fn wake(&mut self, mesh: &FilmMesh, v: VertexId) {
        if self.motion(v) != Motion::Asleep {
            return;
        }
        self.points.wake(v.index());
        self.rest.mark(v.index(), &self.points);
        self.unpark_around(mesh, v);
    }

    /// Puts the constraints at `v`, which is awake, into packs.
    pub(super) fn unpark_around(&mut self, mesh: &FilmMesh, v: VertexId) {
        for h in mesh.topology.fan(v) {
            for side in [h, h.previous()] {
                let carrier = mesh.topology.bound_twin(side).map_or(side, |twin| twin.min(side));
                self.unpark_length(mesh, carrier);
            }
            for side in [h, h.next(), h.previous()] {
                self.unpark_bend(mesh, mesh.topology.edge(side));
            }
        }
    }

    /// Wakes every vertex that sleeps.
    pub(super) fn wake_all(&mut self, mesh: &FilmMesh) {
        for v in mesh.topology.all_vertices() {
            self.wake(mesh, v);
        }
        self.regions.iter_mut().for_each(Region::restart_narrowing);
    }

    fn unpark_length(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        if self.length_lanes[h.index()] != PARKED {
            return;
        }
        let vertices = [mesh.topology.origin(h).0, mesh.topology.target(h).0];
        let rest = mesh.geometry.rest_lengths[h.index()] / self.points.unit();
        self.place_length(&mesh.topology, h, &LengthLane { vertices, rest });
    }

    fn place_length(&mut self, topology: &Topology, h: HalfEdgeId, length: &LengthLane) {
        let region = self.region_index(topology, h);
        self.blocked.next();
        for v in length.vertices {
            for_edges_at(topology, VertexId(v), |edge| {
                if self.region_index(topology, edge) == region && self.length_lanes[edge.index()] < PARKED {
                    self.blocked.block(self.length_lanes[edge.index()]);
                }
            });
        }
        let lane = self.regions[region].add_length(h.0, length, &self.blocked, &self.points);
        self.length_lanes[h.index()] = lane;
    }

    fn unpark_bend(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        if self.bend_lanes[h.index()] != PARKED {
            return;
        }
        let vertices = bend_points(&mesh.topology, h);
        let (skews, medians) = shape_at_rest(vertices.map(|v| mesh.geometry.rest_positions[v as usize]));
        let unit = self.points.unit();
        let medians = medians.map(|median| (median / unit) * (median / unit));
        let [start, target] = self.angles[h.index()];
        self.place_bend(&mesh.topology, h, &BendLane { vertices, skews, medians, start, target });
    }

    fn place_bend(&mut self, topology: &Topology, h: HalfEdgeId, bend: &BendLane) {
        let region = self.region_index(topology, h);
        self.blocked.next();
        for v in bend.vertices {
            for_edges_at(topology, VertexId(v), |edge| {
                if self.region_index(topology, edge) == region && self.bend_lanes[edge.index()] < PARKED {
                    self.blocked.block(self.bend_lanes[edge.index()]);
                }
            });
            for h in topology.fan(VertexId(v)) {
                let edge = topology.edge(h.next());
                if self.region_index(topology, edge) == region && self.bend_lanes[edge.index()] < PARKED {
                    self.blocked.block(self.bend_lanes[edge.index()]);
                }
            }
        }
        let lane = self.regions[region].add_bend(h.0, bend, &self.blocked, &self.points);
        self.bend_lanes[h.index()] = lane;
    }

    /// Parks what no awake vertex of `h`'s constraints can move any more.
    pub(super) fn park(&mut self, topology: &Topology, h: HalfEdgeId) {
        let region = self.region_index(topology, h);
        let (length, bend) = (self.length_lanes[h.index()], self.bend_lanes[h.index()]);
        if length < PARKED && self.regions[region].length_is_still(length, &self.points) {
            self.regions[region].remove_length(length, &self.points);
            self.length_lanes[h.index()] = PARKED;
        }
        if bend < PARKED && self.regions[region].bend_is_still(bend, &self.points) {
            self.angles[h.index()][1] = self.regions[region].remove_bend(bend, &self.points).target;
            self.bend_lanes[h.index()] = PARKED;
        }
    }

    /// Whether the bend that `h` carries has not reached its last target yet.
    pub(super) fn is_narrowing(&self, topology: &Topology, h: HalfEdgeId, limit: f32) -> bool {
        let lane = self.bend_lanes[h.index()];
        lane < PARKED && {
            let bend = self.region(topology, h).bend(lane, &self.points);
            bend.target > bend.start - limit
        }
    }

    /// Gives up packs that are nearly empty: at most one of each kind in each region, so that the work is bounded.
    pub(super) fn compact(&mut self, topology: &Topology) {
        let (mut bends, mut lengths) = (std::mem::take(&mut self.spare_bends), std::mem::take(&mut self.spare_lengths));
        for region in 0..self.regions.len() {
            if let Some(pack) = self.regions[region].sparse_bends() {
                let lanes = &mut self.bend_lanes;
                self.regions[region]
                    .dissolve_bends(pack, &self.points, &mut bends, |owner, lane| lanes[owner as usize] = lane);
                for &(owner, _) in &bends {
                    self.bend_lanes[owner as usize] = PARKED;
                }
                for (owner, bend) in &bends {
                    self.place_bend(topology, HalfEdgeId(*owner), bend);
                }
            }
            if let Some(pack) = self.regions[region].sparse_lengths() {
                let lanes = &mut self.length_lanes;
                self.regions[region]
                    .dissolve_lengths(pack, &self.points, &mut lengths, |owner, lane| lanes[owner as usize] = lane);
                for &(owner, _) in &lengths {
                    self.length_lanes[owner as usize] = PARKED;
                }
                for (owner, length) in &lengths {
                    self.place_length(topology, HalfEdgeId(*owner), length);
                }
            }
        }
        bends.clear();
        lengths.clear();
        (self.spare_bends, self.spare_lengths) = (bends, lengths);
    }

    /// Takes the points from where the film is, without momentum.
    pub(super) fn reload_points(&mut self, geometry: &Geometry) {
        for (v, &p) in geometry.positions.iter().enumerate() {
            self.points.put(v, p, p);
        }
        self.points_outdated = false;
    }

    /// Narrows all targets by `step` down to `limit` below where they began, in radians.
    pub(super) fn narrow(&mut self, level: SimdLevel, step: f32, limit: f32) {
        for region in &mut self.regions {
            region.narrow(level, step, limit);
        }
    }

    /// Target of the bend that `h` carries, in radians.
    pub(super) fn target(&self, topology: &Topology, h: HalfEdgeId) -> Option<f32> {
        match self.bend_lanes[h.index()] {
            NONE => None,
            PARKED => Some(self.angles[h.index()][1]),
            lane => Some(self.region(topology, h).bend(lane, &self.points).target),
        }
    }

    /// Half-edges that carry a length constraint, and those that carry a bend constraint.
    pub(super) fn carriers(&self) -> [impl Iterator<Item = HalfEdgeId> + '_; 2] {
        [&self.length_lanes, &self.bend_lanes]
            .map(|lanes| lanes.iter().enumerate().filter(|(_, lane)| **lane != NONE).map(|(h, _)| HalfEdgeId::new(h)))
    }
}

/// Calls `with` for what may carry a constraint on an edge at `v`.
#[inline]
fn for_edges_at(topology: &Topology, v: VertexId, mut with: impl FnMut(HalfEdgeId)) {
    for h in topology.fan(v) {
        for side in [h, h.previous()] {
            with(topology.bound_twin(side).map_or(side, |twin| twin.min(side)));
        }
    }
}

/// Dihedral angle now of the bound edge that `h` carries. A face folded to nothing has none; its rest angle is what it
/// comes from, and it is also that of a pair that has not moved.
fn angle_now(mesh: &FilmMesh, h: HalfEdgeId) -> f32 {
    let (topology, geometry) = (&mesh.topology, &mesh.geometry);
    let rest = geometry.rest_dihedrals[h.index()];
    let moved = |&v: &u32| geometry.positions[v as usize] != geometry.rest_positions[v as usize];
    if bend_points(topology, h).iter().any(moved) { geometry.dihedral(topology, h).unwrap_or(rest) } else { rest }
}

/// p1, p2, p3, p4 of the bound edge that `h` carries.
pub(super) fn bend_points(topology: &Topology, h: HalfEdgeId) -> [u32; 4] {
    let tip = topology.rest_twin(h).map_or(topology.apex(h), |twin| topology.apex(twin));
    [topology.origin(h).0, topology.target(h).0, topology.apex(h).0, tip.0]
}
