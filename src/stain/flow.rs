//! Keeps the ways of run-off from every vertex of film and metal, and which vertices have any (VC 6.1).

use bevy_math::Vec3;

use super::{
    duplicates::Duplicates,
    outflow::{Outflow, Ring},
};
use crate::film::{FilmMesh, VertexId, words::Words};

/// Change of the pull, a vector, below which the ways are kept.
const SAME_PULL: f32 = 1e-3;

/// Wakes the places that run-off reaches, while a way is being read.
pub(super) struct Waker<'a> {
    ranks: &'a [u32],
    awake: &'a mut [u64],
}

impl Waker<'_> {
    /// Notes that there may be run-off at the place of film vertex `v`.
    #[inline]
    pub fn wake(&mut self, v: VertexId) {
        let rank = self.ranks[v.index()];
        self.awake[rank as usize / 64] |= 1 << (rank % 64);
    }
}

/// Ways of run-off on one film and its metal. The way from a vertex is computed when it is first needed and kept until
/// connectivity there or the pull changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Flow {
    /// Sum of gravity and wind that the ways were computed for; zero before the first tick.
    pub pull: Vec3,
    /// Sideways spread that the ways were computed for: the standard deviation in metres after one metre.
    pub(super) spread: f32,
    /// Share of run-off that drops into cracks that the ways were computed for.
    pub(super) into_cracks: f32,
    /// Original vertices in the order of their depth along the pull. Run-off goes to strictly deeper vertices only, so
    /// one pass in this order takes it all the way down.
    order: Vec<u32>,
    /// Place in `order` of each film vertex: that of its original.
    ranks: Vec<u32>,
    /// One bit for each place in `order`: whether there may be run-off at the vertex.
    awake: Vec<u64>,
    /// Ways from the film: those from original vertices in the order of their places, so that a pass reads them one
    /// after another, then those from duplicates.
    film: Vec<Outflow>,
    /// Way from the metal at each place in `order`.
    metal: Vec<Outflow>,
    /// Lowest film vertex of each original vertex that has been split; `NONE` where it is not known yet.
    lowest: Vec<VertexId>,
    /// Buffer of the neighbours of a vertex.
    ring: Ring,
}

impl Flow {
    /// Creates the flow of a fresh film of `vertices` vertices, without any run-off.
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

    /// Appends a duplicate of `original`.
    pub fn append(&mut self, original: VertexId) {
        self.ranks.push(self.ranks[original.index()]);
        self.film.push(Outflow::STALE);
    }

    /// Returns where the way from film vertex `v` is kept in `film`.
    fn slot(&self, v: VertexId) -> usize {
        if v.index() < self.order.len() { self.ranks[v.index()] as usize } else { v.index() }
    }

    /// Marks the ways from `original` as out of date, because connectivity there has changed.
    pub fn mark_stale(&mut self, duplicates: &Duplicates, original: VertexId) {
        for v in duplicates.of(original) {
            let slot = self.slot(v);
            self.film[slot].mark_stale();
        }
        self.metal[self.ranks[original.index()] as usize].mark_stale();
        self.lowest[original.index()] = VertexId::NONE;
    }

    /// Marks the targets of the ways from `original` as out of date, because connectivity has changed at a neighbour.
    pub fn mark_renamed(&mut self, duplicates: &Duplicates, original: VertexId) {
        for v in duplicates.of(original) {
            let slot = self.slot(v);
            self.film[slot].mark_renamed();
        }
        self.metal[self.ranks[original.index()] as usize].mark_renamed();
    }

    /// Marks all ways as out of date if the pull, the spread or the share that drops into cracks has changed. Sorts the
    /// vertices again if the pull has.
    pub fn set_pull(&mut self, mesh: &FilmMesh, pull: Vec3, spread: f32, into_cracks: f32) {
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
        for v in self.order.len()..self.ranks.len() {
            self.ranks[v] = self.ranks[mesh.topology.original(VertexId::new(v)).index()];
        }
        self.awake.fill(0);
        for v in awake {
            self.wake(VertexId(v));
        }
    }

