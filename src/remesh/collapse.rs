//! Collapses edges.

use bevy_math::Vec3;

use super::project::{distance_to_triangle, project};
use super::work_mesh::{SurfacePoint, WorkMesh, count_edit};
use crate::{
    film::{HalfEdgeId, VertexId},
    rest::{PIECE, Rest, sort_by_number},
};

/// Limits that a collapse must respect.
#[derive(Clone, Copy, Debug)]
pub(super) struct CollapseLimits {
    /// Edges shorter than this are collapsed.
    pub shortest: f32,
    /// No edge may grow longer than this.
    pub longest: f32,
    /// Largest distance of a feature edge from its line.
    pub deviation: f32,
    /// Largest distance of the middle of an edge from the surface.
    pub stray: f32,
    /// Least quality of the faces after the collapse, unless the worst face was below it before.
    pub quality: f32,
    /// Number of faces at which collapsing stops.
    pub fewest_faces: usize,
}

/// Collapses short edges, the shortest first.
pub(super) async fn collapse_short_edges(mesh: &mut WorkMesh<'_>, limits: CollapseLimits, rest: &mut impl Rest) {
    // The bits of lengths are in the order of lengths, as none is negative.
    let short: Vec<(u32, HalfEdgeId)> = mesh
        .topology
        .edges()
        .map(|h| (mesh.sized_length(h), h))
        .filter(|&(length, _)| length < limits.shortest)
        .map(|(length, h)| (length.to_bits(), h))
        .collect();
    rest.rest().await;
    let short = sort_by_number(short, |edge| edge.0, rest).await;
    for (i, (_, h)) in short.into_iter().enumerate() {
        if i.is_multiple_of(PIECE) {
            rest.rest().await;
        }
        if mesh.topology.live_faces() <= limits.fewest_faces {
            return;
        }
        if mesh.topology.is_live(h.face()) && mesh.sized_length(h) < limits.shortest {
            try_collapse(mesh, h, limits);
        }
    }
}

/// Position at which the two ends of an edge may meet.
type Meeting = (Vec3, SurfacePoint);

/// Collapses the edge if topology, features, size and shape allow it, and returns whether it did.
pub(super) fn try_collapse(mesh: &mut WorkMesh, h: HalfEdgeId, limits: CollapseLimits) -> bool {
    let meetings = meetings(mesh, h);
    if meetings[0].is_none() || !keeps_topology(mesh, h) {
        return false;
    }
    for (position, surface_point) in meetings.into_iter().flatten() {
        if keeps_features(mesh, h, surface_point, limits)
            && keeps_shape(mesh, h, position, limits)
            && keeps_close(mesh, h, position, surface_point, limits)
        {
            let kept = collapse(mesh, h);
            mesh.positions[kept.index()] = position;
            mesh.surface_points[kept.index()] = surface_point;
            return true;
        }
    }
    false
}

/// Returns the positions to try, best first. The target of `h` always keeps its id, even if it moves to the origin.
fn meetings(mesh: &WorkMesh, h: HalfEdgeId) -> [Option<Meeting>; 3] {
    let (a, b) = (mesh.topology.origin(h), mesh.topology.target(h));
    let at = |v: VertexId| Some((mesh.position(v), mesh.surface_point(v)));
    let chain = mesh.chain(h);
    match (mesh.surface_point(a), mesh.surface_point(b)) {
        (SurfacePoint::Free(start), SurfacePoint::Free(_)) => {
            let foot = project(mesh.reference, mesh.position(a).midpoint(mesh.position(b)), start);
            [Some((foot.position, SurfacePoint::Free(foot.triangle))), at(a), at(b)]
        }
        (SurfacePoint::Free(_), _) => [at(b), None, None],
        (_, SurfacePoint::Free(_)) => [at(a), None, None],
        (SurfacePoint::Line { chain: c, s: from }, SurfacePoint::Line { chain: d, s: to })
            if c == d && chain == Some(c) =>
        {
            let s = 0.5 * (from + to);
            let position = mesh.reference.chains.position(mesh.reference.positions, c, s);
            [Some((position, SurfacePoint::Line { chain: c, s })), at(a), at(b)]
        }
        (SurfacePoint::Line { chain: c, .. }, SurfacePoint::Fixed(_)) if chain == Some(c) => [at(b), None, None],
        (SurfacePoint::Fixed(_), SurfacePoint::Line { chain: c, .. }) if chain == Some(c) => [at(a), None, None],
        _ => [None; 3],
    }
}

