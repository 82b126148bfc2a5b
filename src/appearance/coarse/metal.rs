//! Builds the bare metal: the faces of the film at rest where it has separated or is gone, moved a little inwards.

use crate::appearance::{
    blocks::Blocks,
    corners::CornerAttributes,
    face_slots::{FaceSlots, has_separated},
    part::{MeshPart, set},
    part_changes::PartChanges,
    seen::Seen,
    wedges::RestWedges,
};
use crate::{
    film::{FaceId, FilmMesh, HalfEdgeId},
    fracture::FilmForces,
};

/// Entry of the lookup for a wedge that has no vertex yet.
const NONE: u32 = u32::MAX;

/// Bare metal of all slots.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Metal {
    /// Vertices and triangles of the metal in each slot.
    pub parts: Vec<MeshPart>,
    pub changes: Vec<PartChanges>,
    /// Place of each face's triangle.
    blocks: Blocks,
    /// Metal vertex of each wedge at rest, or [`NONE`].
    of_wedge: Vec<u32>,
    /// Corner of the film at rest above each metal vertex of each slot.
    corners: Vec<Vec<HalfEdgeId>>,
}

impl Metal {
    /// Returns the metal under a fresh film with `slots` slots.
    pub fn new(slots: usize) -> Self {
        Self {
            parts: vec![MeshPart::default(); slots],
            changes: vec![PartChanges::default(); slots],
            blocks: Blocks::new(0, 1),
            of_wedge: Vec::new(),
            corners: vec![Vec::new(); slots],
        }
    }

    /// Brings the metal up to date with what is different about the film. It lies `depth` metres under the film at
    /// rest.
    pub fn update(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        wedges: &RestWedges,
        attributes: &CornerAttributes,
        seen: &Seen,
        depth: f32,
    ) {
        let differences = &seen.differences;
        self.changes.iter_mut().for_each(|changes| changes.begin(differences.whole));
        if differences.whole {
            self.parts.iter_mut().for_each(MeshPart::clear);
            self.corners.iter_mut().for_each(Vec::clear);
            self.blocks.clear(mesh.topology.face_count(), self.parts.len());
            self.of_wedge.clear();
            self.of_wedge.resize(wedges.count(), NONE);
            mesh.topology.all_faces().for_each(|f| self.show(mesh, forces, face_slots, wedges, f));
        } else {
            differences.exposed.iter().for_each(|&f| self.show(mesh, forces, face_slots, wedges, f));
        }
        self.renew_vertices(mesh, face_slots, attributes, seen, depth);
        if seen.looks.metal.any {
            self.stain(mesh, seen);
        }
    }

    /// Adds the triangle of `f` if it is exposed, and removes it if it is not.
    fn show(&mut self, mesh: &FilmMesh, forces: &FilmForces, face_slots: &FaceSlots, wedges: &RestWedges, f: FaceId) {
        let Self { parts, changes, blocks, of_wedge, corners } = self;
        let covered = mesh.topology.is_live(f) && !has_separated(&mesh.topology, forces, f);
        let wanted = !covered && !face_slots.is_hidden(f);
        if wanted == blocks.get(f.index()).is_some() {
            return;
        }
        let slot = face_slots.slot(f);
        let (part, corners) = (&mut parts[slot], &mut corners[slot]);
        let block = if wanted {
            let block = blocks.take(f.index(), slot, part);
            let vertices = f.half_edges().map(|h| {
                let vertex = &mut of_wedge[wedges.at(h) as usize];
                if *vertex == NONE {
                    *vertex = corners.len() as u32;
                    corners.push(h);
                }
                *vertex
            });
            part.put_triangle(block.index as usize, vertices, face_slots.is_flipped(f));
            Some(block)
        } else {
            blocks.release(f.index(), slot, part)
        };
        if let Some(block) = block {
            changes[slot].indices.add(blocks.indices_of(block));
        }
    }

    /// Writes the vertices that are new.
    fn renew_vertices(
        &mut self,
        mesh: &FilmMesh,
        face_slots: &FaceSlots,
        attributes: &CornerAttributes,
        seen: &Seen,
        depth: f32,
    ) {
        for ((part, changes), corners) in self.parts.iter_mut().zip(&mut self.changes).zip(&self.corners) {
            let first = part.positions.len();
            part.grow_to(corners.len());
            for (i, &h) in corners.iter().enumerate().skip(first) {
                let v = mesh.topology.original(mesh.topology.origin(h)).index();
                let (position, outwards) = (mesh.geometry.rest_positions[v], mesh.geometry.rest_normals[v]);
                let depth = if face_slots.is_flipped(h.face()) { depth } else { -depth };
                part.positions[i] = (position + outwards * depth).to_array();
                part.normals[i] = attributes.normals[h.index()].to_array();
                part.rest[i] = position.to_array();
                part.rest_normals[i] = part.normals[i];
                part.stains[i] = seen.looks.metal.stains[v];
                set(&mut part.uvs, i, attributes.uvs.get(h.index()).map(|uv| uv.to_array()));
                set(&mut part.uvs_1, i, attributes.uvs_1.get(h.index()).map(|uv| uv.to_array()));
                set(&mut part.colors, i, attributes.colors.get(h.index()).map(|color| color.to_array()));
            }
            if first < corners.len() {
                changes.renewed.add(first..corners.len());
                changes.moved.add(first..corners.len());
                changes.stained.add(first..corners.len());
            }
        }
    }

    /// Writes the stains that changed.
    fn stain(&mut self, mesh: &FilmMesh, seen: &Seen) {
        let look = &seen.looks.metal;
        for ((part, changes), corners) in self.parts.iter_mut().zip(&mut self.changes).zip(&self.corners) {
            for (i, &h) in corners.iter().enumerate() {
                let v = mesh.topology.original(mesh.topology.origin(h)).index();
                if look.has_changed(v) {
                    part.stains[i] = look.stains[v];
                    changes.stained.push(i);
                }
            }
        }
    }
}
