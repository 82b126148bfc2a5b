//! Builds the backs of fine flakes, one thickness of paint behind their fronts.

use super::{
    base::Base,
    fronts::FineFronts,
    lanes::{LANES, spread},
    rims::{Backside, Rims},
    vertex_frames::VertexFrames,
};
use crate::{
    appearance::{
        blocks::Blocks,
        face_slots::{FaceSlots, has_separated},
        part::MeshPart,
        part_changes::PartChanges,
        seen::Seen,
    },
    film::{FaceGrid, FaceId, FilmMesh},
    fracture::FilmForces,
};

/// Backs and rims of all slots.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct FineBacks {
    /// Vertices and triangles in each slot.
    pub parts: Vec<MeshPart>,
    pub changes: Vec<PartChanges>,
    /// Place of each face's back.
    blocks: Blocks,
    rims: Rims,
    /// Faces whose back or rims may be new.
    new: Vec<FaceId>,
    /// Normals of the face that is being moved.
    normals: Vec<[f32; 3]>,
}

impl FineBacks {
    /// Returns the backs of a fresh film with `slots` slots.
    pub fn new(slots: usize, grid: &FaceGrid) -> Self {
        Self {
            parts: vec![MeshPart::default(); slots],
            changes: vec![PartChanges::default(); slots],
            blocks: Blocks::new(grid.points().len(), grid.triangles().len()),
            rims: Rims::new(grid),
            new: Vec::new(),
            normals: vec![[0.0; 3]; grid.points().len()],
        }
    }

    /// Brings the backs up to date with what is different about the film. `fronts` must be up to date. Backs lie
    /// `thickness` metres behind them, along the normals of the film.
    pub(super) fn update(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        base: &Base,
        frames: &VertexFrames,
        seen: &Seen,
        fronts: &FineFronts,
        thickness: f32,
    ) {
        let (topology, differences) = (&mesh.topology, &seen.differences);
        self.changes.iter_mut().for_each(|changes| changes.begin(differences.whole));
        self.new.clear();
        if differences.whole {
            self.parts.iter_mut().for_each(MeshPart::clear);
            self.blocks.clear(topology.face_count(), self.parts.len());
            self.rims.clear(mesh, self.parts.len());
            self.new.extend(topology.live_faces());
        } else {
            self.new.extend_from_slice(&differences.exposed);
            self.new.extend(differences.tears.iter().map(|h| h.face()));
        }
        for i in 0..self.new.len() {
            self.show(mesh, forces, face_slots, base, self.new[i]);
        }
        self.copy(face_slots, base, fronts);
        for &f in self.new.iter().chain(&fronts.bent) {
            let slot = face_slots.slot(f);
            let Some(block) = self.blocks.get(f.index()) else { continue };
            let corners = mesh.topology.corners(f).map(|v| frames.normals[v.index()].into());
            for (places, normals) in fronts.outlines.places(base, f).iter().zip(self.normals.chunks_mut(LANES)) {
                spread(&places.mean(corners), normals);
            }
            let depth = if face_slots.is_flipped(f) { -thickness } else { thickness };
            let side = Backside { depth, normals: &self.normals };
            let (part, changes, front) = (&mut self.parts[slot], &mut self.changes[slot], &fronts.parts[slot]);
            let vertices = self.blocks.vertices_of(block);
            for ((from, to), normal) in fronts.vertices_of(base, f).zip(vertices.clone()).zip(side.normals) {
                part.positions[to] = std::array::from_fn(|i| front.positions[from][i] - normal[i] * depth);
                part.normals[to] = front.normals[from].map(|x| -x);
            }
            changes.moved.add(vertices);
            for h in f.half_edges() {
                self.rims.follow(front, &side, base, fronts.first[f.index()] as usize, h, part);
                if let Some(vertices) = self.rims.vertices_of(h) {
                    changes.moved.add(vertices);
                }
            }
        }
    }

    /// Copies the attributes of new vertices and of chipped faces from their fronts, and the stains that changed.
    fn copy(&mut self, face_slots: &FaceSlots, base: &Base, fronts: &FineFronts) {
        let Self { parts, changes, blocks, rims, new, .. } = self;
        let renewed = new.iter().chain(&fronts.chipped).map(|&f| (f, true));
        for (f, renewed) in renewed.chain(fronts.stained.iter().map(|&f| (f, false))) {
            let Some(block) = blocks.get(f.index()) else { continue };
            let slot = face_slots.slot(f);
            let (part, changes, front) = (&mut parts[slot], &mut changes[slot], &fronts.parts[slot]);
            let back = blocks.vertices_of(block).zip(fronts.vertices_of(base, f));
            let rims = f.half_edges().into_iter().flat_map(|h| rims.pairs(base, fronts, h));
            for (to, from) in back.chain(rims) {
                if renewed {
                    part.copy_coordinates(to, front, from);
                    changes.renewed.push(to);
                }
                part.copy_stains(to, front, from);
                changes.stained.push(to);
            }
        }
    }

    /// Adds back and rims to `f` if it has separated, and removes those that it should not have.
    fn show(&mut self, mesh: &FilmMesh, forces: &FilmForces, face_slots: &FaceSlots, base: &Base, f: FaceId) {
        let topology = &mesh.topology;
        let wanted = topology.is_live(f) && !face_slots.is_hidden(f) && has_separated(topology, forces, f);
        let slot = face_slots.slot(f);
        let (part, changes) = (&mut self.parts[slot], &mut self.changes[slot]);
        match (wanted, self.blocks.get(f.index()).is_some()) {
            (true, false) => {
                let block = self.blocks.take(f.index(), slot, part);
                base.put_triangles(part, block.vertex, block.index, !face_slots.is_flipped(f));
                changes.indices.add(self.blocks.indices_of(block));
            }
            (false, true) => {
                if let Some(block) = self.blocks.release(f.index(), slot, part) {
                    changes.indices.add(self.blocks.indices_of(block));
                }
            }
            _ => {}
        }
        for h in f.half_edges() {
            self.rims.show(mesh, forces, face_slots, wanted, base, h, part, changes);
        }
    }
}
