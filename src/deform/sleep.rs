//! Sleep: vertices that would move too little to be seen are left out of the solve.
//!
//! Who sleeps is decided once a tick. A vertex is quiet in a tick in which it moved less than [`QUIET`] of a mean edge,
//! so that what a sleeping vertex misses in a whole unit of age is too little to be seen. It falls asleep once it and
//! all vertices that share a constraint with it have been quiet for [`TICKS`] ticks and no target there narrows any
//! more. It wakes when one of these vertices moves more than that, or anything fractures beside it.
//!
//! On a film that is measured by its grain a vertex wakes only once one of these vertices has come [`DISTURBED`] of a
//! mean edge away from where it last was when it woke its neighbours. And of what has curled nothing falls asleep
//! before all of it may: constraints that are left out or come back change the order in which the others are solved,
//! on which the shape of curls depends a little, so that curls that slept one by one would wake each other without end.
//!
//! A loose piece sleeps as a whole or not at all: a part of it held fast would push the rest about without end.

mod saved;

use bevy_math::Vec3;

use super::{
    ledger::Ledger,
    pace::Narrowing,
    packed::{
        constraints::PackedConstraints,
        points::{Motion, Points},
    },
};
use crate::film::{FilmMesh, HalfEdgeId, LoosePieces, Topology, VertexId, words::Words};

/// Farthest that a quiet vertex moves in a tick, in mean edges.
const QUIET: f32 = 1e-4;
/// The same on a film that is measured by its grain: what moves so little comes to rest within an edge's twentieth.
const QUIET_BY_GRAIN: f32 = 1e-3;
/// Distance from its place at rest, in mean edges, within which a vertex has not curled: one farther away takes part
/// in curls, and would let them jerk if it slept (tried: with 0.02, by 0.03 mean edges now and then, without end).
const FLAT: f32 = 5e-4;
/// Way of a vertex, in mean edges, that wakes its neighbours on a film that is measured by its grain.
const DISTURBED: f32 = 0.01;
/// Number of ticks that a vertex must have been quiet.
const TICKS: u8 = 2;

/// Marks of sleep: where each vertex was at the last tick, and for how many ticks it has been quiet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SleepMarks {
    positions: Vec<Vec3>,
    quiet: Vec<u8>,
    /// Where each vertex was when it last woke its neighbours. Empty by the paper's rules.
    announced: Vec<Vec3>,
    /// Vertices of loose pieces, all false between ticks.
    loose: Vec<bool>,
    /// Vertices that fall asleep.
    sleepers: Vec<VertexId>,
    /// Half-edges to be parked.
    stale: Vec<HalfEdgeId>,
    /// Vertices to be woken.
    disturbed: Vec<VertexId>,
}

impl SleepMarks {
    /// Makes the marks of so many vertices.
    pub fn new(vertices: usize) -> Self {
        Self {
            positions: vec![Vec3::ZERO; vertices],
            quiet: vec![0; vertices],
            loose: vec![false; vertices],
            ..Self::default()
        }
    }

    /// Appends a vertex: a duplicate of `kept`.
    pub fn append(&mut self, kept: VertexId) {
        self.positions.push(self.positions[kept.index()]);
        self.quiet.push(0);
        self.loose.push(false);
        if let Some(&announced) = self.announced.get(kept.index()) {
            self.announced.push(announced);
        }
    }

    /// Notes that `v` begins to move from where it is.
    pub fn mark(&mut self, v: VertexId, points: &Points) {
        self.positions[v.index()] = points.position(v.index());
        self.quiet[v.index()] = 0;
    }

    /// Forgets where `v` was before, which is gone at `position`: nothing asks for it any more, and a snapshot need not
    /// hold it.
    pub fn forget(&mut self, v: VertexId, position: Vec3) {
        self.positions[v.index()] = position;
        self.quiet[v.index()] = 0;
        if let Some(announced) = self.announced.get_mut(v.index()) {
            *announced = position;
        }
    }

