//! Tells the creases of a shape from the noise of a scan.
//!
//! Sharp edges between faces smaller than the film's are creases only if they are sharp at the film's scale too and
//! long enough to see. The film runs smoothly across the edges that are dropped here.

use bevy_math::Vec3;

use super::features::{CREASE, Features};
use super::topology::Topology;
use crate::{
    film::{FaceId, HalfEdgeId, VertexId},
    rest::{PIECE, Rest},
};

/// Radius over which the mean normals of the two sides of a crease are taken, in target edges.
const WRINKLE_RADIUS: f32 = 1.0;
/// Largest number of faces of a side of which the mean normal is taken.
const WRINKLE_FACES: usize = 400;
/// Number of doubtful edges that make a piece of the work: each has two sides of very many faces.
const WRINKLES: usize = PIECE / 4;
/// Length below which a branch that ends in a smooth region is noise, in target edges.
const SHORTEST_BRANCH: f32 = 1.5;
/// Length below which connected creases with a free end are noise, in target edges.
const SHORTEST_CREASE: f32 = 4.0;
/// Length below which closed creases (the rims of small holes and bosses) are noise, in target edges.
const SHORTEST_RIM: f32 = 1.0;
/// Number of rounds. A wrinkle that is dropped lets the sides of its neighbours reach further.
const ROUNDS: usize = 4;

/// Makes the doubtful edges that are noise no features.
pub(super) async fn drop_noise(
    features: &mut Features,
    topology: &Topology,
    positions: &[Vec3],
    target: f32,
    rest: &mut impl Rest,
) {
    for _ in 0..ROUNDS {
        drop_wrinkles(features, topology, positions, target, rest).await;
        drop_short_branches(features, topology, positions, SHORTEST_BRANCH * target);
        rest.rest().await;
    }
    drop_short_creases(features, topology, positions, target);
}

/// Returns the number of feature edges at each vertex.
fn degrees(features: &Features, topology: &Topology) -> Vec<u32> {
    let mut degrees = vec![0; topology.vertex_slots()];
    for h in topology.edges().filter(|&h| features.is_kept(h)) {
        degrees[topology.origin(h).index()] += 1;
        degrees[topology.target(h).index()] += 1;
    }
    degrees
}

/// Drops creases that are sharp only at the scale of a scan's noise: the mean normals of their two sides, taken over
/// about the length `target`, differ by less than the crease angle. A side does not extend across another feature.
async fn drop_wrinkles(
    features: &mut Features,
    topology: &Topology,
    positions: &[Vec3],
    target: f32,
    rest: &mut impl Rest,
) {
    let radius = WRINKLE_RADIUS * target;
    let mut side = Vec::new();
    let mut stamps = vec![0_u32; topology.face_slots()];
    let mut stamp = 0;
    let mut normal_of_side = |features: &Features, h: HalfEdgeId| {
        let middle = positions[topology.origin(h).index()].midpoint(positions[topology.target(h).index()]);
        let corners = |f: FaceId| topology.corners(f).map(|v| positions[v.index()]);
        stamp += 1;
        stamps[h.face().index()] = stamp;
        side.clear();
        side.push(h.face());
        let mut next = 0;
        let mut normal = Vec3::ZERO;
        while let Some(&f) = side.get(next) {
            next += 1;
            let [a, b, c] = corners(f);
            normal += (b - a).cross(c - a);
            for e in f.half_edges().into_iter().filter(|&e| !features.is_kept(e)) {
                if let Some(g) = topology.twin(e).map(HalfEdgeId::face)
                    && side.len() < WRINKLE_FACES
                    && stamps[g.index()] != stamp
                    && corners(g).iter().sum::<Vec3>().distance(3.0 * middle) < 3.0 * radius
                {
                    stamps[g.index()] = stamp;
                    side.push(g);
                }
            }
        }
        normal.normalize_or_zero()
    };
    let doubtful: Vec<HalfEdgeId> = topology.edges().filter(|&h| features.is_doubtful(h)).collect();
    let mut wrinkles = Vec::new();
    for piece in doubtful.chunks(WRINKLES) {
        wrinkles.extend(piece.iter().copied().filter(|&h| {
            topology.twin(h).is_some_and(|t| normal_of_side(features, h).dot(normal_of_side(features, t)) > CREASE)
        }));
        rest.rest().await;
    }
    for h in wrinkles {
        features.free(topology, h);
    }
}

/// Drops crease branches that end freely before `shortest`.
fn drop_short_branches(features: &mut Features, topology: &Topology, positions: &[Vec3], shortest: f32) {
    let mut degrees = degrees(features, topology);
    let ends: Vec<VertexId> = (0..degrees.len()).map(VertexId::new).filter(|v| degrees[v.index()] == 1).collect();
    for end in ends {
        let mut branch = Vec::new();
        let mut length = 0.0;
        let mut at = end;
        while length < shortest && (at == end || degrees[at.index()] == 2) {
            // Creases have faces on both sides, so every one at the vertex has a half-edge leaving it.
            let onward = topology
                .ring(at)
                .find(|&h| features.is_doubtful(h) && branch.last().is_none_or(|&b| topology.twin(h) != Some(b)));
            let Some(h) = onward else { break };
            branch.push(h);
            length += positions[at.index()].distance(positions[topology.target(h).index()]);
            at = topology.target(h);
        }
        // A branch that runs into another feature is dropped. One with two free ends is a crease of its own, which
        // `drop_short_creases` judges.
        if length < shortest && degrees[at.index()] > 2 {
            for h in branch {
                degrees[topology.origin(h).index()] -= 1;
                degrees[topology.target(h).index()] -= 1;
                features.free(topology, h);
            }
        }
    }
}

/// Drops short creases as a whole.
fn drop_short_creases(features: &mut Features, topology: &Topology, positions: &[Vec3], target: f32) {
    let mut sets = Sets::new(topology.vertex_slots());
    let degrees = degrees(features, topology);
    let creases: Vec<HalfEdgeId> = topology.edges().filter(|&h| features.is_doubtful(h)).collect();
    for &h in &creases {
        sets.join(topology.origin(h), topology.target(h));
    }
    let mut lengths = vec![0.0; topology.vertex_slots()];
    let mut is_open = vec![false; topology.vertex_slots()];
    for &h in &creases {
        let (a, b) = (topology.origin(h), topology.target(h));
        let root = sets.root(a).index();
        lengths[root] += positions[a.index()].distance(positions[b.index()]);
        is_open[root] |= degrees[a.index()] == 1 || degrees[b.index()] == 1;
    }
    for &h in &creases {
        let root = sets.root(topology.origin(h)).index();
        let shortest = if is_open[root] { SHORTEST_CREASE } else { SHORTEST_RIM };
        if lengths[root] < shortest * target {
            features.free(topology, h);
        }
    }
}

/// Disjoint sets of vertices.
struct Sets {
    parents: Vec<VertexId>,
}

impl Sets {
    fn new(count: usize) -> Self {
        Self { parents: (0..count).map(VertexId::new).collect() }
    }

    fn root(&mut self, mut v: VertexId) -> VertexId {
        while self.parents[v.index()] != v {
            let grandparent = self.parents[self.parents[v.index()].index()];
            self.parents[v.index()] = grandparent;
            v = grandparent;
        }
        v
    }

    fn join(&mut self, a: VertexId, b: VertexId) {
        let (a, b) = (self.root(a), self.root(b));
        self.parents[a.max(b).index()] = a.min(b);
    }
}
