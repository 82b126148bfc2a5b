//! Builds the fine fronts: the grids of all faces, bent with the film and chipped where it has torn.

use bevy_math::{Vec3, Vec3A};

use super::{
    FINE_PIECE,
    base::{Base, Place},
    outline::{Outlines, rest_patch},
    patch::Curve,
    skin::Skin,
    view::{Course, View},
};
use crate::appearance::{
    part::{MeshPart, set},
    part_changes::PartChanges,
    seen::Seen,
};
use crate::{
    film::{FaceId, HalfEdgeId},
    rest::{Rest, pieces},
};

/// Fronts of all slots.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct FineFronts {
    /// Vertices and triangles of the front of each slot.
    pub parts: Vec<MeshPart>,
    pub changes: Vec<PartChanges>,
    pub skin: Skin,
    pub(super) outlines: Outlines,
    /// Offset of each vertex of each slot from the patch at rest.
    pub(super) offsets: Vec<Vec<Vec3>>,
    /// Half-edges whose vertices are new or stand for another place.
    pub(super) renewed_edges: Vec<HalfEdgeId>,
    /// Faces whose vertices inside are new or stand for another place.
    pub(super) renewed_faces: Vec<FaceId>,
    /// Vertices of the face whose triangles are being written.
    vertices: Vec<u32>,
}

impl FineFronts {
    /// Returns fronts without faces in `slots` slots. Chips have an amplitude of up to `amplitude` metres.
    pub fn new(slots: usize, base: &Base, amplitude: f32) -> Self {
        Self {
            parts: vec![MeshPart::default(); slots],
            changes: vec![PartChanges::default(); slots],
            skin: Skin::new(base),
            outlines: Outlines::new(amplitude),
            offsets: vec![Vec::new(); slots],
            ..Self::default()
        }
    }

    /// Brings triangles, and what lies at rest where, up to date with what is different about the film.
    pub(super) async fn renew(&mut self, view: &View<'_>, seen: &Seen, rest: &mut impl Rest) {
        let differences = &seen.differences;
        self.changes.iter_mut().for_each(|changes| changes.begin(differences.whole));
        if differences.whole {
            self.parts.iter_mut().for_each(MeshPart::clear);
            self.offsets.iter_mut().for_each(Vec::clear);
            self.outlines.clear(view.mesh, view.base);
        }
        self.skin.follow(view.topology(), view.face_slots, view.base, differences, &mut self.parts, rest).await;
        for (offsets, part) in self.offsets.iter_mut().zip(&self.parts) {
            offsets.reserve_exact(part.positions.len() - offsets.len());
            offsets.resize(part.positions.len(), Vec3::ZERO);
        }
        rest.rest().await;
        self.fill(view, rest).await;
        self.chip(view, seen, rest).await;
        self.renew_triangles(view, rest).await;
    }

    /// Forgets what was new in the last update, and the memory for it: never again is all new at once.
    pub(super) fn forget(&mut self) {
        self.skin.forget();
        (self.renewed_edges, self.renewed_faces) = (Vec::new(), Vec::new());
    }

    /// Puts what lies there at rest into the vertices that are new.
    async fn fill(&mut self, view: &View<'_>, rest: &mut impl Rest) {
        self.fill_corners(view);
        rest.rest().await;
        for piece in pieces(self.skin.new_edges.len(), FINE_PIECE) {
            piece.for_each(|i| self.fill_edge(view, self.skin.new_edges[i]));
            rest.rest().await;
        }
        for piece in pieces(self.skin.new_faces.len(), FINE_PIECE) {
            piece.for_each(|i| self.fill_inside(view, self.skin.new_faces[i]));
            rest.rest().await;
        }
        self.renewed_edges.clone_from(&self.skin.new_edges);
        self.renewed_faces.clone_from(&self.skin.new_faces);
    }

    fn fill_corners(&mut self, view: &View) {
        let Self { parts, changes, skin, .. } = self;
        let base = view.base;
        for (slot, (part, changes)) in parts.iter_mut().zip(changes.iter_mut()).enumerate() {
            let wedges = skin.wedges.slot(slot);
            for &wedge in &wedges.new {
                let (vertex, point) = (skin.wedge(slot, wedge as usize), base.corner(wedges.corners[wedge as usize]));
                put(part, vertex, &base.of(point), base, point);
                changes.renewed.push(vertex);
                changes.stained.push(vertex);
            }
        }
    }

