//! Builds the fronts of the film: its live faces, with the prop's own attributes at their corners.

use crate::appearance::{
    blocks::Blocks,
    corners::CornerAttributes,
    face_slots::FaceSlots,
    part::{MeshPart, set},
    part_changes::PartChanges,
    seen::Seen,
    wedges::Wedges,
};
use crate::film::{FilmMesh, HalfEdgeId};

/// Fronts of all slots.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Fronts {
    /// Vertices and triangles of the front of each slot.
    pub parts: Vec<MeshPart>,
    pub changes: Vec<PartChanges>,
    /// Place of each face's triangle.
    blocks: Blocks,
}

impl Fronts {
    /// Returns fronts without faces in `slots` slots.
    pub fn new(slots: usize) -> Self {
        Self {
            parts: vec![MeshPart::default(); slots],
            changes: vec![PartChanges::default(); slots],
            blocks: Blocks::new(0, 1),
        }
    }

    /// Brings the fronts up to date with what is different about the film.
    pub fn update(
        &mut self,
        mesh: &FilmMesh,
        face_slots: &FaceSlots,
        attributes: &CornerAttributes,
        wedges: &Wedges,
        seen: &Seen,
    ) {
        self.changes.iter_mut().for_each(|changes| changes.begin(seen.differences.whole));
        if seen.differences.whole {
            self.parts.iter_mut().for_each(MeshPart::clear);
            self.blocks.clear(mesh.topology.face_count(), self.parts.len());
        }
        self.renew_vertices(mesh, attributes, wedges, seen);
        self.renew_triangles(mesh, face_slots, wedges, seen);
        self.move_vertices(attributes, wedges, seen);
        // All vertices of new fronts are new.
        if seen.looks.film.any && !seen.differences.whole {
            self.stain(wedges, seen);
        }
    }

    /// Writes what does not change as the film moves of each new vertex, and its stains.
    fn renew_vertices(&mut self, mesh: &FilmMesh, attributes: &CornerAttributes, wedges: &Wedges, seen: &Seen) {
        for (slot, (part, changes)) in self.parts.iter_mut().zip(&mut self.changes).enumerate() {
            let vertices = wedges.slot(slot);
            part.grow_to(vertices.film.len());
            for &vertex in &vertices.new {
                let (i, h) = (vertex as usize, vertices.corners[vertex as usize]);
                let v = mesh.topology.origin(h);
                set(&mut part.uvs, i, attributes.uvs.get(h.index()).map(|uv| uv.to_array()));
                set(&mut part.uvs_1, i, attributes.uvs_1.get(h.index()).map(|uv| uv.to_array()));
                set(&mut part.colors, i, attributes.colors.get(h.index()).map(|color| color.to_array()));
                set(&mut part.tangents, i, attributes.tangents.get(h.index()).map(|tangent| tangent.to_array()));
                part.rest[i] = mesh.geometry.rest_positions[v.index()].to_array();
                part.rest_normals[i] = attributes.normals[h.index()].to_array();
                part.stains[i] = seen.looks.film.stains[v.index()];
                changes.renewed.push(i);
                changes.stained.push(i);
            }
        }
    }

    /// Adds and removes triangles, and leads their corners to other vertices.
    fn renew_triangles(&mut self, mesh: &FilmMesh, face_slots: &FaceSlots, wedges: &Wedges, seen: &Seen) {
        let Self { parts, changes, blocks } = self;
        if seen.differences.whole {
            for f in mesh.topology.live_faces().filter(|&f| !face_slots.is_hidden(f)) {
                let slot = face_slots.slot(f);
                let block = blocks.take(f.index(), slot, &mut parts[slot]);
                let corners = f.half_edges().map(|h| wedges.vertex_of(h));
                parts[slot].put_triangle(block.index as usize, corners, face_slots.is_flipped(f));
            }
            return;
        }
        for &f in &seen.differences.gone {
            let slot = face_slots.slot(f);
            if let Some(block) = blocks.release(f.index(), slot, &mut parts[slot]) {
                changes[slot].indices.add(blocks.indices_of(block));
            }
        }
        for f in wedges.changed.iter().map(|h| h.face()) {
            if let Some(block) = blocks.get(f.index()) {
                let (slot, index) = (face_slots.slot(f), block.index as usize);
                let corners = f.half_edges().map(|h| wedges.vertex_of(h));
                parts[slot].put_triangle(index, corners, face_slots.is_flipped(f));
                changes[slot].indices.add(index..index + 3);
            }
        }
    }

    /// Writes positions, normals and tangents of the vertices whose faces moved.
    fn move_vertices(&mut self, attributes: &CornerAttributes, wedges: &Wedges, seen: &Seen) {
        if !seen.moved {
            return;
        }
        for (slot, (part, changes)) in self.parts.iter_mut().zip(&mut self.changes).enumerate() {
            let vertices = wedges.slot(slot);
            let own = vertices.corners.iter().zip(&vertices.film);
            let places = part.positions.iter_mut().zip(&mut part.normals);
            for (i, ((&h, &v), (position, normal))) in own.zip(places).enumerate() {
                if h == HalfEdgeId::NONE || !seen.moves.is_turned(v) {
                    continue;
                }
                let turn = seen.frames.turn(v);
                *position = seen.moves.positions()[v.index()].to_array();
                *normal = turn.apply(attributes.normals[h.index()]).to_array();
                if let Some(tangent) = part.tangents.get_mut(i) {
                    let rest = attributes.tangents[h.index()];
                    *tangent = turn.apply(rest.truncate()).extend(rest.w).to_array();
                }
                changes.moved.push(i);
            }
        }
    }

    /// Writes the stains that changed.
    fn stain(&mut self, wedges: &Wedges, seen: &Seen) {
        let look = &seen.looks.film;
        for (slot, (part, changes)) in self.parts.iter_mut().zip(&mut self.changes).enumerate() {
            for (i, v) in wedges.slot(slot).film.iter().enumerate() {
                if v.get().is_some_and(|v| look.has_changed(v.index())) {
                    part.stains[i] = look.stains[v.index()];
                    changes.stained.push(i);
                }
            }
        }
    }
}
