//! Builds the backs of the flakes: the separated faces, wound the other way, one thickness of paint behind their
//! fronts.

use bevy_math::Vec3;

use super::fronts::Fronts;
use crate::appearance::{
    blocks::Blocks,
    face_slots::{FaceSlots, has_separated},
    part::MeshPart,
    part_changes::PartChanges,
    seen::Seen,
    wedges::Wedges,
};
use crate::{
    film::{FaceId, FilmMesh},
    fracture::FilmForces,
};

/// Entry of the lookups for a vertex that there is not.
const NONE: u32 = u32::MAX;

/// Backs of all slots.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Backs {
    /// Vertices and triangles of the backs in each slot.
    pub parts: Vec<MeshPart>,
    pub changes: Vec<PartChanges>,
    /// Place of each face's triangle.
    blocks: Blocks,
    vertices: Vec<BackVertices>,
}

/// Vertices of the backs in one slot.
#[derive(Clone, Debug, Default)]
struct BackVertices {
    /// Front vertex of each back vertex, which lies behind it; [`NONE`] for one that is free.
    fronts: Vec<u32>,
    /// Back vertex of each front vertex, or [`NONE`].
    of_front: Vec<u32>,
    free: Vec<u32>,
    /// Vertices that are new since the last update.
    new: Vec<u32>,
    /// Whether each front vertex moved in the last update.
    moved: Vec<bool>,
}

impl Backs {
    /// Returns the backs of a fresh film with `slots` slots.
    pub fn new(slots: usize) -> Self {
        Self {
            parts: vec![MeshPart::default(); slots],
            changes: vec![PartChanges::default(); slots],
            blocks: Blocks::new(0, 1),
            vertices: vec![BackVertices::default(); slots],
        }
    }

    /// Brings the backs up to date with what is different about the film. `fronts` must be up to date.
    pub fn update(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        wedges: &Wedges,
        seen: &Seen,
        fronts: &Fronts,
        thickness: f32,
    ) {
        let differences = &seen.differences;
        self.changes.iter_mut().for_each(|changes| changes.begin(differences.whole));
        self.vertices.iter_mut().for_each(|vertices| vertices.new.clear());
        if differences.whole {
            self.parts.iter_mut().for_each(MeshPart::clear);
            self.blocks.clear(mesh.topology.face_count(), self.parts.len());
            self.vertices.iter_mut().for_each(|vertices| *vertices = BackVertices::default());
        }
        for (vertices, front) in self.vertices.iter_mut().zip(&fronts.parts) {
            vertices.of_front.resize(front.positions.len(), NONE);
        }
        for (slot, vertices) in self.vertices.iter_mut().enumerate() {
            wedges.slot(slot).new.iter().for_each(|&front| vertices.release(front));
        }
        if differences.whole {
            mesh.topology.live_faces().for_each(|f| self.show(mesh, forces, face_slots, wedges, f));
        } else {
            for &f in &differences.exposed {
                self.show(mesh, forces, face_slots, wedges, f);
            }
            for h in &wedges.changed {
                self.lead(face_slots, wedges, h.face());
            }
        }
        self.renew_vertices(fronts);
        self.move_vertices(fronts, thickness);
    }

    /// Adds the triangle of `f` if it has separated, and removes it if it is gone.
    fn show(&mut self, mesh: &FilmMesh, forces: &FilmForces, face_slots: &FaceSlots, wedges: &Wedges, f: FaceId) {
        let topology = &mesh.topology;
        let wanted = topology.is_live(f) && !face_slots.is_hidden(f) && has_separated(topology, forces, f);
        let slot = face_slots.slot(f);
        let part = &mut self.parts[slot];
        match (wanted, self.blocks.get(f.index()).is_some()) {
            (true, false) => {
                self.blocks.take(f.index(), slot, part);
                self.lead(face_slots, wedges, f);
            }
            (false, true) => {
                if let Some(block) = self.blocks.release(f.index(), slot, part) {
                    self.changes[slot].indices.add(self.blocks.indices_of(block));
                }
            }
            _ => {}
        }
    }

    /// Leads the corners of `f`, if it is shown, to the backs of its front vertices.
    fn lead(&mut self, face_slots: &FaceSlots, wedges: &Wedges, f: FaceId) {
        let Some(block) = self.blocks.get(f.index()) else { return };
        let (slot, index) = (face_slots.slot(f), block.index as usize);
        let vertices = &mut self.vertices[slot];
        let corners = f.half_edges().map(|h| vertices.behind(wedges.vertex_of(h)));
        self.parts[slot].put_triangle(index, corners, !face_slots.is_flipped(f));
        self.changes[slot].indices.add(index..index + 3);
    }

    /// Copies the attributes of new vertices from their fronts, and of others the stains that changed.
    fn renew_vertices(&mut self, fronts: &Fronts) {
        let Self { parts, changes, vertices, .. } = self;
        for (slot, (part, changes)) in parts.iter_mut().zip(changes).enumerate() {
            let (front, front_changes) = (&fronts.parts[slot], &fronts.changes[slot]);
            let BackVertices { fronts, of_front, new, .. } = &vertices[slot];
            part.grow_to(fronts.len());
            for i in new.iter().map(|&i| i as usize) {
                let from = fronts[i] as usize;
                part.copy_coordinates(i, front, from);
                part.copy_stains(i, front, from);
                changes.renewed.push(i);
                changes.stained.push(i);
            }
            for from in front_changes.stained.ranges().flatten() {
                let back = of_front[from];
                if back != NONE {
                    part.stains[back as usize] = front.stains[from];
                    changes.stained.push(back as usize);
                }
            }
        }
    }

    /// Moves each back vertex whose front moved, and each new one, to `thickness` metres behind its front vertex.
    fn move_vertices(&mut self, fronts: &Fronts, thickness: f32) {
        let Self { parts, changes, vertices, .. } = self;
        for (slot, (part, changes)) in parts.iter_mut().zip(changes).enumerate() {
            let (front, front_changes) = (&fronts.parts[slot], &fronts.changes[slot]);
            let BackVertices { fronts, new, moved, .. } = &mut vertices[slot];
            if new.is_empty() && front_changes.moved.is_empty() {
                continue;
            }
            moved.clear();
            moved.resize(front.positions.len(), false);
            front_changes.moved.ranges().for_each(|range| moved[range].fill(true));
            new.iter().for_each(|&i| moved[fronts[i as usize] as usize] = true);
            for (i, &from) in fronts.iter().enumerate() {
                if from == NONE || !moved[from as usize] {
                    continue;
                }
                let normal = Vec3::from_array(front.normals[from as usize]);
                let position = Vec3::from_array(front.positions[from as usize]);
                part.positions[i] = (position - normal * thickness).to_array();
                part.normals[i] = (-normal).to_array();
                changes.moved.push(i);
            }
        }
    }
}

impl BackVertices {
    /// Returns the vertex behind `front`, which is new if there was none.
    fn behind(&mut self, front: u32) -> u32 {
        let Self { fronts, of_front, free, new, .. } = self;
        let back = &mut of_front[front as usize];
        if *back == NONE {
            *back = free.pop().unwrap_or(fronts.len() as u32);
            if *back as usize == fronts.len() {
                fronts.push(front);
            } else {
                fronts[*back as usize] = front;
            }
            new.push(*back);
        }
        *back
    }

    /// Frees the vertex behind `front`, which stands for another place of the film from now on.
    fn release(&mut self, front: u32) {
        let back = std::mem::replace(&mut self.of_front[front as usize], NONE);
        if back != NONE {
            self.fronts[back as usize] = NONE;
            self.free.push(back);
        }
    }
}
