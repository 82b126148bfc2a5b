//! Moves fine fronts, and the backs behind them, with the film.

use std::ops::Range;

use bevy_math::{Mat3A, Vec3, Vec3A, Vec4};

use super::{
    FINE_PIECE,
    backs::FineBacks,
    fronts::FineFronts,
    patch::{Curve, Patch, weights},
    view::{Course, Pose, View, mix, unit},
};
use crate::appearance::{part::MeshPart, seen::Seen};
use crate::{
    film::{FaceId, HalfEdgeId},
    rest::{Rest, pieces},
};

/// Where a point of the film has come to.
struct Bent {
    /// Point of the patch.
    on_patch: Vec3A,
    /// Rotation since rest.
    turn: Mat3A,
    /// Mean of the normals at rest of the film around the point, of any length.
    up: Vec3A,
}

/// Writes positions, normals and tangents of what lies at vertices that moved or turned.
pub(super) async fn bend(
    view: &View<'_>,
    seen: &Seen,
    fronts: &mut FineFronts,
    backs: &mut FineBacks,
    rest: &mut impl Rest,
) {
    for slot in 0..fronts.parts.len() {
        for wedge in 0..fronts.skin.wedges.slot(slot).film.len() {
            let v = fronts.skin.wedges.slot(slot).film[wedge];
            if v.get().is_some_and(|v| seen.moves.is_turned(v)) {
                fronts.bend_corner(view, slot, wedge);
                backs.follow_corner(view, fronts, slot, wedge);
            }
        }
    }
    rest.rest().await;
    for piece in pieces(view.topology().face_count(), FINE_PIECE) {
        bend_faces(view, seen, fronts, backs, piece);
        rest.rest().await;
    }
}

/// Moves the edges and the insides of those of the faces at which vertices moved or turned.
fn bend_faces(view: &View, seen: &Seen, fronts: &mut FineFronts, backs: &mut FineBacks, faces: Range<usize>) {
    for f in faces.map(FaceId::new).filter(|&f| view.topology().is_live(f)) {
        let turned = view.topology().corners(f).map(|v| seen.moves.is_turned(v));
        if turned == [false; 3] {
            continue;
        }
        for (k, h) in f.half_edges().into_iter().enumerate() {
            // The third corner moves chipped edges, too.
            if turned[k] | turned[(k + 1) % 3] || fronts.outlines.edge(h).is_some() {
                fronts.bend_edge(view, h);
                backs.follow_edge(view, fronts, h);
            }
        }
        fronts.bend_inside(view, f);
        backs.follow_inside(view, fronts, f);
        if backs.rims.any(f) {
            f.half_edges().into_iter().for_each(|h| backs.follow_rim(view, fronts, h));
        }
    }
}

impl FineFronts {
    fn bend_corner(&mut self, view: &View, slot: usize, wedge: usize) {
        let Self { parts, changes, skin, .. } = self;
        let (wedges, vertex) = (skin.wedges.slot(slot), skin.wedge(slot, wedge));
        let (v, h) = (wedges.film[wedge], wedges.corners[wedge]);
        let Some(h) = h.get() else { return };
        let part = &mut parts[slot];
        // Film vertices lie on the prop's surface, and stay above it by themselves.
        let pose = view.pose(v);
        let at = |_| Bent { on_patch: pose.position, turn: *pose.rotation, up: Vec3A::ZERO };
        let tangent = |_| view.base.tangent(view.base.corner(h));
        place(part, &[Vec3::ZERO], vertex..vertex + 1, pose.still, tangent, at);
        changes[slot].moved.push(vertex);
    }

