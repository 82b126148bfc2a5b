//! Builds the backs of fine flakes, one thickness of paint behind their fronts.

use bevy_math::Vec3A;

use super::{
    FINE_PIECE,
    base::Base,
    fronts::FineFronts,
    rims::Rims,
    runs::Runs,
    skin::{list, owner},
    view::{Course, View, mix, unit},
};
use crate::{
    appearance::{face_slots::has_separated, part::MeshPart, part_changes::PartChanges, seen::Seen},
    film::{FaceId, HalfEdgeId, Topology},
    fracture::FilmForces,
    rest::{Rest, pieces},
};

/// Entry of a wedge without back.
const NONE: u32 = u32::MAX;

/// Backs and rims of all slots. Whatever vertices fronts share, their backs share.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct FineBacks {
    /// Vertices and triangles in each slot.
    pub parts: Vec<MeshPart>,
    pub changes: Vec<PartChanges>,
    /// Thickness of the paint, in metres.
    thickness: f32,
    /// Vertex behind each wedge of each slot, or [`NONE`].
    corners: Vec<Vec<u32>>,
    /// Vertices of each slot that stand behind no wedge any more.
    free: Vec<Vec<u32>>,
    /// Vertices behind those of the edge of each half-edge and inside each face, and triangles of its back.
    runs: Runs,
    pub(super) rims: Rims,
    /// Faces whose backs or rims may be new or gone.
    touched: Vec<FaceId>,
    /// Slot and wedge, half-edges and faces behind which there are new vertices.
    new_corners: Vec<(usize, usize)>,
    new_edges: Vec<HalfEdgeId>,
    new_faces: Vec<FaceId>,
    new_rims: Vec<HalfEdgeId>,
    /// Vertices of the face whose triangles are being written.
    vertices: Vec<u32>,
}

impl FineBacks {
    /// Returns the backs of a fresh film with `slots` slots, for paint that is `thickness` metres thick.
    pub fn new(slots: usize, base: &Base, thickness: f32) -> Self {
        let layout = &base.layout;
        Self {
            parts: vec![MeshPart::default(); slots],
            changes: vec![PartChanges::default(); slots],
            thickness,
            corners: vec![Vec::new(); slots],
            free: vec![Vec::new(); slots],
            runs: Runs::new(layout),
            rims: Rims::new(&layout.grid),
            ..Self::default()
        }
    }

    /// Adds and removes backs and rims, as is different about the film. The skin of `fronts` must be up to date.
    pub(super) async fn renew(
        &mut self,
        view: &View<'_>,
        forces: &FilmForces,
        seen: &Seen,
        fronts: &FineFronts,
        rest: &mut impl Rest,
    ) {
        let (topology, differences) = (view.topology(), &seen.differences);
        self.changes.iter_mut().for_each(|changes| changes.begin(differences.whole));
        self.touched.clear();
        self.new_corners.clear();
        self.new_edges.clear();
        self.new_faces.clear();
        self.new_rims.clear();
        if differences.whole {
            self.begin(view, forces);
        } else {
            self.touched.extend_from_slice(&differences.exposed);
            self.touched.extend(differences.tears.iter().map(|h| h.face()));
        }
        for (slot, corners) in self.corners.iter_mut().enumerate() {
            let wedges = fronts.skin.wedges.slot(slot);
            corners.resize(wedges.film.len(), NONE);
            // They stand for another place of the film from now on.
            for &wedge in &wedges.new {
                let back = std::mem::replace(&mut corners[wedge as usize], NONE);
                self.free[slot].extend((back != NONE).then_some(back));
            }
        }
        let touched = std::mem::take(&mut self.touched);
        // Vertices that are moved together are together, so far as faces of their own need them.
        for piece in touched.chunks(FINE_PIECE) {
            for &f in piece {
                self.show(view, forces, f);
                f.half_edges().into_iter().for_each(|h| self.renew_edge(view, forces, fronts, h));
            }
            rest.rest().await;
        }
        for piece in touched.chunks(FINE_PIECE) {
            for twin in piece.iter().flat_map(|f| f.half_edges()).filter_map(|h| topology.rest_twin(h)) {
                self.renew_edge(view, forces, fronts, twin);
            }
            rest.rest().await;
        }
        for piece in pieces(self.new_faces.len(), FINE_PIECE) {
            piece.for_each(|i| self.lead(view, fronts, self.new_faces[i]));
            rest.rest().await;
        }
        for &f in fronts.skin.led.iter().filter(|_| !differences.whole) {
            self.lead(view, fronts, f);
        }
        for piece in touched.chunks(FINE_PIECE) {
            for h in piece.iter().flat_map(|f| f.half_edges()) {
                let has_back = self.runs.has(h.face());
                let slot = view.face_slots.slot(h.face());
                let (part, changes) = (&mut self.parts[slot], &mut self.changes[slot]);
                if self.rims.show(view, forces, has_back, h, part, changes) {
                    self.new_rims.push(h);
                }
            }
            rest.rest().await;
        }
        self.touched = touched;
    }