    /// Returns whether there may be run-off at `original`.
    pub fn is_awake(&self, original: VertexId) -> bool {
        let rank = self.ranks[original.index()];
        self.awake[rank as usize / 64] & (1 << (rank % 64)) != 0
    }

    /// Notes that there may be run-off at the place of film vertex `v`.
    pub fn wake(&mut self, v: VertexId) {
        Waker { ranks: &self.ranks, awake: &mut self.awake }.wake(v);
    }

    /// Notes that there is no run-off at `original` any more.
    pub fn sleep(&mut self, original: VertexId) {
        let rank = self.ranks[original.index()];
        self.awake[rank as usize / 64] &= !(1 << (rank % 64));
    }

    /// Returns whether there is no run-off anywhere.
    pub fn is_asleep(&self) -> bool {
        self.awake.iter().all(|&word| word == 0)
    }

    /// Returns the first awake vertex from place `rank` on, and its place. Vertices further down that wake during a
    /// pass are met in the same pass.
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

    /// Appends what the ways were computed for, which is kept through small changes, and where there is run-off.
    pub fn write_state(&self, to: &mut Words) {
        // Order, ways and lowest vertices follow from these and the film's cracks.
        let Self { pull, spread, into_cracks, order: _, ranks: _, awake, film: _, metal: _, lowest: _, ring: _ } = self;
        to.vector(*pull);
        to.float(*spread);
        to.float(*into_cracks);
        to.longs(awake.iter().copied());
    }

    /// Returns the number of places in the order.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// Returns the vertex at place `rank` of the order.
    pub fn at(&self, rank: usize) -> Option<VertexId> {
        self.order.get(rank).map(|&v| VertexId(v))
    }

    /// Returns the film vertex of `original` that lies lowest along the pull, or `None` if no face is left there.
    pub fn lowest(&mut self, mesh: &FilmMesh, duplicates: &Duplicates, original: VertexId) -> Option<VertexId> {
        duplicates.lowest_known(mesh, original, self.pull, &mut self.lowest)
    }

    /// Returns the way from film vertex `v`, which is `original` or a duplicate of it, and what wakes its targets.
    #[inline]
    pub fn film_way(
        &mut self,
        mesh: &FilmMesh,
        duplicates: &Duplicates,
        original: VertexId,
        v: VertexId,
    ) -> (&Outflow, Waker<'_>) {
        let slot = self.slot(v);
        let Self { film, lowest, ring, ranks, awake, .. } = self;
        let outflow = &mut film[slot];
        if outflow.is_stale() {
            let way = (self.pull, self.spread, self.into_cracks);
            outflow.find_on_film(mesh, duplicates, lowest, original, v, way, ring);
        }
        (outflow, Waker { ranks, awake })
    }

    /// Returns the way from the metal under `original`, and what wakes its targets.
    #[inline]
    pub fn metal_way(&mut self, mesh: &FilmMesh, duplicates: &Duplicates, original: VertexId) -> (&Outflow, Waker<'_>) {
        let Self { metal, lowest, ring, ranks, awake, .. } = self;
        let outflow = &mut metal[ranks[original.index()] as usize];
        if outflow.is_stale() {
            let way = (self.pull, self.spread, self.into_cracks);
            outflow.find_on_metal(mesh, duplicates, lowest, original, way, ring);
        }
        (outflow, Waker { ranks, awake })
    }
}

#[cfg(test)]
impl crate::stain::StainFields {
    /// Forgets all ways, so that each is computed as a whole when it is next needed.
    pub(crate) fn forget_ways(&mut self) {
        self.flow.film.fill(Outflow::STALE);
        self.flow.metal.fill(Outflow::STALE);
        self.flow.lowest.fill(VertexId::NONE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::words::assert_each_counts;

    #[test]
    fn every_field_of_flow_counts() {
        let changes: [fn(&mut Flow); 4] = [
            |flow| flow.pull = Vec3::X,
            |flow| flow.spread = 0.5,
            |flow| flow.into_cracks = 0.5,
            |flow| flow.wake(VertexId(1)),
        ];
        assert_each_counts(&Flow::new(2), Flow::write_state, &changes);
    }
}
