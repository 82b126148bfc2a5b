//! The packed solver: the points of a film, and the packs that hold the constraints which anything can move.

mod saved;

use super::{
    layout::Layout,
    level::{Kernels, SimdLevel},
    points::{Motion, Points},
    region::{BendLane, LengthLane, Region},
    slots::Blocked,
};
use crate::{
    deform::{
        bend::{BendConstraint, bend_points, shape_at_rest},
        ledger::Ledger,
        pace::Narrowing,
    },
    film::{FilmMesh, Geometry, HalfEdgeId, Topology, VertexId, words::Words},
};

/// Growth of the share of a bend that is too little to be seen: what sleeps there sleeps on.
const LEAST_WAKE: f32 = 1e-3;

/// Constraints of a film as the packed solver sees them. Which there are, and in which lane each lies, is in the
/// film's [`Ledger`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PackedConstraints {
    points: Points,
    regions: Vec<Region>,
    /// Whether the points are elsewhere than the film: the plain solver moves the film alone.
    outdated: bool,
    blocked: Blocked,
    spare_bends: Vec<(u32, BendLane)>,
    spare_lengths: Vec<(u32, LengthLane)>,
}

impl PackedConstraints {
    /// Makes the points of a film that is attached everywhere and has no constraints.
    pub fn new(geometry: &Geometry) -> Self {
        let layout = Layout::new(&geometry.rest_positions);
        Self {
            points: Points::new(&geometry.rest_positions, &geometry.rest_normals, geometry.mean_edge, &layout),
            regions: vec![Region::default(); layout.regions],
            ..Self::default()
        }
    }

    /// Returns the points.
    pub fn points(&self) -> &Points {
        &self.points
    }

    /// Returns the points, to be changed.
    pub fn points_mut(&mut self) -> &mut Points {
        &mut self.points
    }

    /// Returns the number of length and of bend constraints in packs.
    pub fn active_counts(&self) -> [usize; 2] {
        self.regions
            .iter()
            .map(|region| region.counts())
            .fold([0; 2], |sum, [bends, lengths]| [sum[0] + lengths, sum[1] + bends])
    }

    /// Returns the number of regions.
    pub fn region_count(&self) -> usize {
        self.regions.len()
    }

    /// Returns the region whose packs hold what `h` carries. Duplicates are in the region of their vertex, so it stays.
    pub fn region_index(&self, topology: &Topology, h: HalfEdgeId) -> usize {
        if self.regions.len() == 1 {
            return 0;
        }
        self.points.region_of(topology.origin(h).index())
    }

    /// Returns the length constraint in `lane`, which `h` carries.
    pub fn length_in(&self, topology: &Topology, h: HalfEdgeId, lane: u32) -> LengthLane {
        self.regions[self.region_index(topology, h)].length(lane, &self.points)
    }

    /// Returns the bend constraint in `lane`, which `h` carries.
    pub fn bend_in(&self, topology: &Topology, h: HalfEdgeId, lane: u32) -> BendLane {
        self.regions[self.region_index(topology, h)].bend(lane, &self.points)
    }

    /// Returns the target of the bend that `h` carries, in radians.
    pub fn target(&self, ledger: &Ledger, topology: &Topology, h: HalfEdgeId) -> Option<f32> {
        match ledger.bends().lane(h) {
            Some(lane) => Some(self.bend_in(topology, h, lane).target),
            None => ledger.bends().has(h).then(|| ledger.parked_target(h)),
        }
    }

    /// Returns the bend constraint that `h` carries.
    pub fn bend_of(&self, ledger: &Ledger, mesh: &FilmMesh, h: HalfEdgeId) -> Option<BendConstraint> {
        let target = self.target(ledger, &mesh.topology, h)?;
        let mut bend = BendConstraint::of_edge(mesh, h, ledger.start(h));
        bend.set_target(target);
        Some(bend)
    }