    /// Begins with nothing.
    fn begin(&mut self, view: &View, forces: &FilmForces) {
        let (topology, slots, layout) = (view.topology(), self.parts.len(), &view.base.layout);
        self.parts.iter_mut().for_each(MeshPart::clear);
        self.corners.iter_mut().for_each(Vec::clear);
        self.free.iter_mut().for_each(Vec::clear);
        self.runs.clear(topology.face_count(), slots);
        self.rims.clear(topology, slots);
        self.touched.extend(topology.live_faces().filter(|&f| is_wanted(view, forces, f)));
        let mut counts = vec![0; slots];
        for &f in &self.touched {
            counts[view.face_slots.slot(f)] += 1;
        }
        for (part, count) in self.parts.iter_mut().zip(counts) {
            // On a surface there are three edges and one corner for two faces.
            let vertices = count * layout.inner_points() + (3 * count * layout.edge_points() + count) / 2;
            view.base.reserve(part, vertices, 3 * count * layout.grid.triangles().len());
        }
    }

    /// Adds a back to `f` if it should have one, and removes one that it should not have.
    fn show(&mut self, view: &View, forces: &FilmForces, f: FaceId) {
        let slot = view.face_slots.slot(f);
        match (is_wanted(view, forces, f), self.runs.has(f)) {
            (true, false) => {
                self.runs.take_face(f, slot, &mut self.parts[slot]);
                self.new_faces.push(f);
            }
            (false, true) => {
                if let Some(indices) = self.runs.release_face(f, slot, &mut self.parts[slot]) {
                    self.changes[slot].indices.add(indices);
                }
            }
            _ => {}
        }
    }

    /// Adds vertices behind the edge of `h` if it has its own and a face at it has a back, and removes those that
    /// should not be there.
    fn renew_edge(&mut self, view: &View, forces: &FilmForces, fronts: &FineFronts, h: HalfEdgeId) {
        let (topology, slot) = (view.topology(), view.face_slots.slot(h.face()));
        let has_back = |f: FaceId| is_wanted(view, forces, f);
        let shares = |t: HalfEdgeId| owner(topology, view.base, t) == h && has_back(t.face());
        let wanted =
            fronts.skin.edge(h).is_some() && (has_back(h.face()) || topology.bound_twin(h).is_some_and(shares));
        match (wanted, self.runs.edge(h).is_some()) {
            (true, false) => {
                self.runs.take_edge(h, slot, &mut self.parts[slot]);
                self.new_edges.push(h);
            }
            (false, true) => self.runs.release_edge(h, slot),
            _ => {}
        }
    }

    /// Writes the triangles of the back of `f`, if it has one, behind those of its front.
    fn lead(&mut self, view: &View, fronts: &FineFronts, f: FaceId) {
        let (Some(indices), Some(inside)) = (self.runs.triangles(f), self.runs.inside(f)) else { return };
        let slot = view.face_slots.slot(f);
        let (part, corners) = (&mut self.parts[slot], &mut self.corners[slot]);
        for h in f.half_edges() {
            let wedge = fronts.skin.wedges.vertex_of(h) as usize;
            if corners[wedge] == NONE {
                corners[wedge] = self.free[slot].pop().unwrap_or_else(|| {
                    let vertex = part.positions.len();
                    part.grow_to(vertex + 1);
                    vertex as u32
                });
                self.new_corners.push((slot, wedge));
            }
        }
        let corner = |h| corners[fronts.skin.wedges.vertex_of(h) as usize] as usize;
        let edge = |h| self.runs.edge(h).map_or(0, |range| range.start);
        list(view.topology(), view.base, f, corner, edge, inside.start, &mut self.vertices);
        view.base.put_triangles(part, &self.vertices, indices.start, !view.face_slots.is_flipped(f));
        self.changes[slot].indices.add(indices);
    }

