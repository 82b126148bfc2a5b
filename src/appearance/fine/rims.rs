//! Builds the rims, which join fronts and backs along cracks.

use bevy_math::Vec3A;

use super::{base::Base, fronts::FineFronts, unit};
use crate::{
    appearance::{
        blocks::{Block, Blocks},
        face_slots::FaceSlots,
        part::MeshPart,
        part_changes::PartChanges,
    },
    film::{FaceGrid, FilmMesh, HalfEdgeId},
    fracture::FilmForces,
};

/// Rims of all slots, in the parts of the backs: two rows of vertices along the edge, at the front and at the back.
#[derive(Clone, Debug, Default)]
pub(super) struct Rims {
    blocks: Blocks,
}

/// The back of one face.
pub(super) struct Backside<'a> {
    /// Thickness of the paint, against the normals of the film.
    pub depth: f32,
    /// Unit normal of the film at each point of the face, outwards as the prop has it.
    pub normals: &'a [[f32; 3]],
}

impl Rims {
    /// Returns no rims.
    pub fn new(grid: &FaceGrid) -> Self {
        let row = grid.edge(0).len();
        Self { blocks: Blocks::new(2 * row, 2 * (row - 1)) }
    }

    /// Removes all rims.
    pub fn clear(&mut self, mesh: &FilmMesh, slots: usize) {
        self.blocks.clear(mesh.topology.half_edge_count(), slots);
    }

    fn get(&self, h: HalfEdgeId) -> Option<Block> {
        self.blocks.get(h.index())
    }

    /// Returns the vertices of the rim of `h`, if it has one.
    pub fn vertices_of(&self, h: HalfEdgeId) -> Option<std::ops::Range<usize>> {
        self.get(h).map(|block| self.blocks.vertices_of(block))
    }

    /// Adds a rim to `h` if its face has a back and it is a free edge between vertices that have separated; otherwise
    /// removes it.
    pub fn show(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        has_back: bool,
        base: &Base,
        h: HalfEdgeId,
        part: &mut MeshPart,
        changes: &mut PartChanges,
    ) {
        let (topology, slot) = (&mesh.topology, face_slots.slot(h.face()));
        let ends = [topology.origin(h), topology.target(h)];
        let is_free = topology.bound_twin(h).is_none() && !ends.iter().any(|&v| forces.is_attached(v));
        let wanted = has_back && is_free;
        if wanted == self.get(h).is_some() {
            return;
        }
        if !wanted {
            if let Some(block) = self.blocks.release(h.index(), slot, part) {
                changes.indices.add(self.blocks.indices_of(block));
            }
            return;
        }
        let block = self.blocks.take(h.index(), slot, part);
        let row = base.grid.edge(h.index() % 3).len() as u32;
        for i in 0..row - 1 {
            let (top, bottom, index) = (block.vertex + i, block.vertex + i + row, (block.index + 6 * i) as usize);
            let flipped = face_slots.is_flipped(h.face());
            part.put_triangle(index, [top, bottom, bottom + 1], flipped);
            part.put_triangle(index + 3, [top, bottom + 1, top + 1], flipped);
        }
        changes.indices.add(self.blocks.indices_of(block));
    }

    /// Returns each vertex of the rim of `h`, if it has one, and the vertex of the front that it belongs to.
    pub fn pairs<'a>(
        &'a self,
        base: &'a Base,
        fronts: &FineFronts,
        h: HalfEdgeId,
    ) -> impl Iterator<Item = (usize, usize)> + use<'a> {
        let first = fronts.first[h.face().index()] as usize;
        let edge = base.grid.edge(h.index() % 3);
        let both = edge.iter().chain(edge).map(move |&point| first + point as usize);
        self.vertices_of(h).into_iter().flatten().zip(both)
    }

    /// Moves the rim of `h` along the outline of its face.
    pub fn follow(
        &self,
        front: &MeshPart,
        side: &Backside,
        base: &Base,
        first: usize,
        h: HalfEdgeId,
        part: &mut MeshPart,
    ) {
        let Some(block) = self.get(h) else { return };
        let edge = base.grid.edge(h.index() % 3);
        let place = |i: usize| Vec3A::from_array(front.positions[first + edge[i] as usize]);
        for (i, &point) in edge.iter().enumerate() {
            let (before, after) = (i.saturating_sub(1), (i + 1).min(edge.len() - 1));
            let normal = Vec3A::from_array(side.normals[point as usize]);
            let aside = unit((place(after) - place(before)).cross(normal), normal);
            let vertex = first + point as usize;
            let shading = Vec3A::from_array(front.normals[vertex]);
            let top = block.vertex as usize + i;
            let bottom = top + edge.len();
            part.positions[top] = front.positions[vertex];
            part.normals[top] = unit(shading + aside, aside).to_array();
            part.positions[bottom] = (place(i) - normal * side.depth).to_array();
            part.normals[bottom] = unit(aside - shading, aside).to_array();
        }
    }
}
