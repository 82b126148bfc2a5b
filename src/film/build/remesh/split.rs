//! Edge splits.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::mesh::{Place, WorkMesh};
use super::project::project;
use crate::film::{HalfEdgeId, VertexId};

/// Splits every edge longer than `longest`, the longest first, until none is left. `spread` is how far from the
/// middle a cut may fall, as a share of the edge: equal halves would make a grid of a flat quad.
pub(super) fn split_long_edges(
    mesh: &mut WorkMesh,
    longest: f32,
    spread: f32,
    most_faces: usize,
    rng: &mut ChaCha8Rng,
) {
    // Each round halves the longest edges; far more rounds than any finite mesh needs.
    for _ in 0..40 {
        let mut long: Vec<(f32, HalfEdgeId)> =
            mesh.topology.edges().map(|h| (mesh.length(h), h)).filter(|&(length, _)| length > longest).collect();
        long.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        let mut any = false;
        for (_, h) in long {
            if mesh.topology.live_faces() >= most_faces {
                return;
            }
            if mesh.length(h) > longest {
                let cut = 0.5 + spread * (rng.random::<f32>() - 0.5);
                any |= split(mesh, h, cut).is_some();
            }
        }
        if !any {
            return;
        }
    }
}

/// Splits an edge at about the share `cut` of its length. Half-edge `h` keeps its origin and ends at the new
/// vertex; faces on both sides keep their ids and one is added on each. `None`, and nothing done, where the edge is
/// too short to be cut.
pub(super) fn split(mesh: &mut WorkMesh, h: HalfEdgeId, cut: f32) -> Option<VertexId> {
    let (a, b) = (mesh.topology.origin(h), mesh.topology.target(h));
    let (pa, pb) = (mesh.position(a), mesh.position(b));
    let (position, place) = if let Some(chain) = mesh.chain(h) {
        let (from, to) = (mesh.arc_length(a, chain), mesh.arc_length(b, chain));
        let s = from + (to - from) * cut;
        (mesh.reference.chains.position(mesh.reference.positions, chain, s), Place::Line { chain, s })
    } else {
        let start = match (mesh.place(a), mesh.place(b)) {
            (Place::Free(f), _) | (_, Place::Free(f)) => f,
            _ => mesh.corner(h).triangle,
        };
        let foot = project(mesh.reference, pa.lerp(pb, cut), start);
        (foot.position, Place::Free(foot.triangle))
    };
    if position == pa || position == pb {
        return None;
    }
    let twin = mesh.topology.twin(h);
    let m = mesh.add_vertex(position, place);
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
