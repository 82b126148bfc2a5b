//! Lists the film vertices that lie at one place at rest: an original vertex and its duplicates.

use bevy_math::Vec3;

use crate::film::{FilmMesh, HalfEdgeId, Topology, VertexId, words::Words};

/// Film vertices of each original vertex, and its fan at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Duplicates {
    /// Next vertex in the chain of each film vertex, or `NONE` at its end. The chain of an original vertex starts at
    /// itself and goes on with its duplicates.
    next: Vec<VertexId>,
    /// First half-edge of the fan at rest of each original vertex; `NONE` for a vertex without faces.
    rest_fans: Vec<HalfEdgeId>,
}

impl Duplicates {
    /// Creates the chains of a fresh film, which has no duplicates.
    pub fn new(topology: &Topology) -> Self {
        Self {
            next: vec![VertexId::NONE; topology.vertex_count()],
            rest_fans: topology.all_vertices().map(|v| topology.fan(v).next().unwrap_or(HalfEdgeId::NONE)).collect(),
        }
    }

    /// Appends the chains of duplicates.
    pub fn write_state(&self, to: &mut Words) {
        // The fans at rest follow from the film.
        let Self { next, rest_fans: _ } = self;
        to.list(next.iter().map(|v| v.0));
    }

    /// Returns the number of film vertices, duplicates included.
    pub fn len(&self) -> usize {
        self.next.len()
    }

    /// Appends a duplicate of `original`.
    pub fn append(&mut self, original: VertexId) {
        let duplicate = VertexId::new(self.next.len());
        self.next.push(self.next[original.index()]);
        self.next[original.index()] = duplicate;
    }

    /// Returns all film vertices of `original`, itself first.
    pub fn of(&self, original: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        std::iter::successors(Some(original), |&v| self.after(v))
    }

    /// Returns the vertex after `v` in its chain.
    pub fn after(&self, v: VertexId) -> Option<VertexId> {
        self.next[v.index()].get()
    }

    /// Returns whether `original` has duplicates.
    pub fn is_split(&self, original: VertexId) -> bool {
        self.next[original.index()] != VertexId::NONE
    }

    /// Returns the half-edges around `original` as they were at rest.
    pub fn rest_fan<'a>(&self, topology: &'a Topology, original: VertexId) -> impl Iterator<Item = HalfEdgeId> + 'a {
        topology.rest_fan(self.rest_fans[original.index()])
    }

    /// Returns whether the faces around `original` formed a closed ring at rest.
    pub fn is_inner(&self, topology: &Topology, original: VertexId) -> bool {
        // An open fan starts at the border.
        self.rest_fans[original.index()].get().is_some_and(|first| topology.rest_twin(first).is_some())
    }

    /// Returns what [`Duplicates::lowest`] does. `known` holds the answers so far, and takes this one: one for each
    /// original vertex, `NONE` where it is not known.
    pub fn lowest_known(
        &self,
        mesh: &FilmMesh,
        original: VertexId,
        pull: Vec3,
        known: &mut [VertexId],
    ) -> Option<VertexId> {
        let known = &mut known[original.index()];
        if *known == VertexId::NONE {
            *known = self.lowest(mesh, original, pull)?;
        }
        Some(*known)
    }

    /// Returns the film vertex of `original` whose faces lie lowest along `pull` on average (at a tie the one with the
    /// lowest id), or `None` if no face is left.
    pub fn lowest(&self, mesh: &FilmMesh, original: VertexId, pull: Vec3) -> Option<VertexId> {
        let with_faces = || self.of(original).filter(|&v| mesh.topology.has_faces(v));
        let mut all = with_faces();
        let only = all.next()?;
        if all.next().is_none() {
            return Some(only);
        }
        let mut lowest: Option<(f32, VertexId)> = None;
        for v in with_faces() {
            let (mut depth, mut faces) = (0.0, 0.0);
            for h in mesh.topology.fan(v) {
                depth += mesh.geometry.rest_centroid(&mesh.topology, h.face()).dot(pull);
                faces += 1.0;
            }
            let depth = depth / faces;
            if lowest.is_none_or(|(best, at)| depth > best || (depth == best && v < at)) {
                lowest = Some((depth, v));
            }
        }
        lowest.map(|(_, v)| v)
    }
}
