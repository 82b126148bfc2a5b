//! Builds the fine bare metal: the prop's own surface where the film has separated or is gone, a little inwards.

use bevy_math::{Vec3, Vec4};

use super::{
    FINE_PIECE,
    base::Base,
    runs::Runs,
    skin::list_at_rest,
    stains::{edge_stains, mean_stains},
    view::{Course, View},
};
use crate::{
    appearance::{face_slots::has_separated, part::MeshPart, part_changes::PartChanges, seen::Seen},
    film::{FaceId, VertexId},
    fracture::FilmForces,
    rest::{Rest, pieces},
};

/// Entry of a wedge without metal.
const NONE: u32 = u32::MAX;

/// Bare metal of all slots. Faces share vertices as they do at rest, for metal does not tear.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct FineMetal {
    /// Vertices and triangles of the metal in each slot: the grids of the exposed faces.
    pub parts: Vec<MeshPart>,
    pub changes: Vec<PartChanges>,
    /// Vertex of each wedge at rest, or [`NONE`].
    corners: Vec<u32>,
    runs: Runs,
    /// Vertices of the face whose triangles are being written.
    vertices: Vec<u32>,
}

impl FineMetal {
    /// Returns the metal under a fresh film with `slots` slots.
    pub fn new(slots: usize, base: &Base) -> Self {
        Self {
            parts: vec![MeshPart::default(); slots],
            changes: vec![PartChanges::default(); slots],
            runs: Runs::new(&base.layout),
            ..Self::default()
        }
    }

    /// Brings the metal up to date with what is different about the film. It lies `depth` metres under the prop's
    /// surface.
    pub(super) async fn update(
        &mut self,
        view: &View<'_>,
        forces: &FilmForces,
        seen: &Seen,
        depth: f32,
        rest: &mut impl Rest,
    ) {
        let (topology, differences) = (view.topology(), &seen.differences);
        self.changes.iter_mut().for_each(|changes| changes.begin(differences.whole));
        if differences.whole {
            self.begin(view, forces);
            for piece in pieces(topology.face_count(), FINE_PIECE) {
                piece.map(FaceId::new).for_each(|f| self.show(view, forces, seen, depth, f));
                rest.rest().await;
            }
            return;
        }
        differences.exposed.iter().for_each(|&f| self.show(view, forces, seen, depth, f));
        if seen.looks.metal.any {
            let look = &seen.looks.metal;
            let has_changed = |v: VertexId| look.has_changed(topology.original(v).index());
            for f in topology.all_faces() {
                if self.runs.has(f) && topology.corners(f).into_iter().any(has_changed) {
                    self.stain(view, seen, f);
                }
            }
        }
    }

    /// Begins with nothing.
    fn begin(&mut self, view: &View, forces: &FilmForces) {
        let (topology, slots, layout) = (view.topology(), self.parts.len(), &view.base.layout);
        self.parts.iter_mut().for_each(MeshPart::clear);
        self.corners.clear();
        self.corners.resize(view.base.wedges().count(), NONE);
        self.runs.clear(topology.face_count(), slots);
        let mut counts = vec![0; slots];
        for f in topology.all_faces().filter(|&f| is_wanted(view, forces, f)) {
            counts[view.face_slots.slot(f)] += 1;
        }
        for (part, count) in self.parts.iter_mut().zip(counts) {
            // On a surface there are three edges and one corner for two faces.
            let vertices = count * layout.inner_points() + (3 * count * layout.edge_points() + count) / 2;
            view.base.reserve(part, vertices, 3 * count * layout.grid.triangles().len());
        }
    }