    /// Moves the vertices of the edge of `h`, if it has its own.
    fn bend_edge(&mut self, view: &View, h: HalfEdgeId) {
        let Self { parts, changes, skin, outlines, offsets, .. } = self;
        let Some(vertices) = skin.edge(h) else { return };
        let slot = view.face_slots.slot(h.face());
        changes[slot].moved.add(vertices.clone());
        let (part, offsets) = (&mut parts[slot], &offsets[slot][vertices.clone()]);
        let tangent = |i| view.base.tangent(view.base.on_edge(h, i));
        if let Some(places) = outlines.edge(h) {
            let corners = view.poses(h.face());
            let (still, patch) = shape(&corners);
            let at = |i: usize| on_face(&patch, &corners, places[i], &weights(places[i]));
            place(part, offsets, vertices, still, tangent, at);
            return;
        }
        let course = Course::of(view, h);
        let [a, b] = [view.pose(course.ends[0]), view.pose(course.ends[1])];
        let curve = Curve::new([a.position, b.position], [a.normal, b.normal]);
        let at = |i: usize| {
            let spot = course.pick(&view.base.layout.edge, i);
            let [s, t] = spot.shares;
            Bent {
                on_patch: curve.at(&spot.weights),
                turn: *a.rotation * s + *b.rotation * t,
                up: spot.mix([a.rest_normal, b.rest_normal]),
            }
        };
        place(part, offsets, vertices, a.still && b.still, tangent, at);
    }

    /// Moves the vertices inside `f`, if it is shown.
    fn bend_inside(&mut self, view: &View, f: FaceId) {
        let Self { parts, changes, skin, outlines, offsets, .. } = self;
        let Some(vertices) = skin.inside(f) else { return };
        let slot = view.face_slots.slot(f);
        changes[slot].moved.add(vertices.clone());
        let (part, offsets) = (&mut parts[slot], &offsets[slot][vertices.clone()]);
        let corners = view.poses(f);
        let (still, patch) = shape(&corners);
        let tangent = |i| view.base.tangent(view.base.inside(f, i));
        match outlines.inside(f) {
            Some(places) => {
                let at = |i: usize| on_face(&patch, &corners, places[i], &weights(places[i]));
                place(part, offsets, vertices, still, tangent, at);
            }
            None => {
                let spots = &view.base.layout.inside;
                let at = |i: usize| on_face(&patch, &corners, spots[i].b, &spots[i].weights);
                place(part, offsets, vertices, still, tangent, at);
            }
        }
    }
}

/// Returns whether a face lies as at rest, and the patch over it.
#[inline(always)]
fn shape([a, b, c]: &[Pose; 3]) -> (bool, Patch) {
    let patch = Patch::new([a.position, b.position, c.position], [a.normal, b.normal, c.normal]);
    (a.still && b.still && c.still, patch)
}

/// Returns where the point `b` of a face has come to.
#[inline(always)]
fn on_face(patch: &Patch, [p, q, r]: &[Pose; 3], b: Vec3, weights: &[f32; 10]) -> Bent {
    Bent {
        on_patch: patch.at(weights),
        turn: *p.rotation * b.x + *q.rotation * b.y + *r.rotation * b.z,
        up: mix([p.rest_normal, q.rest_normal, r.rest_normal], b),
    }
}

/// Moves some vertices of a front, each of which has its offset from the patch at rest, its `tangent` at rest and the
/// place `at` which its point of the film is now. With `still`, all lie as at rest.
#[inline(always)]
fn place(
    part: &mut MeshPart,
    offsets: &[Vec3],
    vertices: std::ops::Range<usize>,
    still: bool,
    tangent: impl Fn(usize) -> Option<Vec4>,
    at: impl Fn(usize) -> Bent,
) {
    let MeshPart { positions, normals, tangents, rest, rest_normals, .. } = part;
    let (rest, rest_normals) = (&rest[vertices.clone()], &rest_normals[vertices.clone()]);
    let (positions, normals) = (&mut positions[vertices.clone()], &mut normals[vertices.clone()]);
    let mut tangents = tangents.get_mut(vertices);
    if still {
        positions.copy_from_slice(rest);
        normals.copy_from_slice(rest_normals);
        for (i, to) in tangents.into_iter().flatten().enumerate() {
            *to = tangent(i).unwrap_or_default().to_array();
        }
        return;
    }
    for (i, &offset) in offsets.iter().enumerate() {
        let Bent { on_patch, turn, up } = at(i);
        let position = lifted(on_patch + turn * Vec3A::from(offset), Vec3A::from_array(rest[i]), up);
        let rest_normal = Vec3A::from_array(rest_normals[i]);
        let normal = unit(turn * rest_normal, rest_normal);
        positions[i] = position.to_array();
        normals[i] = normal.to_array();
        if let Some(to) = tangents.as_deref_mut().and_then(|tangents| tangents.get_mut(i))
            && let Some(rest) = tangent(i)
        {
            let along = turn * Vec3A::from(rest.truncate());
            let flat = unit(along - normal * along.dot(normal), rest.truncate().into());
            *to = Vec3::from(flat).extend(rest.w).to_array();
        }
    }
}

