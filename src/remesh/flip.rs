//! Flips edges towards a Delaunay triangulation: turns the diagonal of two triangles if that raises their least angle.

use bevy_math::Vec3;

use super::work_mesh::{FOLD, WorkMesh, count_edit, quality};
use crate::{
    film::HalfEdgeId,
    rest::{LIGHT_PIECE, Rest},
};

/// Cosine of the angle between two faces above which the edge between them is flipped only if it comes closer to the
/// surface: about 15 degrees.
const BENT: f32 = 0.966;

/// Flips edges until no flip improves the triangles. Features are never flipped.
pub(super) async fn flip_edges(mesh: &mut WorkMesh<'_>, rest: &mut impl Rest) {
    let mut queue: Vec<HalfEdgeId> = mesh.topology.edges().collect();
    // Every flip raises a least angle, so this ends by itself, but rounding might turn one pair for ever.
    let mut budget = 10 * queue.len();
    while budget > 0 && !queue.is_empty() {
        let piece = budget.min(LIGHT_PIECE);
        budget -= piece;
        flip_some(mesh, &mut queue, piece);
        rest.rest().await;
    }
}

/// Flips up to so many edges of the queue.
fn flip_some(mesh: &mut WorkMesh, queue: &mut Vec<HalfEdgeId>, most: usize) {
    for _ in 0..most {
        let Some(h) = queue.pop() else { return };
        if flip_if(mesh, h, is_better_delaunay)
            && let Some(t) = mesh.topology.twin(h)
        {
            queue.extend([h.next(), h.previous(), t.next(), t.previous()]);
        }
    }
}

/// Flips an edge like [`flip_if`], unless the new edge would be further from the surface than the old one and than
/// `limit`. Returns whether it was flipped.
pub(super) fn flip_closely(mesh: &mut WorkMesh, h: HalfEdgeId, limit: f32, wanted: fn([Vec3; 4]) -> bool) -> bool {
    let before = mesh.stray(h);
    if !flip_if(mesh, h, wanted) {
        return false;
    }
    if mesh.stray(h) <= before.max(limit) {
        return true;
    }
    // A second flip brings the edge back, with its ends exchanged.
    flip(mesh, h);
    false
}

/// Flips the edge between the faces (a, b, c) and (b, a, d) if `wanted`, given those four points, says so and neither
/// features, topology nor a fold of the surface forbid it. Returns whether it was flipped.
fn flip_if(mesh: &mut WorkMesh, h: HalfEdgeId, wanted: fn([Vec3; 4]) -> bool) -> bool {
    let Some(t) = mesh.topology.twin(h) else { return false };
    if mesh.chain(h).is_some() {
        return false;
    }
    let topology = &mesh.topology;
    let corners = [topology.origin(h), topology.target(h), topology.opposite(h), topology.opposite(t)];
    let points = corners.map(|v| mesh.position(v));
    if !wanted(points) {
        return false;
    }
    let [a, b, c, d] = points;
    let (f, g) = (mesh.area_vector(h.face()), mesh.area_vector(t.face()));
    let mean = (f + g).normalize_or_zero();
    let upright = |n: Vec3| n.dot(mean) > FOLD * n.length();
    if !upright((c - d).cross(a - d)) || !upright((d - c).cross(b - c)) {
        return false;
    }
    if topology.edge_between(corners[2], corners[3]).is_some() {
        return false;
    }
    let is_bent = f.dot(g) < BENT * f.length() * g.length();
    if !is_bent {
        flip(mesh, h);
        return true;
    }
    // The new edge may not cut through the bend: a round bar would lose its shape, edge by edge.
    let before = mesh.stray(h);
    flip(mesh, h);
    let closer = mesh.stray(h) <= before;
    if !closer {
        flip(mesh, h);
    }
    closer
}

/// Returns whether the two angles opposite the edge sum to more than 180 degrees and a flip raises the lower quality of
/// the two faces. Where the two faces are not coplanar the angles alone do not ensure that.
fn is_better_delaunay([a, b, c, d]: [Vec3; 4]) -> bool {
    let (u, v) = (a - c, b - c);
    let (x, y) = (b - d, a - d);
    // sin(alpha + beta) < 0.
    let sum = u.cross(v).length() * x.dot(y) + u.dot(v) * x.cross(y).length();
    let scale = u.length() * v.length() * x.length() * y.length();
    if sum >= -1e-4 * scale {
        return false;
    }
    let before = quality(a, b, c).min(quality(b, a, d));
    let after = quality(c, d, b).min(quality(d, c, a));
    after > before
}

/// Turns the edge a-b between (a, b, c) and (b, a, d) into the edge d-c. Face ids stay.
fn flip(mesh: &mut WorkMesh, h: HalfEdgeId) {
    let Some(t) = mesh.topology.twin(h) else { return };
    count_edit();
    let [a, b] = [mesh.topology.origin(h), mesh.topology.target(h)];
    let [c, d] = [mesh.topology.opposite(h), mesh.topology.opposite(t)];
    let outer = [h.next(), h.previous(), t.next(), t.previous()].map(|e| (mesh.topology.twin(e), mesh.chain(e)));
    let [bc, ca, ad, db] = outer;
    let sides = [
        (h.next(), c, ca), // c to a
        (h.previous(), a, ad),
        (t.next(), d, db),
        (t.previous(), b, bc),
    ];
    mesh.topology.set_origin(h, d);
    mesh.topology.set_origin(t, c);
    for (e, origin, (twin, chain)) in sides {
        mesh.topology.set_origin(e, origin);
        mesh.topology.link_or_open(e, twin);
        mesh.set_chain(e, chain);
    }
    mesh.topology.anchor(a, h.previous());
    mesh.topology.anchor(b, t.previous());
    mesh.topology.anchor(c, h.next());
    mesh.topology.anchor(d, t.next());
}