    fn fill_edge(&mut self, view: &View, h: HalfEdgeId) {
        let (slot, Some(vertices)) = (view.face_slots.slot(h.face()), self.skin.edge(h)) else { return };
        let base = view.base;
        let course = Course::of(view, h);
        let (positions, normals) = view.at_rest(course.ends);
        let curve = Curve::new(positions, normals);
        for (i, vertex) in vertices.clone().enumerate() {
            let point = base.on_edge(h, i);
            let place = base.of(point);
            let at_rest = curve.at(&course.pick(&base.layout.edge, i).weights);
            self.offsets[slot][vertex] = (Vec3A::from(place.position) - at_rest).into();
            put(&mut self.parts[slot], vertex, &place, base, point);
        }
        self.changes[slot].renewed.add(vertices);
    }

    fn fill_inside(&mut self, view: &View, f: FaceId) {
        let (slot, Some(vertices)) = (view.face_slots.slot(f), self.skin.inside(f)) else { return };
        let base = view.base;
        let patch = rest_patch(view, f);
        for ((i, vertex), spot) in vertices.clone().enumerate().zip(&base.layout.inside) {
            let point = base.inside(f, i);
            let place = base.of(point);
            self.offsets[slot][vertex] = (Vec3A::from(place.position) - patch.at(&spot.weights)).into();
            put(&mut self.parts[slot], vertex, &place, base, point);
        }
        self.changes[slot].renewed.add(vertices);
    }

    /// Shapes the outlines of faces at edges that have torn.
    async fn chip(&mut self, view: &View<'_>, seen: &Seen, rest: &mut impl Rest) {
        seen.differences.tears.iter().for_each(|h| self.chip_face(view, h.face()));
        let all = if seen.differences.whole { view.topology().face_count() } else { 0 };
        for piece in pieces(all, FINE_PIECE) {
            let live = piece.map(FaceId::new).filter(|&f| view.topology().is_live(f));
            live.for_each(|f| self.chip_face(view, f));
            rest.rest().await;
        }
    }

    fn chip_face(&mut self, view: &View, f: FaceId) {
        let Self { parts, changes, skin, outlines, offsets, renewed_edges, renewed_faces, .. } = self;
        let Some(inside) = skin.inside(f).filter(|_| outlines.has_torn(view.mesh, f)) else { return };
        let slot = view.face_slots.slot(f);
        let (part, offsets) = (&mut parts[slot], &mut offsets[slot]);
        outlines.shape(view, f, |point| {
            let Some(mut own) = point.edge.map_or(Some(inside.clone()), |h| skin.edge(h)) else { return };
            if let Some(vertex) = own.nth(point.i) {
                offsets[vertex] = point.offset.into();
                point.place.put(part, vertex);
            }
        });
        for h in f.half_edges().into_iter().filter(|&h| outlines.edge(h).is_some()) {
            changes[slot].renewed.add(skin.edge(h).unwrap_or_default());
            renewed_edges.push(h);
        }
        changes[slot].renewed.add(inside);
        renewed_faces.push(f);
    }

    /// Writes the triangles of faces whose corners or edges have other vertices, and removes those of faces that are
    /// gone.
    async fn renew_triangles(&mut self, view: &View<'_>, rest: &mut impl Rest) {
        let Self { parts, changes, skin, vertices, .. } = self;
        for (f, indices) in &skin.gone {
            changes[view.face_slots.slot(*f)].indices.add(indices.clone());
        }
        for piece in skin.led.chunks(FINE_PIECE) {
            for &f in piece {
                let (slot, Some(indices)) = (view.face_slots.slot(f), skin.triangles(f)) else { continue };
                skin.list(view.topology(), view.base, slot, f, vertices);
                view.base.put_triangles(&mut parts[slot], vertices, indices.start, view.face_slots.is_flipped(f));
                changes[slot].indices.add(indices);
            }
            rest.rest().await;
        }
    }
}

/// Puts a place at rest with its tangent into a vertex, which lies there until it is moved.
fn put(part: &mut MeshPart, vertex: usize, place: &Place, base: &Base, point: usize) {
    place.put(part, vertex);
    part.positions[vertex] = part.rest[vertex];
    part.normals[vertex] = part.rest_normals[vertex];
    set(&mut part.tangents, vertex, base.tangent(point).map(|tangent| tangent.to_array()));
}