    /// Returns the vertex behind a wedge of a slot.
    #[inline]
    pub(super) fn corner(&self, slot: usize, wedge: usize) -> Option<usize> {
        self.corners[slot].get(wedge).filter(|&&vertex| vertex != NONE).map(|&vertex| vertex as usize)
    }

    /// Returns the vertices behind those of the edge of `h`.
    #[inline]
    pub(super) fn edge(&self, h: HalfEdgeId) -> Option<std::ops::Range<usize>> {
        self.runs.edge(h)
    }

    /// Returns the vertices behind those inside `f`.
    #[inline]
    pub(super) fn inside(&self, f: FaceId) -> Option<std::ops::Range<usize>> {
        self.runs.inside(f)
    }

    /// Copies what lies at the fronts of new vertices, and of those whose fronts stand for another place, and puts them
    /// in their places. `fronts` must be up to date.
    pub(super) async fn finish(&mut self, view: &View<'_>, seen: &Seen, fronts: &FineFronts, rest: &mut impl Rest) {
        for (slot, wedge) in std::mem::take(&mut self.new_corners) {
            if let Some(vertex) = self.corner(slot, wedge) {
                let from = fronts.skin.wedge(slot, wedge);
                self.copy(fronts, slot, vertex..vertex + 1, from..from + 1);
                self.follow_corner(view, fronts, slot, wedge);
            }
        }
        // With a whole new front all backs are new.
        let all = seen.differences.whole;
        let (new_edges, new_faces) = (std::mem::take(&mut self.new_edges), std::mem::take(&mut self.new_faces));
        let new_rims = std::mem::take(&mut self.new_rims);
        let renewed_edges = if all { &[] } else { fronts.renewed_edges.as_slice() };
        let renewed_faces = if all { &[] } else { fronts.renewed_faces.as_slice() };
        for piece in new_edges.chunks(FINE_PIECE).chain(renewed_edges.chunks(FINE_PIECE)) {
            piece.iter().for_each(|&h| self.finish_edge(view, fronts, h));
            rest.rest().await;
        }
        for piece in new_faces.chunks(FINE_PIECE).chain(renewed_faces.chunks(FINE_PIECE)) {
            piece.iter().for_each(|&f| self.finish_inside(view, fronts, f));
            rest.rest().await;
        }
        for piece in new_rims.chunks(FINE_PIECE).chain(renewed_edges.chunks(FINE_PIECE)) {
            for &h in piece {
                let slot = view.face_slots.slot(h.face());
                let (part, changes) = (&mut self.parts[slot], &mut self.changes[slot]);
                self.rims.copy(view, fronts, h, part, changes);
                self.follow_rim(view, fronts, h);
            }
            rest.rest().await;
        }
        (self.new_edges, self.new_faces, self.new_rims) = (new_edges, new_faces, new_rims);
    }

    fn finish_edge(&mut self, view: &View, fronts: &FineFronts, h: HalfEdgeId) {
        if let (Some(to), Some(from)) = (self.edge(h), fronts.skin.edge(h)) {
            self.copy(fronts, view.face_slots.slot(h.face()), to, from);
            self.follow_edge(view, fronts, h);
        }
    }

    fn finish_inside(&mut self, view: &View, fronts: &FineFronts, f: FaceId) {
        if let (Some(to), Some(from)) = (self.inside(f), fronts.skin.inside(f)) {
            self.copy(fronts, view.face_slots.slot(f), to, from);
            self.follow_inside(view, fronts, f);
        }
    }

    /// Forgets what was new in the last update, and the memory for it.
    pub(super) fn forget(&mut self) {
        (self.touched, self.new_corners, self.new_rims) = (Vec::new(), Vec::new(), Vec::new());
        (self.new_edges, self.new_faces) = (Vec::new(), Vec::new());
    }

    /// Copies attributes, stains and places at rest from the front.
    fn copy(&mut self, fronts: &FineFronts, slot: usize, to: std::ops::Range<usize>, from: std::ops::Range<usize>) {
        let (part, changes, front) = (&mut self.parts[slot], &mut self.changes[slot], &fronts.parts[slot]);
        changes.renewed.add(to.clone());
        changes.stained.add(to.clone());
        for (to, from) in to.zip(from) {
            part.copy_coordinates(to, front, from);
            part.copy_stains(to, front, from);
        }
    }

