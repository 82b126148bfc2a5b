//! Writes the stains of fine fronts and of the backs behind them.

use bevy_math::{Vec3, Vec4};

use super::{
    FINE_PIECE,
    backs::FineBacks,
    fronts::FineFronts,
    layout::EdgeSpot,
    view::{Course, View},
};
use crate::appearance::seen::Seen;
use crate::{
    film::{FaceId, HalfEdgeId, VertexId},
    rest::{Rest, pieces},
};

/// Writes the stains of all that lies at vertices whose stains changed, and of what is new.
pub(super) async fn stain(
    view: &View<'_>,
    seen: &Seen,
    fronts: &mut FineFronts,
    backs: &mut FineBacks,
    rest: &mut impl Rest,
) {
    let (look, all) = (&seen.looks.film, seen.differences.whole);
    if all || look.any {
        for slot in 0..fronts.parts.len() {
            for wedge in 0..fronts.skin.wedges.slot(slot).film.len() {
                let v = fronts.skin.wedges.slot(slot).film[wedge];
                if v.get().is_some_and(|v| all || look.has_changed(v.index())) {
                    stain_corner(seen, fronts, backs, slot, wedge);
                }
            }
        }
        rest.rest().await;
        for piece in pieces(view.topology().face_count(), FINE_PIECE) {
            for f in piece.map(FaceId::new).filter(|&f| view.topology().is_live(f)) {
                stain_face(view, seen, fronts, backs, f);
            }
            rest.rest().await;
        }
    }
    if all {
        return;
    }
    for slot in 0..fronts.parts.len() {
        for i in 0..fronts.skin.wedges.slot(slot).new.len() {
            let wedge = fronts.skin.wedges.slot(slot).new[i] as usize;
            stain_corner(seen, fronts, backs, slot, wedge);
        }
    }
    for i in 0..fronts.renewed_edges.len() {
        stain_edge(view, seen, fronts, backs, fronts.renewed_edges[i]);
    }
    for i in 0..fronts.renewed_faces.len() {
        stain_inside(view, seen, fronts, backs, fronts.renewed_faces[i]);
    }
}

/// Stains the edges and the inside of a face, if the stains at its corners changed.
fn stain_face(view: &View, seen: &Seen, fronts: &mut FineFronts, backs: &mut FineBacks, f: FaceId) {
    let (look, all) = (&seen.looks.film, seen.differences.whole);
    let changed = view.topology().corners(f).map(|v| all || look.has_changed(v.index()));
    if changed == [false; 3] {
        return;
    }
    for (k, h) in f.half_edges().into_iter().enumerate() {
        // Points of chipped edges lie between all three corners.
        if changed[k] | changed[(k + 1) % 3] || fronts.outlines.edge(h).is_some() {
            stain_edge(view, seen, fronts, backs, h);
        }
    }
    stain_inside(view, seen, fronts, backs, f);
    for h in f.half_edges().into_iter().filter(|_| backs.rims.any(f)) {
        let slot = view.face_slots.slot(f);
        backs.rims.stain(view, fronts, h, &mut backs.parts[slot], &mut backs.changes[slot]);
    }
}

fn stain_corner(seen: &Seen, fronts: &mut FineFronts, backs: &mut FineBacks, slot: usize, wedge: usize) {
    let (v, vertex) = (fronts.skin.wedges.slot(slot).film[wedge], fronts.skin.wedge(slot, wedge));
    let stains = seen.looks.film.stains[v.index()];
    fronts.parts[slot].stains[vertex] = stains;
    fronts.changes[slot].stained.push(vertex);
    if let Some(back) = backs.corner(slot, wedge) {
        backs.parts[slot].stains[back] = stains;
        backs.changes[slot].stained.push(back);
    }
}

/// Stains the edge of `h`, if it has vertices of its own.
fn stain_edge(view: &View, seen: &Seen, fronts: &mut FineFronts, backs: &mut FineBacks, h: HalfEdgeId) {
    let Some(vertices) = fronts.skin.edge(h) else { return };
    let slot = view.face_slots.slot(h.face());
    let at = |v: VertexId| Vec4::from_array(seen.looks.film.stains[v.index()]);
    let to = &mut fronts.parts[slot].stains[vertices.clone()];
    if let Some(places) = fronts.outlines.edge(h) {
        let corners = view.topology().corners(h.face()).map(at);
        to.iter_mut().zip(places).for_each(|(to, &b)| *to = mean_stains(&corners, b));
    } else {
        let course = Course::of(view, h);
        let ends = course.ends.map(at);
        for (i, to) in to.iter_mut().enumerate() {
            *to = edge_stains(&ends, course.pick(&view.base.layout.edge, i));
        }
    }
    copy(fronts, backs, slot, vertices, backs.edge(h));
}

/// Stains the inside of `f`, if it is shown.
fn stain_inside(view: &View, seen: &Seen, fronts: &mut FineFronts, backs: &mut FineBacks, f: FaceId) {
    let Some(vertices) = fronts.skin.inside(f) else { return };
    let slot = view.face_slots.slot(f);
    let corners = view.topology().corners(f).map(|v| Vec4::from_array(seen.looks.film.stains[v.index()]));
    let to = &mut fronts.parts[slot].stains[vertices.clone()];
    if let Some(places) = fronts.outlines.inside(f) {
        to.iter_mut().zip(places).for_each(|(to, &b)| *to = mean_stains(&corners, b));
    } else {
        to.iter_mut().zip(&view.base.layout.inside).for_each(|(to, spot)| *to = mean_stains(&corners, spot.b));
    }
    copy(fronts, backs, slot, vertices, backs.inside(f));
}

/// Copies the stains of some vertices of the fronts to those behind them, if there are any.
fn copy(
    fronts: &mut FineFronts,
    backs: &mut FineBacks,
    slot: usize,
    vertices: std::ops::Range<usize>,
    behind: Option<std::ops::Range<usize>>,
) {
    if let Some(behind) = behind {
        backs.parts[slot].stains[behind.clone()].copy_from_slice(&fronts.parts[slot].stains[vertices.clone()]);
        backs.changes[slot].stained.add(behind);
    }
    fronts.changes[slot].stained.add(vertices);
}

/// Returns the stains at a place of an edge between those at its ends.
#[inline]
pub(super) fn edge_stains([a, b]: &[Vec4; 2], spot: &EdgeSpot) -> [f32; 4] {
    (*a * spot.shares[0] + *b * spot.shares[1]).to_array()
}

/// Returns the stains at `b` between those at the corners of a face.
#[inline]
pub(super) fn mean_stains(corners: &[Vec4; 3], b: Vec3) -> [f32; 4] {
    let b = b.max(Vec3::ZERO);
    let b = b / (b.x + b.y + b.z);
    (corners[0] * b.x + corners[1] * b.y + corners[2] * b.z).to_array()
}