    /// Returns whether a step of narrowing changes the target of the bend that `h` carries, which is in a pack.
    pub fn is_narrowing(&self, ledger: &Ledger, topology: &Topology, h: HalfEdgeId, by: Narrowing) -> bool {
        ledger.bends().lane(h).is_some_and(|lane| {
            let bend = self.bend_in(topology, h, lane);
            // A step that rounding swallows, like one of 0, leads nowhere.
            bend.target > bend.start - by.limit * bend.share && bend.target - by.step * bend.share < bend.target
        })
    }

    /// Removes the length constraint of `h` from the ledger and its pack.
    pub fn remove_length(&mut self, ledger: &mut Ledger, topology: &Topology, h: HalfEdgeId) {
        if let Some(lane) = ledger.remove_length(h) {
            let region = self.region_index(topology, h);
            self.regions[region].remove_length(lane, &self.points);
        }
    }

    /// Removes the bend constraint of `h` from the ledger and its pack.
    pub fn remove_bend(&mut self, ledger: &mut Ledger, topology: &Topology, h: HalfEdgeId) {
        if let Some(lane) = ledger.remove_bend(h) {
            let region = self.region_index(topology, h);
            self.regions[region].remove_bend(lane, &self.points);
        }
    }

    /// Makes the constraints that `h` carries, if any, refer to the vertices that it has now.
    pub fn refresh(&mut self, ledger: &mut Ledger, topology: &Topology, h: HalfEdgeId) {
        let region = self.region_index(topology, h);
        if let Some(lane) = ledger.lengths().lane(h) {
            let ends = [topology.origin(h).0, topology.target(h).0];
            self.regions[region].move_length(lane, ends, &self.points);
        }
        if let Some(lane) = ledger.bends().lane(h) {
            self.regions[region].move_bend(lane, bend_points(topology, h), &self.points);
        }
        ledger.touch();
    }

    /// Puts the constraints at `v`, which is awake, into packs.
    pub fn unpark_around(&mut self, ledger: &mut Ledger, mesh: &FilmMesh, v: VertexId) {
        for h in mesh.topology.fan(v) {
            for side in [h, h.previous()] {
                let carrier = mesh.topology.bound_twin(side).map_or(side, |twin| twin.min(side));
                self.unpark_length(ledger, mesh, carrier);
            }
            for side in [h, h.next(), h.previous()] {
                self.unpark_bend(ledger, mesh, mesh.topology.edge(side));
            }
        }
    }

    /// Puts the length constraint that `h` carries into a pack if it is parked.
    pub fn unpark_length(&mut self, ledger: &mut Ledger, mesh: &FilmMesh, h: HalfEdgeId) {
        if !ledger.lengths().is_parked(h) {
            return;
        }
        let length = self.length_lane(mesh, h);
        self.place_length(ledger, &mesh.topology, h, &length);
    }

    /// Returns the length constraint that `h` carries, as a lane holds it.
    fn length_lane(&self, mesh: &FilmMesh, h: HalfEdgeId) -> LengthLane {
        let vertices = [mesh.topology.origin(h).0, mesh.topology.target(h).0];
        LengthLane { vertices, rest: mesh.geometry.rest_lengths[h.index()] / self.points.unit() }
    }

    fn place_length(&mut self, ledger: &mut Ledger, topology: &Topology, h: HalfEdgeId, length: &LengthLane) {
        let region = self.region_index(topology, h);
        self.blocked.next();
        for v in length.vertices {
            for_edges_at(topology, VertexId(v), |edge| {
                if self.region_index(topology, edge) == region
                    && let Some(lane) = ledger.lengths().lane(edge)
                {
                    self.blocked.block(lane);
                }
            });
        }
        let lane = self.regions[region].add_length(h.0, length, &self.blocked, &self.points);
        ledger.put_length(h, lane);
    }