/// Returns whether the collapse changes neither the Euler number nor the number of borders (the link condition, also
/// for borders).
fn keeps_topology(mesh: &WorkMesh, h: HalfEdgeId) -> bool {
    let topology = &mesh.topology;
    let (a, b) = (topology.origin(h), topology.target(h));
    let twin = topology.twin(h);
    if twin.is_some() && topology.is_border(a) && topology.is_border(b) {
        return false;
    }
    let wings = [Some(topology.opposite(h)), twin.map(|t| topology.opposite(t))];
    if topology.neighbours(a).any(|v| topology.neighbours(b).any(|w| v == w) && !wings.contains(&Some(v))) {
        return false;
    }
    // A wing keeps at least three faces inside, one at a border.
    let keeps_faces = |v: VertexId| {
        let least = if topology.is_border(v) { 2 } else { 4 };
        topology.ring(v).nth(least - 1).is_some()
    };
    // A face whose other two edges are both open would leave a loose edge behind.
    let ear = |h: HalfEdgeId| topology.twin(h.next()).is_none() && topology.twin(h.previous()).is_none();
    wings.into_iter().flatten().all(keeps_faces) && !ear(h) && !twin.is_some_and(ear)
}

/// Returns whether no two feature lines would merge and none would leave its course.
fn keeps_features(mesh: &WorkMesh, h: HalfEdgeId, surface_point: SurfacePoint, limits: CollapseLimits) -> bool {
    for e in [Some(h), mesh.topology.twin(h)].into_iter().flatten() {
        // The two other edges of a vanishing face become one.
        if mesh.chain(e.next()).is_some() && mesh.chain(e.previous()).is_some() {
            return false;
        }
    }
    let Some(chain) = mesh.chain(h) else { return true };
    let (a, b) = (mesh.topology.origin(h), mesh.topology.target(h));
    let meeting = match surface_point {
        SurfacePoint::Line { s, .. } => s,
        SurfacePoint::Fixed(v) => mesh.reference.chains.end(chain, v),
        SurfacePoint::Free(_) => return false,
    };
    [(a, b), (b, a)].into_iter().all(|(v, other)| match mesh.surface_point(v) {
        SurfacePoint::Line { .. } => chain_neighbours(mesh, v, chain)
            .filter(|&n| n != other)
            .all(|n| mesh.reference.strays(chain, meeting, mesh.arc_length(n, chain)) <= limits.deviation),
        _ => true,
    })
}

/// Iterates over the vertices before and after `v` on a chain.
pub(super) fn chain_neighbours<'m>(mesh: &'m WorkMesh, v: VertexId, chain: u32) -> impl Iterator<Item = VertexId> + 'm {
    let topology = &mesh.topology;
    let leaving = topology.ring(v).filter(move |&h| mesh.chain(h) == Some(chain)).map(|h| topology.target(h));
    let arriving = topology
        .ring(v)
        .map(HalfEdgeId::previous)
        .filter(move |&h| topology.twin(h).is_none() && mesh.chain(h) == Some(chain))
        .map(|h| topology.origin(h));
    leaving.chain(arriving)
}

