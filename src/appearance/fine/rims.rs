//! Builds the rims, which join fronts and backs along cracks.

use bevy_math::Vec3A;

use super::{
    fronts::FineFronts,
    view::{Course, View, mix, unit},
};
use crate::{
    appearance::{
        blocks::{Block, Blocks},
        part::MeshPart,
        part_changes::PartChanges,
    },
    film::{FaceGrid, FaceId, HalfEdgeId, Topology},
    fracture::FilmForces,
};

/// Rims of all slots, in the parts of the backs: two rows of vertices along the edge, at the front and at the back.
#[derive(Clone, Debug, Default)]
pub(super) struct Rims {
    blocks: Blocks,
    /// Number of rims of each face.
    counts: Vec<u8>,
    /// Number of vertices in a row.
    row: usize,
}

impl Rims {
    /// Returns no rims.
    pub fn new(grid: &FaceGrid) -> Self {
        let row = grid.edge(0).len();
        Self { blocks: Blocks::new(2 * row, 2 * (row - 1)), counts: Vec::new(), row }
    }

    /// Removes all rims.
    pub fn clear(&mut self, topology: &Topology, slots: usize) {
        self.blocks.clear(topology.half_edge_count(), slots);
        self.counts.clear();
        self.counts.resize(topology.face_count(), 0);
    }

    fn get(&self, h: HalfEdgeId) -> Option<Block> {
        self.blocks.get(h.index())
    }

    /// Returns whether `f` has rims.
    #[inline]
    pub fn any(&self, f: FaceId) -> bool {
        self.counts[f.index()] > 0
    }

    /// Returns the vertices of the rim of `h`, if it has one.
    #[inline]
    pub fn vertices_of(&self, h: HalfEdgeId) -> Option<std::ops::Range<usize>> {
        self.get(h).map(|block| self.blocks.vertices_of(block))
    }

    /// Adds a rim to `h` if its face has a back and it is a free edge between vertices that have separated; otherwise
    /// removes it. Returns whether it is new.
    pub fn show(
        &mut self,
        view: &View,
        forces: &FilmForces,
        has_back: bool,
        h: HalfEdgeId,
        part: &mut MeshPart,
        changes: &mut PartChanges,
    ) -> bool {
        let (topology, slot) = (view.topology(), view.face_slots.slot(h.face()));
        let ends = [topology.origin(h), topology.target(h)];
        let is_free = topology.bound_twin(h).is_none() && !ends.iter().any(|&v| forces.is_attached(v));
        let wanted = has_back && is_free;
        if wanted == self.get(h).is_some() {
            return false;
        }
        if !wanted {
            if let Some(block) = self.blocks.release(h.index(), slot, part) {
                changes.indices.add(self.blocks.indices_of(block));
                self.counts[h.face().index()] -= 1;
            }
            return false;
        }
        let block = self.blocks.take(h.index(), slot, part);
        self.counts[h.face().index()] += 1;
        let row = self.row as u32;
        for i in 0..row - 1 {
            let (top, bottom, index) = (block.vertex + i, block.vertex + i + row, (block.index + 6 * i) as usize);
            let flipped = view.face_slots.is_flipped(h.face());
            part.put_triangle(index, [top, bottom, bottom + 1], flipped);
            part.put_triangle(index + 3, [top, bottom + 1, top + 1], flipped);
        }
        changes.indices.add(self.blocks.indices_of(block));
        true
    }

    /// Returns the vertex of the front at each point of a row of the rim of `h`.
    fn fronts(&self, view: &View, fronts: &FineFronts, h: HalfEdgeId) -> impl Iterator<Item = usize> + Clone + use<> {
        let (skin, slot) = (&fronts.skin, view.face_slots.slot(h.face()));
        let [first, last] = [h, h.next()].map(|h| skin.corner(slot, h));
        std::iter::once(first).chain(skin.edge(h).unwrap_or_default()).chain(std::iter::once(last))
    }

    /// Copies attributes, stains and places at rest of the rim of `h`, if it has one, from the front.
    pub fn copy(
        &self,
        view: &View,
        fronts: &FineFronts,
        h: HalfEdgeId,
        part: &mut MeshPart,
        changes: &mut PartChanges,
    ) {
        let Some(vertices) = self.vertices_of(h) else { return };
        let front = &fronts.parts[view.face_slots.slot(h.face())];
        changes.renewed.add(vertices.clone());
        changes.stained.add(vertices.clone());
        let row = self.fronts(view, fronts, h);
        for (to, from) in vertices.zip(row.clone().chain(row)) {
            part.copy_coordinates(to, front, from);
            part.copy_stains(to, front, from);
        }
    }

    /// Copies the stains of the rim of `h`, if it has one, from the front.
    pub fn stain(
        &self,
        view: &View,
        fronts: &FineFronts,
        h: HalfEdgeId,
        part: &mut MeshPart,
        changes: &mut PartChanges,
    ) {
        let Some(vertices) = self.vertices_of(h) else { return };
        let front = &fronts.parts[view.face_slots.slot(h.face())];
        changes.stained.add(vertices.clone());
        let row = self.fronts(view, fronts, h);
        for (to, from) in vertices.zip(row.clone().chain(row)) {
            part.stains[to] = front.stains[from];
        }
    }

    /// Moves the rim of `h`, if it has one, along the outline of its face. Its back lies `thickness` behind its front.
    pub fn follow(&self, view: &View, fronts: &FineFronts, thickness: f32, h: HalfEdgeId, part: &mut MeshPart) {
        let Some(block) = self.get(h) else { return };
        let front = &fronts.parts[view.face_slots.slot(h.face())];
        let depth = view.depth(h.face(), thickness);
        let place = |vertex: usize| Vec3A::from_array(front.positions[vertex]);
        let mut row = self.fronts(view, fronts, h).peekable();
        let mut before = None;
        let mut i = 0;
        while let Some(vertex) = row.next() {
            let (own, normal) = (place(vertex), self.normal(view, fronts, h, i));
            let after = row.peek().map_or(own, |&next| place(next));
            let aside = unit((after - before.unwrap_or(own)).cross(normal), normal);
            let shading = Vec3A::from_array(front.normals[vertex]);
            let top = block.vertex as usize + i;
            let bottom = top + self.row;
            part.positions[top] = own.to_array();
            part.normals[top] = unit(shading + aside, aside).to_array();
            part.positions[bottom] = (own - normal * depth).to_array();
            part.normals[bottom] = unit(aside - shading, aside).to_array();
            before = Some(own);
            i += 1;
        }
    }

    /// Returns the normal of the film at the point `i` of a row of the rim of `h`.
    fn normal(&self, view: &View, fronts: &FineFronts, h: HalfEdgeId, i: usize) -> Vec3A {
        let topology = view.topology();
        if i == 0 {
            return view.normal(topology.origin(h));
        }
        if i + 1 == self.row {
            return view.normal(topology.target(h));
        }
        let normals = view.normals(h.face());
        if let Some(places) = fronts.outlines.edge(h) {
            return unit(mix(normals, places[i - 1]), normals[0]);
        }
        let course = Course::of(view, h);
        unit(
            course.pick(&view.base.layout.edge, i - 1).mix([view.normal(course.ends[0]), view.normal(course.ends[1])]),
            normals[0],
        )
    }
}
