//! Reads each accessor once, and no more of them together than the file can mean.

use std::{cell::Cell, cell::RefCell, collections::BTreeMap, rc::Rc};

use super::{GltfError, container::Container, document::lookup};

/// Elements that all accessors together may have for each byte of the buffers. One takes a byte at least; accessors
/// that share bytes are common, but not that many of them.
const ELEMENTS_A_BYTE: u64 = 4;
/// Elements that they may have in any case.
const LEAST_ELEMENTS: u64 = 1 << 16;

/// Accessors that were read, by their index. Primitives of one mesh, and meshes of several nodes, often share them.
pub struct Cache<'a> {
    pub container: &'a Container<'a>,
    pairs: Read<[f32; 2]>,
    triples: Read<[f32; 3]>,
    quadruples: Read<[f32; 4]>,
    colors: Read<[f32; 4]>,
    indices: Read<u32>,
    /// Elements read so far.
    elements: Cell<u64>,
    limit: u64,
}

/// Elements of accessors that were read.
type Read<T> = RefCell<BTreeMap<usize, Rc<[T]>>>;

impl<'a> Cache<'a> {
    pub fn new(container: &'a Container<'a>) -> Self {
        Self {
            container,
            pairs: Read::default(),
            triples: Read::default(),
            quadruples: Read::default(),
            colors: Read::default(),
            indices: Read::default(),
            elements: Cell::new(0),
            limit: container.bytes().saturating_mul(ELEMENTS_A_BYTE).max(LEAST_ELEMENTS),
        }
    }

    pub fn pairs(&self, accessor: usize, what: &'static str) -> Result<Rc<[[f32; 2]]>, GltfError> {
        self.read(&self.pairs, accessor, what, || self.container.vectors::<2>(accessor, what))
    }

    pub fn triples(&self, accessor: usize, what: &'static str) -> Result<Rc<[[f32; 3]]>, GltfError> {
        self.read(&self.triples, accessor, what, || self.container.vectors::<3>(accessor, what))
    }

    pub fn quadruples(&self, accessor: usize, what: &'static str) -> Result<Rc<[[f32; 4]]>, GltfError> {
        self.read(&self.quadruples, accessor, what, || self.container.vectors::<4>(accessor, what))
    }

    pub fn colors(&self, accessor: usize, what: &'static str) -> Result<Rc<[[f32; 4]]>, GltfError> {
        self.read(&self.colors, accessor, what, || self.container.colors(accessor))
    }

    pub fn indices(&self, accessor: usize) -> Result<Rc<[u32]>, GltfError> {
        self.read(&self.indices, accessor, "indices", || self.container.indices(accessor))
    }

    fn read<T: Copy>(
        &self,
        of: &Read<T>,
        accessor: usize,
        what: &'static str,
        read: impl FnOnce() -> Result<Vec<T>, GltfError>,
    ) -> Result<Rc<[T]>, GltfError> {
        if let Some(known) = of.borrow().get(&accessor) {
            return Ok(known.clone());
        }
        // Before anything is read: an accessor without data costs nothing in the file.
        let count = lookup(&self.container.document.accessors, accessor, "accessor", what)?.count;
        let found = self.elements.get().saturating_add(count);
        if found > self.limit {
            let what = "the data of all meshes".into();
            return Err(GltfError::TooMany { what, found, limit: self.limit });
        }
        self.elements.set(found);
        let elements: Rc<[T]> = read()?.into();
        of.borrow_mut().insert(accessor, elements.clone());
        Ok(elements)
    }
}
