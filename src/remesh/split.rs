//! Edge splits.

use bevy_math::Vec3;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::project::project;
use super::work_mesh::{SurfacePoint, WorkMesh};
use crate::film::{HalfEdgeId, VertexId};

/// Share of a face's area that each half must have after a split.
const LEAST_HALF: f32 = 0.1;

/// How far from the middle a cut may fall, as a share of the edge: equal halves would make a grid of a flat quad.
const SPREAD: f32 = 0.4;

/// Which edges are split, and where.
#[derive(Clone, Copy, Debug)]
pub(super) struct SplitLimits {
    /// Edges longer than this are split.
    pub longest: f32,
    /// So are those whose middle is further from the surface than this, unless shorter than `shortest`.
    pub stray: f32,
    /// See `stray`.
    pub shortest: f32,
}

/// Splits edges that are too long, the longest first, until none is left, and then once those that cut through
/// a bend of the surface.
pub(super) fn split_edges(mesh: &mut WorkMesh, limits: SplitLimits, rng: &mut ChaCha8Rng) {
    // Each round halves the longest edges: 40 are more than any finite mesh needs.
    for _ in 0..40 {
        let long = mesh.topology.edges().map(|h| (mesh.length(h), h)).filter(|&(l, _)| l > limits.longest).collect();
        if !split_all(mesh, long, limits.longest, usize::MAX, rng) {
            break;
        }
    }
    if limits.stray == f32::MAX {
        return;
    }
    let straying = mesh
        .topology
        .edges()
        .map(|h| (mesh.length(h), h))
        .filter(|&(l, h)| l > limits.shortest && mesh.stray(h) > limits.stray)
        .collect();
    split_all(mesh, straying, limits.shortest, usize::MAX, rng);
}

/// Splits edges longer than `least`, the longest first, until there are `count` faces.
pub(super) fn split_longest_edges(mesh: &mut WorkMesh, least: f32, count: usize, rng: &mut ChaCha8Rng) {
    let long = mesh.topology.edges().map(|h| (mesh.length(h), h)).filter(|&(l, _)| l > least).collect();
    split_all(mesh, long, least, count, rng);
}

/// Splits the edges that are still longer than `least` when their turn comes. Whether any was.
fn split_all(
    mesh: &mut WorkMesh,
    mut edges: Vec<(f32, HalfEdgeId)>,
    least: f32,
    most_faces: usize,
    rng: &mut ChaCha8Rng,
) -> bool {
    edges.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut any = false;
    for (_, h) in edges {
        if mesh.topology.live_faces() >= most_faces {
            break;
        }
        if mesh.length(h) > least {
            let cut = 0.5 + SPREAD * (rng.random::<f32>() - 0.5);
            any |= split(mesh, h, cut).is_some();
        }
    }
    any
}

/// Splits an edge at about the share `cut` of its length. Half-edge `h` keeps its origin and ends at the new
/// vertex; faces on both sides keep their ids and one is added on each. `None`, and nothing done, where the edge is
/// too short to be cut, or the surface under it folds so that the new faces would.
pub(super) fn split(mesh: &mut WorkMesh, h: HalfEdgeId, cut: f32) -> Option<VertexId> {
    let (a, b) = (mesh.topology.origin(h), mesh.topology.target(h));
    let (position, surface_point) = match mesh.chain(h) {
        Some(chain) => {
            let (from, to) = (mesh.arc_length(a, chain), mesh.arc_length(b, chain));
            let s = from + (to - from) * cut;
            let position = mesh.reference.chains.position(mesh.reference.positions, chain, s);
            if position == mesh.position(a) || position == mesh.position(b) {
                return None;
            }
            (position, SurfacePoint::Line { chain, s })
        }
        None => foot_of_cut(mesh, h, cut)?,
    };
    let twin = mesh.topology.twin(h);
    let m = mesh.add_vertex(position, surface_point);
    let beyond = cut_face(mesh, h, m);
    match twin {
        Some(t) => {
            let back = cut_face(mesh, t, m);
            mesh.topology.link(h, back);
            mesh.topology.link(beyond, t);
            mesh.topology.anchor(a, h);
            mesh.topology.anchor(b, t);
        }
        None => {
            mesh.topology.anchor(a, h);
            mesh.topology.anchor(b, beyond.next());
        }
    }
    mesh.topology.anchor(m, beyond);
    Some(m)
}

/// The place on the surface under a point of an edge. The walk there may be caught in a fold of the surface, so it is
/// tried from all four corners around the edge and the nearest place taken that leaves proper faces.
fn foot_of_cut(mesh: &WorkMesh, h: HalfEdgeId, cut: f32) -> Option<(Vec3, SurfacePoint)> {
    let twin = mesh.topology.twin(h);
    let [a, b] = [mesh.topology.origin(h), mesh.topology.target(h)].map(|v| mesh.position(v));
    let point = a.lerp(b, cut);
    let corners = [Some(h), Some(h.next()), Some(h.previous()), twin.map(HalfEdgeId::previous)];
    corners
        .into_iter()
        .flatten()
        .map(|corner| match mesh.surface_point(mesh.topology.origin(corner)) {
            SurfacePoint::Free(triangle) => triangle,
            _ => mesh.corner(corner).triangle,
        })
        .map(|start| project(mesh.reference, point, start))
        .filter(|foot| {
            let stands = |h| halves_stand(mesh, h, foot.position);
            stands(h) && twin.is_none_or(stands)
        })
        .min_by(|x, y| x.position.distance_squared(point).total_cmp(&y.position.distance_squared(point)))
        .map(|foot| (foot.position, SurfacePoint::Free(foot.triangle)))
}

/// Whether the two halves of the face of `h`, cut to the point `m` near `h`, face its way and have some area.
fn halves_stand(mesh: &WorkMesh, h: HalfEdgeId, m: Vec3) -> bool {
    let [a, b, c] = [h, h.next(), h.previous()].map(|h| mesh.position(mesh.topology.origin(h)));
    let whole = (b - a).cross(c - a);
    [(m - a).cross(c - a), (b - m).cross(c - m)]
        .into_iter()
        .all(|half| half.dot(whole) > LEAST_HALF * whole.length_squared() && half.dot(whole) > 0.0)
}

/// Cuts the face of `h` from the new vertex `m` on `h` to the opposite corner. Returns the half-edge from `m` on
/// to the old target.
fn cut_face(mesh: &mut WorkMesh, h: HalfEdgeId, m: VertexId) -> HalfEdgeId {
    let (n, p) = (h.next(), h.previous());
    let (b, c) = (mesh.topology.origin(n), mesh.topology.origin(p));
    let (outer, outer_chain) = (mesh.topology.twin(n), mesh.chain(n));
    let patch = mesh.patches[h.face().index()];
    let [beyond, side, inner] = mesh.add_face([m, b, c], patch).half_edges();
    mesh.topology.link_or_open(side, outer);
    mesh.set_chain(side, outer_chain);
    mesh.set_chain(beyond, mesh.chain(h));
    mesh.topology.set_origin(n, m);
    mesh.topology.link(n, inner);
    mesh.set_chain(n, None);
    beyond
}
