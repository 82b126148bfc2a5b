//! Splits edges.

use std::{cmp::Reverse, ops::Range};

use bevy_math::Vec3;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::flip::flip_edges;
use super::project::project;
use super::work_mesh::{SurfacePoint, WorkMesh, count_edit};
use crate::{
    film::{HalfEdgeId, VertexId},
    rest::{LIGHT_PIECE, PIECE, Rest, pieces, sort_by_number},
};

/// Least share of a face's area that each half must have after a split.
const LEAST_HALF: f32 = 0.1;

/// Width of the range around the middle of an edge in which the cut is drawn, as a share of the edge. Cuts in the
/// middle would make a grid of a flat quad.
const SPREAD: f32 = 0.4;

/// Limits above which edges are split.
#[derive(Clone, Copy, Debug)]
pub(super) struct SplitLimits {
    /// Edges longer than this are split.
    pub longest: f32,
    /// Edges whose middle is further from the surface than this are split too, if they are longer than `shortest`.
    pub stray: f32,
    /// Edges up to this length are not split because of `stray`.
    pub shortest: f32,
    /// Number of faces at which splitting stops.
    pub most_faces: usize,
}

/// Splits edges that are too long, the longest first, until none is left. Flips between the rounds keep needles from
/// being split into more and more of them. Then splits edges that cut through a bend of
/// the surface, once.
pub(super) async fn split_edges(
    mesh: &mut WorkMesh<'_>,
    limits: SplitLimits,
    rng: &mut ChaCha8Rng,
    rest: &mut impl Rest,
) {
    // Each round about halves the longest edges, so 40 rounds are more than any mesh needs.
    for _ in 0..40 {
        let long = longer_than(mesh, limits.longest, 0..mesh.topology.half_edge_slots());
        if !split_all(mesh, long, limits.longest, limits.most_faces, rng, rest).await {
            break;
        }
        flip_edges(mesh, rest).await;
    }
    if limits.stray == f32::MAX {
        return;
    }
    let mut straying = Vec::new();
    for piece in pieces(mesh.topology.half_edge_slots(), LIGHT_PIECE) {
        let long = longer_than(mesh, limits.shortest, piece);
        straying.extend(long.into_iter().filter(|edge| mesh.stray(edge.1) > limits.stray));
        rest.rest().await;
    }
    split_all(mesh, straying, limits.shortest, limits.most_faces, rng, rest).await;
}

/// Splits edges longer than `least`, the longest first, until there are `count` faces.
pub(super) async fn split_longest_edges(
    mesh: &mut WorkMesh<'_>,
    least: f32,
    count: usize,
    rng: &mut ChaCha8Rng,
    rest: &mut impl Rest,
) {
    let long = longer_than(mesh, least, 0..mesh.topology.half_edge_slots());
    split_all(mesh, long, least, count, rng, rest).await;
}

/// Edge after its length, the longest first. The bits of lengths are in the order of lengths, as none is negative.
type Long = (Reverse<u32>, HalfEdgeId);

/// Returns those of the edges that are longer than `least`.
fn longer_than(mesh: &WorkMesh, least: f32, half_edges: Range<usize>) -> Vec<Long> {
    let edges = mesh.topology.edges_in(half_edges).map(|h| (mesh.sized_length(h), h));
    edges.filter(|&(length, _)| length > least).map(|(length, h)| (Reverse(length.to_bits()), h)).collect()
}

/// Splits the edges that are still longer than `least` when their turn comes. Returns whether any edge was split.
async fn split_all(
    mesh: &mut WorkMesh<'_>,
    edges: Vec<Long>,
    least: f32,
    most_faces: usize,
    rng: &mut ChaCha8Rng,
    rest: &mut impl Rest,
) -> bool {
    rest.rest().await;
    let edges = sort_by_number(edges, |edge| !edge.0.0, rest).await;
    let mut any = false;
    for (i, (_, h)) in edges.into_iter().enumerate() {
        if i.is_multiple_of(PIECE) {
            rest.rest().await;
        }
        if mesh.topology.live_faces() >= most_faces {
            break;
        }
        if mesh.sized_length(h) > least {
            let cut = 0.5 + SPREAD * (rng.random::<f32>() - 0.5);
            any |= split(mesh, h, cut).is_some();
        }
    }
    any
}

/// Splits an edge at about the share `cut` of its length and returns the new vertex. Half-edge `h` keeps its origin and
/// ends at the new vertex. The faces on both sides keep their ids, and one face is added on each side.
///
/// Returns `None`, and changes nothing, if the edge is too short, or if the surface under it is folded so that the new
/// faces would be folded too.
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
    count_edit();
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

/// Returns the point of the surface under a point of an edge, if any leaves proper faces. A walk may be caught in a
/// fold of the surface, so it is tried from all four corners around the edge, and the nearest result is used.
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

/// Returns whether the face of `h`, cut at the point `m` near `h`, falls into two halves that face the same way as the
/// face and are not too small.
fn halves_stand(mesh: &WorkMesh, h: HalfEdgeId, m: Vec3) -> bool {
    let [a, b, c] = [h, h.next(), h.previous()].map(|h| mesh.position(mesh.topology.origin(h)));
    let whole = (b - a).cross(c - a);
    [(m - a).cross(c - a), (b - m).cross(c - m)]
        .into_iter()
        .all(|half| half.dot(whole) > LEAST_HALF * whole.length_squared() && half.dot(whole) > 0.0)
}

/// Cuts the face of `h` from the new vertex `m` on `h` to the opposite corner. Returns the half-edge from `m` to the
/// old target of `h`.
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
