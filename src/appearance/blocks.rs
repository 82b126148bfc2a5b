//! Gives faces and rims their place in a part: a block of vertices and triangles that is theirs while they are shown.
//!
//! A face that goes leaves a hole of triangles without area, which the next one that comes takes, so nothing else is
//! numbered afresh.

use super::part::MeshPart;

/// Place of a block in a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Block {
    /// First vertex.
    pub vertex: u32,
    /// First index.
    pub index: u32,
}

/// Entry of what is not shown.
const NONE: Block = Block { vertex: u32::MAX, index: u32::MAX };

/// Blocks of equal size of all slots' parts.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    /// Number of vertices of a block: 0 where vertices are shared.
    vertices: usize,
    /// Number of indices of a block.
    indices: usize,
    of: Vec<Block>,
    /// Holes in each slot's part.
    free: Vec<Vec<Block>>,
}

impl Blocks {
    /// Returns no blocks, which will have so many vertices and triangles each.
    pub fn new(vertices: usize, triangles: usize) -> Self {
        Self { vertices, indices: 3 * triangles, ..Self::default() }
    }

    /// Takes all blocks away from `keys` keys in `slots` slots.
    pub fn clear(&mut self, keys: usize, slots: usize) {
        self.of.clear();
        self.of.resize(keys, NONE);
        self.free.resize_with(slots, Vec::new);
        self.free.iter_mut().for_each(Vec::clear);
    }

    /// Returns the block of `key`, if it is shown.
    #[inline]
    pub fn get(&self, key: usize) -> Option<Block> {
        self.of.get(key).copied().filter(|&block| block != NONE)
    }

    /// Returns the vertices of a block.
    #[inline]
    pub fn vertices_of(&self, block: Block) -> std::ops::Range<usize> {
        block.vertex as usize..block.vertex as usize + self.vertices
    }

    /// Returns the indices of a block.
    #[inline]
    pub fn indices_of(&self, block: Block) -> std::ops::Range<usize> {
        block.index as usize..block.index as usize + self.indices
    }

    /// Gives `key` a block in the part of slot `slot`, which grows if there is no hole.
    pub fn take(&mut self, key: usize, slot: usize, part: &mut MeshPart) -> Block {
        let block = self.free[slot].pop().unwrap_or_else(|| {
            let vertex = part.positions.len();
            part.grow_to(vertex + self.vertices);
            Block { vertex: vertex as u32, index: part.add_indices(self.indices) as u32 }
        });
        self.of[key] = block;
        block
    }

    /// Takes the block away from `key` and leaves a hole in the part of slot `slot`. Returns the block, if it had one.
    pub fn release(&mut self, key: usize, slot: usize, part: &mut MeshPart) -> Option<Block> {
        let block = self.get(key)?;
        self.of[key] = NONE;
        self.free[slot].push(block);
        let indices = &mut part.indices[block.index as usize..][..self.indices];
        indices.fill(indices.first().copied().unwrap_or_default());
        Some(block)
    }
}
