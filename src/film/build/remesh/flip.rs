//! Edge flips towards Delaunay: the diagonal of two triangles is turned if that raises their least angle.

use bevy_math::Vec3;

use super::mesh::{FOLD, WorkMesh, quality};
use crate::film::HalfEdgeId;

/// Flips until nothing is gained. Features are never flipped.
pub(super) fn flip_edges(mesh: &mut WorkMesh) {
    let mut queue: Vec<HalfEdgeId> = mesh.topology.edges().collect();
    // Every flip raises a least angle, so the work ends by itself; rounding may still turn a pair for ever.
    let mut budget = 10 * queue.len();
    while let Some(h) = queue.pop() {
        if budget == 0 {
            return;
        }
        budget -= 1;
        if is_better_flipped(mesh, h) {
            flip(mesh, h);
            if let Some(t) = mesh.topology.twin(h) {
                queue.extend([h.next(), h.previous(), t.next(), t.previous()]);
            }
        }
    }
}

fn is_better_flipped(mesh: &WorkMesh, h: HalfEdgeId) -> bool {
    let Some(t) = mesh.topology.twin(h) else { return false };
    if mesh.chain(h).is_some() {
        return false;
    }
    let topology = &mesh.topology;
    let [a, b, c, d] = [topology.origin(h), topology.target(h), topology.opposite(h), topology.opposite(t)];
    let [pa, pb, pc, pd] = [a, b, c, d].map(|v| mesh.position(v));
    // Sum of the two angles over the edge above 180 degrees: sin(alpha + beta) < 0 (Delaunay).
    let (u, v) = (pa - pc, pb - pc);
    let (x, y) = (pb - pd, pa - pd);
    let sum = u.cross(v).length() * x.dot(y) + u.dot(v) * x.cross(y).length();
    let scale = u.length() * v.length() * x.length() * y.length();
    if sum >= -1e-4 * scale {
        return false;
    }
    let (f, g) = (mesh.area_vector(h.face()), mesh.area_vector(t.face()));
    let (k, l) = ((pa - pd).cross(pc - pd), (pb - pc).cross(pd - pc));
    let mean = (f + g).normalize_or_zero();
    let upright = |n: Vec3| n.dot(mean) > FOLD * n.length();
    let before = quality(pa, pb, pc).min(quality(pb, pa, pd));
    let after = quality(pc, pd, pb).min(quality(pd, pc, pa));
    upright(k) && upright(l) && after > before && topology.edge_between(c, d).is_none()
}

/// Turns the edge a-b between (a, b, c) and (b, a, d) into d-c. Face ids stay.
pub(super) fn flip(mesh: &mut WorkMesh, h: HalfEdgeId) {
    let Some(t) = mesh.topology.twin(h) else { return };
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