    /// Wakes `v` if it sleeps, and the constraints at it.
    pub fn wake(&mut self, packed: &mut PackedConstraints, ledger: &mut Ledger, mesh: &FilmMesh, v: VertexId) {
        if packed.motion(v) != Motion::Asleep {
            return;
        }
        packed.points_mut().wake(v.index());
        self.mark(v, packed.points());
        packed.unpark_around(ledger, mesh, v);
    }

    /// Ends a tick: wakes the vertices that are disturbed, and puts those to sleep that have long been quiet. `by` is
    /// how targets narrow.
    pub fn tick(
        &mut self,
        packed: &mut PackedConstraints,
        ledger: &mut Ledger,
        mesh: &FilmMesh,
        loose: &LoosePieces,
        by: Narrowing,
        by_grain: bool,
    ) {
        packed.points_mut().sort();
        if by_grain && self.announced.is_empty() {
            self.announced.clone_from(&self.positions);
        } else if !by_grain {
            self.announced.clear();
        }
        self.find_disturbed(packed.points(), mesh, loose);
        let disturbed = std::mem::take(&mut self.disturbed);
        for &v in &disturbed {
            self.wake(packed, ledger, mesh, v);
        }
        self.disturbed = disturbed;
        self.find_sleepers(packed, ledger, mesh, loose, by);
        self.put_to_sleep(packed, ledger, &mesh.topology);
        packed.compact(ledger, &mesh.topology);
    }

    /// Notes how far the vertices that are awake have moved since the last tick, and finds those asleep beside them
    /// that are to be woken.
    fn find_disturbed(&mut self, points: &Points, mesh: &FilmMesh, loose: &LoosePieces) {
        let edge = mesh.geometry.mean_edge;
        let by_grain = !self.announced.is_empty();
        let least = if by_grain { QUIET_BY_GRAIN * edge } else { QUIET * edge };
        let far = DISTURBED * edge;
        self.disturbed.clear();
        for v in points.awake() {
            let position = points.position(v);
            let way = position - self.positions[v];
            let quiet = way.length_squared() < least * least;
            self.positions[v] = position;
            self.quiet[v] = if quiet { self.quiet[v].saturating_add(1) } else { 0 };
            let disturbs = match self.announced.get_mut(v) {
                Some(announced) if position.distance_squared(*announced) > far * far => {
                    *announced = position;
                    true
                }
                Some(_) => false,
                None => !quiet,
            };
            if disturbs && points.asleep_count() > 0 {
                for_neighbours(&mesh.topology, VertexId::new(v), |n| {
                    if points.motion(n.index()) == Motion::Asleep {
                        self.disturbed.push(n);
                    }
                });
            }
        }
        for piece in loose.iter() {
            let sleeps = |&&v: &&VertexId| points.motion(v.index()) == Motion::Asleep;
            let asleep = piece.vertices.iter().filter(sleeps).count();
            if (1..piece.vertices.len()).contains(&asleep) {
                self.disturbed.extend(piece.vertices.iter().filter(sleeps));
            }
        }
    }

