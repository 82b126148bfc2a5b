//! Which film vertices lie at one place: an original vertex and its duplicates.

use bevy_math::Vec3;

use crate::film::{FilmMesh, HalfEdgeId, Topology, VertexId};

/// Chains of the film vertices of each original vertex, and the original's fan at rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Duplicates {
    /// Next copy after each film vertex; the chain of an original vertex starts at itself.
    next: Vec<VertexId>,
    /// First half-edge of the fan at rest of each original vertex; `NONE` for one without faces.
    rest_fans: Vec<HalfEdgeId>,
}

impl Duplicates {
    pub fn new(topology: &Topology) -> Self {
        Self {
            next: vec![VertexId::NONE; topology.vertex_count()],
            rest_fans: topology.all_vertices().map(|v| topology.fan(v).next().unwrap_or(HalfEdgeId::NONE)).collect(),
        }
    }

    /// Number of film vertices known.
    pub fn len(&self) -> usize {
        self.next.len()
    }

    /// Appends the duplicate of a vertex whose original is `original`.
    pub fn append(&mut self, original: VertexId) {
        let duplicate = VertexId::new(self.next.len());
        self.next.push(self.next[original.index()]);
        self.next[original.index()] = duplicate;
    }

    /// All film vertices of `original`, itself first.
    pub fn of(&self, original: VertexId) -> impl Iterator<Item = VertexId> + '_ {
        std::iter::successors(Some(original), |&v| self.after(v))
    }

    /// The copy after `v` in its chain.
    pub fn after(&self, v: VertexId) -> Option<VertexId> {
        self.next[v.index()].get()
    }

    /// Whether `original` has been split.
    pub fn is_split(&self, original: VertexId) -> bool {
        self.next[original.index()] != VertexId::NONE
    }

    /// The half-edges around `original` at rest.
    pub fn rest_fan<'a>(&self, topology: &'a Topology, original: VertexId) -> impl Iterator<Item = HalfEdgeId> + 'a {
        topology.rest_fan(self.rest_fans[original.index()])
    }

    /// Whether the faces around `original` went all the way round at rest.
    pub fn is_inner(&self, topology: &Topology, original: VertexId) -> bool {
        // An open fan at rest starts where it is open.
        self.rest_fans[original.index()].get().is_some_and(|first| topology.rest_twin(first).is_some())
    }

    /// The copy of `original` whose faces lie lowest along `pull` (at a tie the lowest vertex); `None` where no face
    /// is left.
    pub fn lowest(&self, mesh: &FilmMesh, original: VertexId, pull: Vec3) -> Option<VertexId> {
        let mut lowest: Option<(f32, VertexId)> = None;
        for v in self.of(original).filter(|&v| mesh.topology.has_faces(v)) {
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
