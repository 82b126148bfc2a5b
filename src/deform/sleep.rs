//! Sleep: vertices that would move too little to be seen are not looked at.
//!
//! Looked at once a tick. A vertex is quiet in a tick in which it moved less than [`QUIET`] of a mean edge, so that what a
//! sleeping vertex misses in a whole unit of age is too little to be seen. It falls asleep once it and all vertices that share
//! a constraint with it have been quiet for [`TICKS`] ticks and no target there narrows any more. It wakes when one of these vertices moves
//! more than that, or anything fractures beside it.
//!
//! A loose piece sleeps as a whole or not at all: a part of it held fast would push the rest about without end.

use bevy_math::Vec3;

use super::{
    FilmConstraints,
    packed::{Motion, Points},
};
use crate::film::{FaceId, FilmMesh, HalfEdgeId, LoosePieces, Topology, VertexId};

/// How far a quiet vertex moves in a tick at most, in mean edges.
pub(super) const QUIET: f32 = 1e-4;
/// Ticks that a vertex must have been quiet.
const TICKS: u8 = 2;

/// Where vertices were at the last tick, and for how many ticks they have been quiet.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct SleepMarks {
    places: Vec<Vec3>,
    quiet: Vec<u8>,
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
    pub fn new(vertices: usize) -> Self {
        Self {
            places: vec![Vec3::ZERO; vertices],
            quiet: vec![0; vertices],
            loose: vec![false; vertices],
            ..Self::default()
        }
    }

    /// A copy of `kept` was appended.
    pub fn append(&mut self, kept: usize) {
        self.places.push(self.places[kept]);
        self.quiet.push(0);
        self.loose.push(false);
    }

    /// `v` has begun to move from where it is.
    pub fn mark(&mut self, v: usize, points: &Points) {
        self.places[v] = points.position(v);
        self.quiet[v] = 0;
    }

    fn is_quiet(&self, v: VertexId) -> bool {
        self.quiet[v.index()] >= TICKS
    }
}

impl FilmConstraints {
    /// A tick: puts to sleep what has come to rest, and wakes what is disturbed. `limit` is that of the targets, in radians.
    pub(super) fn put_to_sleep(&mut self, mesh: &FilmMesh, loose: &LoosePieces, limit: f32) {
        let topology = &mesh.topology;
        self.points.sort();
        let mut rest = std::mem::take(&mut self.rest);
        let least = QUIET * mesh.geometry.mean_edge;
        rest.disturbed.clear();
        for v in self.points.awake() {
            let place = self.points.position(v);
            let quiet = place.distance_squared(rest.places[v]) < least * least;
            rest.places[v] = place;
            rest.quiet[v] = if quiet { rest.quiet[v].saturating_add(1) } else { 0 };
            if !quiet && self.points.asleep_count() > 0 {
                for_neighbours(topology, VertexId::new(v), |n| {
                    if self.points.motion(n.index()) == Motion::Asleep {
                        rest.disturbed.push(n);
                    }
                });
            }
        }
        for piece in loose.iter() {
            let sleeps = |&&v: &&VertexId| self.motion(v) == Motion::Asleep;
            let asleep = piece.vertices.iter().filter(sleeps).count();
            if (1..piece.vertices.len()).contains(&asleep) {
                rest.disturbed.extend(piece.vertices.iter().filter(sleeps));
            }
        }
        self.rest = rest;
        let disturbed = std::mem::take(&mut self.rest.disturbed);
        for &v in &disturbed {
            self.wake(mesh, v);
        }
        self.rest.disturbed = disturbed;
        let (mut sleepers, mut stale) = (std::mem::take(&mut self.rest.sleepers), std::mem::take(&mut self.rest.stale));
        sleepers.clear();
        for piece in loose.iter() {
            piece.vertices.iter().for_each(|v| self.rest.loose[v.index()] = true);
            let awake = piece.vertices.iter().any(|&v| self.motion(v) == Motion::Awake);
            let quiet = |&v: &VertexId| self.rest.is_quiet(v) && self.may_sleep(topology, v, limit);
            if awake && piece.vertices.iter().all(quiet) {
                sleepers.extend_from_slice(piece.vertices);
            }
        }
        let held = self.points.awake().map(VertexId::new).filter(|v| !self.rest.loose[v.index()]);
        sleepers.extend(held.filter(|&v| self.rest.is_quiet(v) && self.may_sleep(topology, v, limit)));
        loose.iter().flat_map(|piece| piece.vertices).for_each(|v| self.rest.loose[v.index()] = false);
        stale.clear();
        for &v in &sleepers {
            self.points.rest(v.index());
            for h in topology.fan(v) {
                let edges = [h, h.next(), h.previous()];
                stale.extend(edges);
                stale.extend(edges.into_iter().filter_map(|h| topology.bound_twin(h)));
            }
        }
        if !sleepers.is_empty() {
            self.points.settle();
        }
        for &h in &stale {
            self.park(topology, h);
        }
        (self.rest.sleepers, self.rest.stale) = (sleepers, stale);
        self.compact(topology);
    }

    fn may_sleep(&self, topology: &Topology, v: VertexId, limit: f32) -> bool {
        let mut still = true;
        for_neighbours(topology, v, |n| {
            still &= self.motion(n) != Motion::Awake || self.rest.is_quiet(n);
        });
        still
            && topology.fan(v).all(|h| {
                [h, h.next(), h.previous()].into_iter().all(|h| !self.is_narrowing(topology, topology.edge(h), limit))
            })
    }

    /// Takes the corners of removed faces that have no other face off the list of what moves.
    pub(super) fn forget(&mut self, topology: &Topology, removed: &[FaceId]) {
        for v in removed.iter().flat_map(|&f| topology.corners(f)).filter(|&v| !topology.has_faces(v)) {
            self.points.leave(v.index());
        }
        self.points.settle();
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