    /// Finds the vertices that fall asleep: those of loose pieces, then the others.
    fn find_sleepers(
        &mut self,
        packed: &PackedConstraints,
        ledger: &Ledger,
        mesh: &FilmMesh,
        loose: &LoosePieces,
        by: Narrowing,
    ) {
        let topology = &mesh.topology;
        let mut sleepers = std::mem::take(&mut self.sleepers);
        sleepers.clear();
        for piece in loose.iter() {
            piece.vertices.iter().for_each(|v| self.loose[v.index()] = true);
            let awake = piece.vertices.iter().any(|&v| packed.motion(v) == Motion::Awake);
            let may_sleep = |&v: &VertexId| self.may_sleep(packed, ledger, topology, v, by);
            if awake && piece.vertices.iter().all(may_sleep) {
                sleepers.extend_from_slice(piece.vertices);
            }
        }
        let held = || packed.points().awake().map(VertexId::new).filter(|v| !self.loose[v.index()]);
        let by_grain = !self.announced.is_empty();
        let may_all = by_grain && held().all(|v| self.is_quiet(v));
        let flat = FLAT * mesh.geometry.mean_edge;
        let lies_flat = |v: VertexId| {
            let rest = mesh.geometry.rest_positions[v.index()];
            packed.points().position(v.index()).distance_squared(rest) < flat * flat
        };
        let before = sleepers.len();
        sleepers.extend(
            held()
                .filter(|&v| !by_grain || may_all || self.is_quiet(v) && lies_flat(v))
                .filter(|&v| self.may_sleep(packed, ledger, topology, v, by)),
        );
        if may_all && sleepers.len() - before < held().count() {
            // A target still narrows somewhere.
            let mut flat = sleepers.split_off(before);
            flat.retain(|&v| lies_flat(v));
            sleepers.append(&mut flat);
        }
        loose.iter().flat_map(|piece| piece.vertices).for_each(|v| self.loose[v.index()] = false);
        self.sleepers = sleepers;
    }

    /// Puts the sleepers to sleep, and parks the constraints that nothing moves any more.
    fn put_to_sleep(&mut self, packed: &mut PackedConstraints, ledger: &mut Ledger, topology: &Topology) {
        self.stale.clear();
        for &v in &self.sleepers {
            packed.points_mut().sleep(v.index());
            for h in topology.fan(v) {
                let edges = [h, h.next(), h.previous()];
                self.stale.extend(edges);
                self.stale.extend(edges.into_iter().filter_map(|h| topology.bound_twin(h)));
            }
        }
        if !self.sleepers.is_empty() {
            packed.points_mut().settle();
        }
        for &h in &self.stale {
            packed.park(ledger, topology, h);
        }
    }

    /// Appends all that decides who sleeps.
    pub fn write_state(&self, to: &mut Words) {
        // Buffers mean nothing between ticks.
        let Self { positions, quiet, announced, loose: _, sleepers: _, stale: _, disturbed: _ } = self;
        to.vectors(positions);
        to.list(quiet.iter().map(|&ticks| u32::from(ticks)));
        if !announced.is_empty() {
            to.vectors(announced);
        }
    }

    fn is_quiet(&self, v: VertexId) -> bool {
        self.quiet[v.index()] >= TICKS
    }

    fn may_sleep(
        &self,
        packed: &PackedConstraints,
        ledger: &Ledger,
        topology: &Topology,
        v: VertexId,
        by: Narrowing,
    ) -> bool {
        let mut still = self.is_quiet(v);
        if !still {
            return false;
        }
        for_neighbours(topology, v, |n| still &= packed.motion(n) != Motion::Awake || self.is_quiet(n));
        let narrows = |h: HalfEdgeId| packed.is_narrowing(ledger, topology, topology.edge(h), by);
        still && topology.fan(v).all(|h| ![h, h.next(), h.previous()].into_iter().any(narrows))
    }
}

/// Calls `with` for the vertices that share a constraint with `v`.
fn for_neighbours(topology: &Topology, v: VertexId, mut with: impl FnMut(VertexId)) {
    for h in topology.fan(v) {
        with(topology.target(h));
        with(topology.apex(h));
        if let Some(twin) = topology.bound_twin(h.next()) {
            with(topology.apex(twin));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::words::assert_each_counts;

    #[test]
    fn every_field_of_sleep_counts() {
        let changes: [fn(&mut SleepMarks); 3] = [
            |sleep| sleep.positions[1] = Vec3::X,
            |sleep| sleep.quiet[1] = 1,
            |sleep| sleep.announced = vec![Vec3::X; 2],
        ];
        assert_each_counts(&SleepMarks::new(2), SleepMarks::write_state, &changes);
    }
}