    /// Puts the vertex behind a wedge, if there is one, in its place.
    #[inline]
    pub(super) fn follow_corner(&mut self, view: &View, fronts: &FineFronts, slot: usize, wedge: usize) {
        let Some(to) = self.corner(slot, wedge) else { return };
        let (wedges, from) = (fronts.skin.wedges.slot(slot), fronts.skin.wedge(slot, wedge));
        let (Some(h), v) = (wedges.corners[wedge].get(), wedges.film[wedge]) else { return };
        let depth = view.depth(h.face(), self.thickness);
        let normal = |_| view.normal(v);
        put_behind(&mut self.parts[slot], to..to + 1, &fronts.parts[slot], from..from + 1, depth, normal);
        self.changes[slot].moved.push(to);
    }

    /// Puts the vertices behind the edge of `h`, if there are any, in their places.
    #[inline]
    pub(super) fn follow_edge(&mut self, view: &View, fronts: &FineFronts, h: HalfEdgeId) {
        let (Some(to), Some(from)) = (self.edge(h), fronts.skin.edge(h)) else { return };
        let slot = view.face_slots.slot(h.face());
        let depth = view.depth(h.face(), self.thickness);
        self.changes[slot].moved.add(to.clone());
        let (part, front) = (&mut self.parts[slot], &fronts.parts[slot]);
        if let Some(places) = fronts.outlines.edge(h) {
            let normals = view.normals(h.face());
            put_behind(part, to, front, from, depth, |i| unit(mix(normals, places[i]), normals[0]));
        } else {
            let course = Course::of(view, h);
            let normals = [view.normal(course.ends[0]), view.normal(course.ends[1])];
            let spots = &view.base.layout.edge;
            put_behind(part, to, front, from, depth, |i| unit(course.pick(spots, i).mix(normals), normals[0]));
        }
    }

    /// Puts the vertices behind those inside `f`, if there are any, in their places.
    #[inline]
    pub(super) fn follow_inside(&mut self, view: &View, fronts: &FineFronts, f: FaceId) {
        let (Some(to), Some(from)) = (self.inside(f), fronts.skin.inside(f)) else { return };
        let slot = view.face_slots.slot(f);
        let depth = view.depth(f, self.thickness);
        self.changes[slot].moved.add(to.clone());
        let (part, front) = (&mut self.parts[slot], &fronts.parts[slot]);
        let normals = view.normals(f);
        if let Some(places) = fronts.outlines.inside(f) {
            put_behind(part, to, front, from, depth, |i| unit(mix(normals, places[i]), normals[0]));
        } else {
            let spots = &view.base.layout.inside;
            put_behind(part, to, front, from, depth, |i| unit(mix(normals, spots[i].b), normals[0]));
        }
    }

    /// Moves the rim of `h`, if it has one, along the outline of its face.
    #[inline]
    pub(super) fn follow_rim(&mut self, view: &View, fronts: &FineFronts, h: HalfEdgeId) {
        let Some(vertices) = self.rims.vertices_of(h) else { return };
        let slot = view.face_slots.slot(h.face());
        self.rims.follow(view, fronts, self.thickness, h, &mut self.parts[slot]);
        self.changes[slot].moved.add(vertices);
    }
}

/// Returns whether `f` should have a back.
fn is_wanted(view: &View, forces: &FilmForces, f: FaceId) -> bool {
    let topology: &Topology = view.topology();
    topology.is_live(f) && !view.face_slots.is_hidden(f) && has_separated(topology, forces, f)
}

/// Puts vertices `depth` metres behind those of a front, against the `normal` of the film at each.
#[inline(always)]
fn put_behind(
    part: &mut MeshPart,
    to: std::ops::Range<usize>,
    front: &MeshPart,
    from: std::ops::Range<usize>,
    depth: f32,
    normal: impl Fn(usize) -> Vec3A,
) {
    let places = part.positions[to.clone()].iter_mut().zip(&mut part.normals[to]);
    let fronts = front.positions[from.clone()].iter().zip(&front.normals[from]);
    for (i, ((position, own), (in_front, shading))) in places.zip(fronts).enumerate() {
        *position = (Vec3A::from_array(*in_front) - normal(i) * depth).to_array();
        *own = shading.map(|x| -x);
    }
}