    /// Puts the bend constraint that `h` carries into a pack if it is parked.
    pub fn unpark_bend(&mut self, ledger: &mut Ledger, mesh: &FilmMesh, h: HalfEdgeId) {
        if !ledger.bends().is_parked(h) {
            return;
        }
        let bend = self.bend_lane(ledger, mesh, h);
        self.place_bend(ledger, &mesh.topology, h, &bend);
    }

    /// Returns the bend constraint that `h` carries and that is parked, as a lane holds it.
    fn bend_lane(&self, ledger: &Ledger, mesh: &FilmMesh, h: HalfEdgeId) -> BendLane {
        let vertices = bend_points(&mesh.topology, h);
        let (skews, medians) = shape_at_rest(vertices.map(|v| mesh.geometry.rest_positions[v as usize]));
        let unit = self.points.unit();
        let medians = medians.map(|median| (median / unit) * (median / unit));
        let (start, target, share) = (ledger.start(h), ledger.parked_target(h), ledger.share(h));
        BendLane { vertices, skews, medians, start, target, share }
    }

    fn place_bend(&mut self, ledger: &mut Ledger, topology: &Topology, h: HalfEdgeId, bend: &BendLane) {
        let region = self.region_index(topology, h);
        self.blocked.next();
        for v in bend.vertices {
            for_edges_at(topology, VertexId(v), |edge| self.block_bend(ledger, topology, edge, region));
            for h in topology.fan(VertexId(v)) {
                self.block_bend(ledger, topology, topology.edge(h.next()), region);
            }
        }
        let lane = self.regions[region].add_bend(h.0, bend, &self.blocked, &self.points);
        ledger.put_bend(h, lane);
    }

    /// Blocks the pack of the bend that `edge` carries, if it lies in `region`.
    #[inline]
    fn block_bend(&mut self, ledger: &Ledger, topology: &Topology, edge: HalfEdgeId, region: usize) {
        if self.region_index(topology, edge) == region
            && let Some(lane) = ledger.bends().lane(edge)
        {
            self.blocked.block(lane);
        }
    }

    /// Parks what `h` carries as far as no vertex of it is awake any more.
    pub fn park(&mut self, ledger: &mut Ledger, topology: &Topology, h: HalfEdgeId) {
        let region = self.region_index(topology, h);
        if let Some(lane) = ledger.lengths().lane(h)
            && self.regions[region].length_is_still(lane, &self.points)
        {
            self.regions[region].remove_length(lane, &self.points);
            ledger.park_length(h);
        }
        if let Some(lane) = ledger.bends().lane(h)
            && self.regions[region].bend_is_still(lane, &self.points)
        {
            let bend = self.regions[region].remove_bend(lane, &self.points);
            ledger.park_bend(h, bend.target);
        }
    }

    /// Gives up packs that are nearly empty: at most one of each kind in each region, so that the work is bounded.
    pub fn compact(&mut self, ledger: &mut Ledger, topology: &Topology) {
        let (mut bends, mut lengths) = (std::mem::take(&mut self.spare_bends), std::mem::take(&mut self.spare_lengths));
        for region in 0..self.regions.len() {
            if let Some(pack) = self.regions[region].sparse_bends() {
                let moved = |owner, lane| ledger.put_bend(HalfEdgeId(owner), lane);
                self.regions[region].dissolve_bends(pack, &self.points, &mut bends, moved);
                for &(owner, _) in &bends {
                    ledger.lift_bend(HalfEdgeId(owner));
                }
                for (owner, bend) in &bends {
                    self.place_bend(ledger, topology, HalfEdgeId(*owner), bend);
                }
            }
            if let Some(pack) = self.regions[region].sparse_lengths() {
                let moved = |owner, lane| ledger.put_length(HalfEdgeId(owner), lane);
                self.regions[region].dissolve_lengths(pack, &self.points, &mut lengths, moved);
                for &(owner, _) in &lengths {
                    ledger.park_length(HalfEdgeId(owner));
                }
                for (owner, length) in &lengths {
                    self.place_length(ledger, topology, HalfEdgeId(*owner), length);
                }
            }
        }
        bends.clear();
        lengths.clear();
        (self.spare_bends, self.spare_lengths) = (bends, lengths);
    }