    /// Adds the grid of `f` if it is exposed, and removes it if it is not.
    fn show(&mut self, view: &View, forces: &FilmForces, seen: &Seen, depth: f32, f: FaceId) {
        let (topology, slot, flipped) = (view.topology(), view.face_slots.slot(f), view.face_slots.is_flipped(f));
        let wanted = is_wanted(view, forces, f);
        if wanted == self.runs.has(f) {
            return;
        }
        if !wanted {
            if let Some(indices) = self.runs.release_face(f, slot, &mut self.parts[slot]) {
                self.changes[slot].indices.add(indices);
            }
            return;
        }
        let inwards = if flipped { depth } else { -depth };
        let (base, part, changes) = (view.base, &mut self.parts[slot], &mut self.changes[slot]);
        let mut renew = |part: &mut MeshPart, vertex: usize, point: usize, normal: Vec3| {
            put(part, vertex, base, point, normal * inwards);
            changes.renewed.push(vertex);
            changes.moved.push(vertex);
        };
        let rest_normal = |v: VertexId| view.mesh.geometry.rest_normals[topology.original(v).index()];
        for h in f.half_edges() {
            let vertex = &mut self.corners[base.corner(h)];
            if *vertex == NONE {
                *vertex = part.positions.len() as u32;
                part.grow_to(part.positions.len() + 1);
                renew(part, *vertex as usize, base.corner(h), rest_normal(topology.origin(h)));
            }
            let lead = base.lead(topology, h);
            if self.runs.edge(lead).is_none() {
                self.runs.take_edge(lead, slot, part);
                let course = Course::of(view, lead);
                let [a, b] = course.ends.map(rest_normal);
                for (i, vertex) in self.runs.edge(lead).into_iter().flatten().enumerate() {
                    let [s, t] = course.pick(&base.layout.edge, i).shares;
                    renew(part, vertex, base.on_edge(lead, i), (a * s + b * t).normalize_or(a));
                }
            }
        }
        self.runs.take_face(f, slot, part);
        let (Some(indices), Some(inside)) = (self.runs.triangles(f), self.runs.inside(f)) else { return };
        let [p, q, r] = topology.corners(f).map(rest_normal);
        for ((i, vertex), spot) in inside.clone().enumerate().zip(&base.layout.inside) {
            let b = spot.b;
            renew(part, vertex, base.inside(f, i), (p * b.x + q * b.y + r * b.z).normalize_or(p));
        }
        let corner = |h| self.corners[base.corner(h)] as usize;
        let edge = |h| self.runs.edge(h).map_or(0, |range| range.start);
        list_at_rest(topology, base, f, corner, edge, inside.start, &mut self.vertices);
        base.put_triangles(part, &self.vertices, indices.start, flipped);
        self.changes[slot].indices.add(indices);
        self.stain(view, seen, f);
    }

    /// Writes the stains under `f`, which is shown.
    fn stain(&mut self, view: &View, seen: &Seen, f: FaceId) {
        let Self { parts, changes, corners, runs, .. } = self;
        let (topology, layout, slot) = (view.topology(), &view.base.layout, view.face_slots.slot(f));
        let stains = &seen.looks.metal.stains;
        let at = |v: VertexId| Vec4::from_array(stains[topology.original(v).index()]);
        let (to, stained) = (&mut parts[slot].stains, &mut changes[slot].stained);
        for h in f.half_edges() {
            let vertex = corners[view.base.corner(h)] as usize;
            to[vertex] = at(topology.origin(h)).to_array();
            stained.push(vertex);
            let lead = view.base.lead(topology, h);
            let course = Course::of(view, lead);
            let ends = course.ends.map(at);
            let vertices = runs.edge(lead).unwrap_or_default();
            for (i, to) in to[vertices.clone()].iter_mut().enumerate() {
                *to = edge_stains(&ends, course.pick(&layout.edge, i));
            }
            stained.add(vertices);
        }
        let ends = topology.corners(f).map(at);
        let vertices = runs.inside(f).unwrap_or_default();
        to[vertices.clone()].iter_mut().zip(&layout.inside).for_each(|(to, spot)| *to = mean_stains(&ends, spot.b));
        stained.add(vertices);
    }
}

/// Returns whether the metal under `f` should be shown.
fn is_wanted(view: &View, forces: &FilmForces, f: FaceId) -> bool {
    let topology = view.topology();
    let covered = topology.is_live(f) && !has_separated(topology, forces, f);
    !covered && !view.face_slots.is_hidden(f)
}

/// Puts what lies at a point of the base into a vertex, this far beside it.
fn put(part: &mut MeshPart, vertex: usize, base: &Base, point: usize, beside: Vec3) {
    let place = base.of(point);
    place.put(part, vertex);
    part.positions[vertex] = (place.position + beside).to_array();
    part.normals[vertex] = part.rest_normals[vertex];
}