/// Returns whether no face would fold over or get too thin, and no edge would get too long.
fn keeps_shape(mesh: &WorkMesh, h: HalfEdgeId, position: Vec3, limits: CollapseLimits) -> bool {
    let (a, b) = (mesh.topology.origin(h), mesh.topology.target(h));
    let longest = limits.longest.max(mesh.length(h));
    let too_long = |v: VertexId, other: VertexId| {
        mesh.position(v) != position
            && mesh.topology.spokes(v).any(|(e, n)| {
                n != other && mesh.position(n).distance(position) > longest.max(limits.longest * mesh.stretch(e))
            })
    };
    if too_long(a, b) || too_long(b, a) {
        return false;
    }
    let gone = [Some(h.face()), mesh.topology.twin(h).map(HalfEdgeId::face)];
    let mut least = f32::MAX;
    for v in [a, b] {
        match mesh.quality_at(v, position, gone) {
            Some(quality) => least = least.min(quality),
            None => return false,
        }
    }
    least >= limits.quality || least >= mesh.quality(a).min(mesh.quality(b))
}

/// Returns whether no edge at the merged vertex would cut through a bend of the surface, and both ends are still close
/// to the new faces (an end may have been the tip of a bump).
fn keeps_close(
    mesh: &WorkMesh,
    h: HalfEdgeId,
    position: Vec3,
    surface_point: SurfacePoint,
    limits: CollapseLimits,
) -> bool {
    let gone = [Some(h.face()), mesh.topology.twin(h).map(HalfEdgeId::face)];
    let near = |p: Vec3| {
        [mesh.topology.origin(h), mesh.topology.target(h)].into_iter().any(|v| {
            mesh.topology.ring(v).filter(|e| !gone.contains(&Some(e.face()))).any(|e| {
                let far = [mesh.topology.target(e), mesh.topology.opposite(e)].map(|v| mesh.position(v));
                distance_to_triangle(p, [position, far[0], far[1]])
                    <= 1.5 * limits.stray * mesh.reference.closeness * mesh.scale(e.face())
            })
        })
    };
    if !near(mesh.position(mesh.topology.origin(h))) || !near(mesh.position(mesh.topology.target(h))) {
        return false;
    }
    let (a, b) = (mesh.topology.origin(h), mesh.topology.target(h));
    [(a, b), (b, a)].into_iter().all(|(v, other)| {
        mesh.position(v) == position
            || mesh.topology.ring(v).all(|e| {
                let n = mesh.topology.target(e);
                if n == other || mesh.chain(e).is_some() {
                    return true;
                }
                let start = match (surface_point, mesh.surface_point(n)) {
                    (SurfacePoint::Free(f), _) | (_, SurfacePoint::Free(f)) => f,
                    _ => mesh.corner(e).triangle,
                };
                mesh.stray_between(position, mesh.position(n), start, e.face()) <= limits.stray.max(mesh.stray(e))
            })
    })
}

/// Merges the origin of `h` into its target, which is returned. The faces at the edge (one or two) and the origin are
/// removed; all other ids stay.
fn collapse(mesh: &mut WorkMesh, h: HalfEdgeId) -> VertexId {
    let (a, b) = (mesh.topology.origin(h), mesh.topology.target(h));
    let twin = mesh.topology.twin(h);
    count_edit();
    let leaving: Vec<HalfEdgeId> = mesh.topology.ring(a).collect();
    let mut anchors = vec![];
    for e in leaving {
        mesh.topology.set_origin(e, b);
    }
    for e in [Some(h), twin].into_iter().flatten() {
        let wing = mesh.topology.opposite(e);
        let (n, p) = (e.next(), e.previous());
        let (outer_n, outer_p) = (mesh.topology.twin(n), mesh.topology.twin(p));
        let chain = mesh.chain(n).or(mesh.chain(p));
        for (outer, other) in [(outer_n, outer_p), (outer_p, outer_n)] {
            if let Some(outer) = outer {
                mesh.topology.link_or_open(outer, other);
                mesh.set_chain(outer, chain);
                let at_wing = if mesh.topology.origin(outer) == wing { outer } else { outer.next() };
                let at_kept = if mesh.topology.origin(outer) == wing { outer.next() } else { outer };
                anchors.push((wing, at_wing));
                anchors.push((b, at_kept));
            }
        }
    }
    for e in [Some(h), twin].into_iter().flatten() {
        mesh.topology.remove_face(e.face());
    }
    mesh.topology.remove_vertex(a);
    for (v, h) in anchors {
        mesh.topology.anchor(v, h);
    }
    b
}