    /// Sets the share by which the target of the bend that `h` carries narrows, also where it carries none yet. Returns
    /// whether it carries one and the share grew noticeably.
    pub fn set_share(&mut self, ledger: &mut Ledger, topology: &Topology, h: HalfEdgeId, share: f32) -> bool {
        let before = ledger.share(h);
        ledger.set_share(h, share);
        if let Some(lane) = ledger.bends().lane(h)
            && share != before
        {
            let region = self.region_index(topology, h);
            self.regions[region].set_share(lane, share);
        }
        ledger.bends().has(h) && share > before + LEAST_WAKE
    }

    /// Narrows all targets.
    pub fn narrow(&mut self, level: SimdLevel, by: Narrowing) {
        for region in &mut self.regions {
            region.narrow(level, by.step, by.limit);
        }
    }

    /// Has all targets looked at when they narrow next, as the settings have changed.
    pub fn restart_narrowing(&mut self) {
        self.regions.iter_mut().for_each(Region::restart_narrowing);
    }

    /// Returns whether the points may be elsewhere than the film.
    pub fn is_outdated(&self) -> bool {
        self.outdated
    }

    /// Notes that the plain solver has moved the film without the points.
    pub fn mark_outdated(&mut self) {
        self.outdated = true;
    }

    /// Solves a step: `sweeps` times momentum, bends and lengths (VC 4.1), then writes what moved into the film.
    /// `keep` is the momentum, from 0 to 1.
    pub fn solve(&mut self, geometry: &mut Geometry, level: SimdLevel, sweeps: u32, keep: f32) {
        if self.outdated {
            self.reload(geometry);
        }
        let kernels = Kernels::of(level);
        for _ in 0..sweeps {
            self.sweep(&kernels, keep);
        }
        // The half-space after the last sweep.
        (0..self.regions.len()).for_each(|region| self.points.project(&kernels, region));
        self.points.write_awake(&mut geometry.positions);
    }

    /// Takes the points from where the film is, without momentum.
    fn reload(&mut self, geometry: &Geometry) {
        for (v, &p) in geometry.positions.iter().enumerate() {
            self.points.put(v, p, p);
        }
        self.outdated = false;
    }

    /// Sweeps once over one region after the other, as its points are in the cache then: momentum, bends, lengths, the
    /// half-space after each of the first two.
    fn sweep(&mut self, kernels: &Kernels, keep: f32) {
        for (i, region) in self.regions.iter().enumerate() {
            self.points.advance(kernels, i, keep);
            region.sweep_bends(&mut self.points, kernels);
            self.points.project(kernels, i);
            region.sweep_lengths(&mut self.points, kernels);
        }
    }

    /// Projects every bend constraint that is in a pack once.
    #[cfg(feature = "bench")]
    pub fn sweep_bends(&mut self, level: SimdLevel) {
        let kernels = Kernels::of(level);
        self.regions.iter().for_each(|region| region.sweep_bends(&mut self.points, &kernels));
    }

    /// Projects every length constraint that is in a pack once.
    #[cfg(feature = "bench")]
    pub fn sweep_lengths(&mut self, level: SimdLevel) {
        let kernels = Kernels::of(level);
        self.regions.iter().for_each(|region| region.sweep_lengths(&mut self.points, &kernels));
    }

    /// Appends all that decides what a solve does.
    pub fn write_state(&self, to: &mut Words) {
        // Buffers are empty, or mean nothing, between steps.
        let Self { points, regions, outdated, blocked: _, spare_bends: _, spare_lengths: _ } = self;
        points.write_state(to);
        regions.iter().for_each(|region| region.write_state(to));
        to.word(u32::from(*outdated));
    }

    /// Returns what `v` does.
    pub fn motion(&self, v: VertexId) -> Motion {
        self.points.motion(v.index())
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