/// Returns the position of what was at `rest`, lifted so far along `up` that it does not lie below: patches between
/// film that has moved and film that has not may dip through the metal.
#[inline(always)]
fn lifted(position: Vec3A, rest: Vec3A, up: Vec3A) -> Vec3A {
    if (position - rest).dot(up) < 0.0 { lift(position, rest, up) } else { position }
}

#[cold]
fn lift(position: Vec3A, rest: Vec3A, up: Vec3A) -> Vec3A {
    // Around a thin pole the normals that it is a mean of may nearly cancel out: only its direction counts.
    let up = unit(up, Vec3A::ZERO);
    position - up * (position - rest).dot(up).min(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn offsets_normals_and_tangents_turn_with_the_face() {
        let corners = [Vec3A::ZERO, Vec3A::X, Vec3A::Y];
        let turn = Mat3A::from_rotation_x(0.7) * Mat3A::from_rotation_y(-0.4);
        // High above its place at rest, so that nothing dips.
        let raised = corners.map(|corner| turn * corner + Vec3A::Z * 5.0);
        let pose =
            |position| Pose { position, normal: turn * Vec3A::Z, rotation: &turn, rest_normal: Vec3A::Z, still: false };
        let poses = raised.map(pose);
        let patch = Patch::new(raised, [turn * Vec3A::Z; 3]);
        let b: Vec<Vec3> = (0..5).map(|i| Vec3::new(0.1 * i as f32, 0.2, 0.8 - 0.1 * i as f32)).collect();
        let offset = Vec3::new(0.0, 0.0, 0.3);
        let rest: Vec<Vec3A> = b.iter().map(|&b| mix(corners, b) + Vec3A::from(offset)).collect();
        let mut part = MeshPart {
            positions: vec![[0.0; 3]; 5],
            normals: vec![[0.0; 3]; 5],
            tangents: vec![[0.0; 4]; 5],
            rest: rest.iter().map(|p| p.to_array()).collect(),
            rest_normals: vec![[0.0, 0.6, 0.8]; 5],
            ..MeshPart::default()
        };
        let tangent = |_| Some(Vec4::new(1.0, 0.0, 0.0, -1.0));
        let at = |i: usize| on_face(&patch, &poses, b[i], &weights(b[i]));
        place(&mut part, &[offset; 5], 0..5, false, tangent, at);
        let near = |found: [f32; 3], expected: Vec3A| {
            assert!(Vec3A::from_array(found).abs_diff_eq(expected, 1e-5), "{found:?}, not {expected}");
        };
        for (i, rest) in rest.iter().enumerate() {
            near(part.positions[i], turn * *rest + Vec3A::Z * 5.0);
            near(part.normals[i], turn * Vec3A::new(0.0, 0.6, 0.8));
            let [x, y, z, w] = part.tangents[i];
            near([x, y, z], turn * Vec3A::X);
            assert_eq!(w, -1.0);
        }
        place(&mut part, &[offset; 5], 0..5, true, tangent, at);
        assert_eq!(part.positions, part.rest);
        assert_eq!(part.tangents, vec![[1.0, 0.0, 0.0, -1.0]; 5]);
    }

    #[test]
    fn what_dips_is_lifted_and_comes_no_further_from_the_surface() {
        for up in [Vec3A::Z, Vec3A::Z * 1e-4, Vec3A::new(0.6, 0.0, 0.8) * 1e-3, Vec3A::ZERO, -Vec3A::Z] {
            let place = Vec3A::new(0.3, 0.2, -0.4);
            let found = lifted(place, Vec3A::ZERO, up);
            assert!(found.dot(up) >= -1e-6 * up.length(), "it lies above");
            assert!(found.length() <= place.length() * 1.00001, "{up}: {found}");
            if up.dot(place) >= 0.0 {
                assert_eq!(found, place, "what lies above stays");
            }
        }
    }
}
