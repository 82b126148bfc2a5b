//! Where run-off goes: the ways from every vertex of film and metal, in the order of their depth.

use bevy_math::Vec3;

use super::{
    duplicates::Duplicates,
    outflow::{Outflow, Ring},
};
use crate::film::{FilmMesh, VertexId};

/// A change of pull (its direction and strength) below this leaves the ways as they are.
const SAME_PULL: f32 = 1e-3;

/// The ways of run-off. Each is found when it is first needed and kept until connectivity there or the pull changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Flow {
    /// Gravity and wind that the ways were found for; zero before there is any.
    pub pull: Vec3,
    /// Sideways spread that the ways were found for, in metres after one metre.
    spread: f32,
    /// Share that drops into cracks that the ways were found for.
    into_cracks: f32,
    /// Original vertices by depth along the pull. Run-off goes to strictly deeper ones only, so that one pass in this
    /// order takes it all the way down.
    order: Vec<u32>,
    /// Place of each original vertex in the order.
    ranks: Vec<u32>,
    /// One bit a place in the order: whether there is anything to be done.
    awake: Vec<u64>,
    /// Ways from each film vertex.
    film: Vec<Outflow>,
    /// Ways from the metal under each original vertex.
    metal: Vec<Outflow>,
    /// Lowest copy of each original vertex that has been split; `NONE` where it is not known yet.
    lowest: Vec<VertexId>,
    ring: Ring,
}

impl Flow {
    pub fn new(vertices: usize) -> Self {
        Self {
            order: (0..vertices as u32).collect(),
            ranks: (0..vertices as u32).collect(),
            awake: vec![0; vertices.div_ceil(64)],
            film: vec![Outflow::STALE; vertices],
            metal: vec![Outflow::STALE; vertices],
            lowest: vec![VertexId::NONE; vertices],
            ..Self::default()
        }
    }

    /// A duplicate was appended.
    pub fn append(&mut self) {
        self.film.push(Outflow::STALE);
    }

    /// Connectivity at `original` changed.
    pub fn stale(&mut self, duplicates: &Duplicates, original: VertexId) {
        for v in duplicates.of(original) {
            self.film[v.index()] = Outflow::STALE;
        }
        self.metal[original.index()] = Outflow::STALE;
        self.lowest[original.index()] = VertexId::NONE;
    }

    /// Forgets all ways if the pull or how it is followed has changed, and sorts the vertices anew.
    pub fn follow(&mut self, mesh: &FilmMesh, pull: Vec3, spread: f32, into_cracks: f32) {
        let same = self.pull.distance_squared(pull) <= SAME_PULL * SAME_PULL;
        if same && self.spread == spread && self.into_cracks == into_cracks {
            return;
        }
        (self.spread, self.into_cracks) = (spread, into_cracks);
        self.film.fill(Outflow::STALE);
        self.metal.fill(Outflow::STALE);
        self.lowest.fill(VertexId::NONE);
        if same {
            return;
        }
        self.pull = pull;
        let awake: Vec<u32> = self.order.iter().copied().filter(|&v| self.is_awake(VertexId(v))).collect();
        let rest = &mesh.geometry.rest_positions;
        self.order.sort_unstable_by(|&a, &b| {
            let depth = |v: u32| rest[v as usize].dot(pull);
            depth(a).total_cmp(&depth(b)).then(a.cmp(&b))
        });
        for (rank, &v) in self.order.iter().enumerate() {
            self.ranks[v as usize] = rank as u32;
        }
        self.awake.fill(0);
        for v in awake {
            self.wake(VertexId(v));
        }
    }

    /// Whether there may be run-off at `original`.
    fn is_awake(&self, original: VertexId) -> bool {
        let rank = self.ranks[original.index()];
        self.awake[rank as usize / 64] & (1 << (rank % 64)) != 0
    }

    /// There is run-off at `original`.
    pub fn wake(&mut self, original: VertexId) {
        let rank = self.ranks[original.index()];
        self.awake[rank as usize / 64] |= 1 << (rank % 64);
    }

    /// There is none any more.
    pub fn rest(&mut self, original: VertexId) {
        let rank = self.ranks[original.index()];
        self.awake[rank as usize / 64] &= !(1 << (rank % 64));
    }

    /// Whether there is any at all.
    pub fn is_still(&self) -> bool {
        self.awake.iter().all(|&word| word == 0)
    }

    /// The first awake vertex from place `rank` on, and its place. Vertices that wake deeper down while a pass is
    /// under way are met in the same pass.
    pub fn next_awake(&self, rank: usize) -> Option<(usize, VertexId)> {
        let mut word = rank / 64;
        let mut bits = self.awake.get(word)? & (u64::MAX << (rank % 64));
        while bits == 0 {
            word += 1;
            bits = *self.awake.get(word)?;
        }
        let rank = word * 64 + bits.trailing_zeros() as usize;
        Some((rank, VertexId(self.order[rank])))
    }

    /// Number of places in the order.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// The vertex at place `rank` of the order.
    pub fn at(&self, rank: usize) -> Option<VertexId> {
        self.order.get(rank).map(|&v| VertexId(v))
    }

    /// The lowest of the duplicates of `original` along the pull; `None` where no face is left.
    pub fn lowest(&mut self, mesh: &FilmMesh, duplicates: &Duplicates, original: VertexId) -> Option<VertexId> {
        let known = &mut self.lowest[original.index()];
        if *known == VertexId::NONE {
            *known = duplicates.lowest(mesh, original, self.pull)?;
        }
        Some(*known)
    }

    /// Ways from film vertex `v`, a copy of `original`.
    pub fn film_way(&mut self, mesh: &FilmMesh, duplicates: &Duplicates, original: VertexId, v: VertexId) -> Outflow {
        if self.film[v.index()].is_stale() {
            let way = (self.pull, self.spread, self.into_cracks);
            self.film[v.index()] = Outflow::of_film(mesh, duplicates, original, v, way, &mut self.ring);
        }
        self.film[v.index()]
    }

    /// Ways from the metal under `original`.
    pub fn metal_way(&mut self, mesh: &FilmMesh, duplicates: &Duplicates, original: VertexId) -> Outflow {
        if self.metal[original.index()].is_stale() {
            let way = (self.pull, self.spread, self.into_cracks);
            self.metal[original.index()] = Outflow::of_metal(mesh, duplicates, original, way, &mut self.ring);
        }
        self.metal[original.index()]
    }
}
