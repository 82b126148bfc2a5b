//! Builds the fine bare metal: the prop's own surface where the film has separated or is gone, a little inwards.

use super::{base::Base, mean_stains};
use crate::{
    appearance::{
        blocks::Blocks,
        corners::CornerAttributes,
        face_slots::{FaceSlots, has_separated},
        part::{MeshPart, set},
        part_changes::PartChanges,
        seen::Seen,
    },
    film::{FaceGrid, FaceId, FilmMesh},
    fracture::FilmForces,
};

/// Bare metal of all slots.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct FineMetal {
    /// Vertices and triangles of the metal in each slot: the grids of the exposed faces.
    pub parts: Vec<MeshPart>,
    pub changes: Vec<PartChanges>,
    blocks: Blocks,
}

impl FineMetal {
    /// Returns the metal under a fresh film with `slots` slots.
    pub fn new(slots: usize, grid: &FaceGrid) -> Self {
        Self {
            parts: vec![MeshPart::default(); slots],
            changes: vec![PartChanges::default(); slots],
            blocks: Blocks::new(grid.points().len(), grid.triangles().len()),
        }
    }

    /// Brings the metal up to date with what is different about the film. It lies `depth` metres under the prop's
    /// surface.
    pub fn update(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        base: &Base,
        seen: &Seen,
        depth: f32,
    ) {
        let (topology, differences) = (&mesh.topology, &seen.differences);
        self.changes.iter_mut().for_each(|changes| changes.begin(differences.whole));
        if differences.whole {
            self.parts.iter_mut().for_each(MeshPart::clear);
            self.blocks.clear(topology.face_count(), self.parts.len());
            topology.all_faces().for_each(|f| self.show(mesh, forces, face_slots, base, seen, depth, f));
            return;
        }
        differences.exposed.iter().for_each(|&f| self.show(mesh, forces, face_slots, base, seen, depth, f));
        if seen.looks.metal.any {
            let look = &seen.looks.metal;
            let has_changed =
                |f: &FaceId| topology.corners(*f).iter().any(|&v| look.has_changed(topology.original(v).index()));
            topology.all_faces().filter(has_changed).for_each(|f| self.stain(mesh, face_slots, base, seen, f));
        }
    }

    /// Adds the grid of `f` if it is exposed, and removes it if it is not.
    fn show(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        base: &Base,
        seen: &Seen,
        depth: f32,
        f: FaceId,
    ) {
        let Self { parts, changes, blocks } = self;
        let topology = &mesh.topology;
        let covered = topology.is_live(f) && !has_separated(topology, forces, f);
        let wanted = !covered && !face_slots.is_hidden(f);
        let (slot, flipped) = (face_slots.slot(f), face_slots.is_flipped(f));
        let (part, changes) = (&mut parts[slot], &mut changes[slot]);
        if wanted == blocks.get(f.index()).is_some() {
            return;
        }
        if !wanted {
            if let Some(block) = blocks.release(f.index(), slot, part) {
                changes.indices.add(blocks.indices_of(block));
            }
            return;
        }
        let block = blocks.take(f.index(), slot, part);
        base.put_triangles(part, block.vertex, block.index, flipped);
        let corners = topology.corners(f).map(|v| mesh.geometry.rest_normals[topology.original(v).index()]);
        let inwards = if flipped { depth } else { -depth };
        let CornerAttributes { normals, uvs, uvs_1, colors, .. } = &base.attributes;
        for (i, b) in base.grid.points().iter().enumerate() {
            let (from, to) = (base.index(f, i), block.vertex as usize + i);
            let normal = (corners[0] * b.x + corners[1] * b.y + corners[2] * b.z).normalize_or(corners[0]);
            part.positions[to] = (base.positions[from] + normal * inwards).to_array();
            part.normals[to] = normals[from].to_array();
            part.rest[to] = base.positions[from].to_array();
            part.rest_normals[to] = normals[from].to_array();
            set(&mut part.uvs, to, uvs.get(from).map(|uv| uv.to_array()));
            set(&mut part.uvs_1, to, uvs_1.get(from).map(|uv| uv.to_array()));
            set(&mut part.colors, to, colors.get(from).map(|color| color.to_array()));
        }
        let vertices = blocks.vertices_of(block);
        changes.renewed.add(vertices.clone());
        changes.moved.add(vertices);
        changes.indices.add(blocks.indices_of(block));
        self.stain(mesh, face_slots, base, seen, f);
    }

    /// Writes the stains under `f`, if it is shown.
    fn stain(&mut self, mesh: &FilmMesh, face_slots: &FaceSlots, base: &Base, seen: &Seen, f: FaceId) {
        let Some(block) = self.blocks.get(f.index()) else { return };
        let (slot, vertices) = (face_slots.slot(f), self.blocks.vertices_of(block));
        let corners = mesh.topology.corners(f).map(|v| mesh.topology.original(v).index());
        let corners = corners.map(|v| seen.looks.metal.stains[v]);
        for (to, &b) in self.parts[slot].stains[vertices.clone()].iter_mut().zip(base.grid.points()) {
            *to = mean_stains(&corners, b);
        }
        self.changes[slot].stained.add(vertices);
    }
}
