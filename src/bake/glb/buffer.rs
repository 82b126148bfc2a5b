//! Collects the binary chunk: what is kept of the buffers, then new accessors and images, each in a buffer view of its
//! own.

use std::{collections::BTreeMap, sync::Arc};

use serde_json::{Map, Value, json};

use super::{pool::Pool, uses::index};
use crate::{
    appearance::MeshPart,
    bake::{carried::Carried, model::Slot},
};

const FLOAT: u32 = 5126;
const UNSIGNED_BYTE: u32 = 5121;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
/// `ARRAY_BUFFER`: vertex attributes.
const VERTICES: u32 = 34962;
/// `ELEMENT_ARRAY_BUFFER`: indices.
const INDICES: u32 = 34963;

/// The bytes of a .glb, and what lies where in them.
#[derive(Debug, Default)]
pub struct BinaryChunk {
    bytes: Vec<u8>,
    views: Pool,
    accessors: Pool,
    /// Buffer views of images, by where their bytes are in memory: images that share them do so in the file.
    images: BTreeMap<*const u8, usize>,
}

impl BinaryChunk {
    /// Begins with the bytes of the buffer views that are not free. Where views overlap, their bytes are taken once.
    pub fn new(carried: &Carried, views: Pool, accessors: Pool) -> Self {
        let mut chunk = Self { bytes: Vec::new(), views, accessors, images: BTreeMap::new() };
        let range = |view: &Value| {
            let buffer = index(&view["buffer"])?;
            let start = index(&view["byteOffset"]).unwrap_or(0);
            Some((buffer, start, start.checked_add(index(&view["byteLength"])?)?))
        };
        let mut ranges: Vec<(usize, usize, usize)> = chunk.views.elements().iter().filter_map(range).collect();
        ranges.sort_unstable();
        // Start in the buffer, end, and start in the chunk, of whole stretches.
        let mut stretches: Vec<(usize, usize, usize, usize)> = Vec::new();
        for (buffer, start, end) in ranges {
            match stretches.last_mut() {
                Some((own, _, last, _)) if *own == buffer && start <= *last => *last = end.max(*last),
                _ => stretches.push((buffer, start, end, 0)),
            }
        }
        for (buffer, start, end, at) in &mut stretches {
            // Accessors are aligned to four bytes from the start of the buffer.
            let aligned = chunk.bytes.len().next_multiple_of(4) + *start % 4;
            chunk.bytes.resize(aligned, 0);
            *at = aligned;
            let bytes = carried.buffers.get(*buffer).and_then(|bytes| bytes.get(*start..*end));
            chunk.bytes.extend_from_slice(bytes.unwrap_or_default());
        }
        for i in 0..chunk.views.len() {
            let Some((buffer, start, _)) = range(chunk.views.get(i)) else { continue };
            let after = stretches.partition_point(|&(own, first, ..)| (own, first) <= (buffer, start));
            let Some(&(_, first, _, at)) = after.checked_sub(1).and_then(|i| stretches.get(i)) else { continue };
            let mut view = chunk.views.get(i).clone();
            if let Some(fields) = view.as_object_mut() {
                fields.insert("buffer".into(), 0.into());
                fields.insert("byteOffset".into(), (at + start - first).into());
                // The bytes are there as they are, so how else they could be had does not matter.
                let extensions = fields.get_mut("extensions").and_then(Value::as_object_mut);
                if let Some(extensions) = extensions {
                    extensions.retain(|name, _| !name.ends_with("_meshopt_compression"));
                }
            }
            chunk.views.put(i, view);
        }
        chunk
    }

    /// Adds a primitive, with those attributes that the slot `has`.
    pub fn primitive(&mut self, part: &MeshPart, has: Slot, material: Option<usize>) -> Map<String, Value> {
        let mut attributes = Map::new();
        attributes.insert("POSITION".into(), self.attribute(&part.positions, true).into());
        attributes.insert("NORMAL".into(), self.attribute(&part.normals, false).into());
        if has.tangents && !part.tangents.is_empty() {
            attributes.insert("TANGENT".into(), self.attribute(&part.tangents, false).into());
        }
        if has.uvs && !part.uvs.is_empty() {
            attributes.insert("TEXCOORD_0".into(), self.attribute(&part.uvs, false).into());
        }
        if has.uvs_1 && !part.uvs_1.is_empty() {
            // Sets are numbered without gaps.
            let name = if attributes.contains_key("TEXCOORD_0") { "TEXCOORD_1" } else { "TEXCOORD_0" };
            attributes.insert(name.into(), self.attribute(&part.uvs_1, false).into());
        }
        if has.colors && !part.colors.is_empty() {
            attributes.insert("COLOR_0".into(), self.attribute(&part.colors, false).into());
        }
        let indices = self.indices(&part.indices, part.positions.len());
        let mut primitive = Map::new();
        primitive.insert("attributes".into(), attributes.into());
        primitive.insert("indices".into(), indices.into());
        if let Some(material) = material {
            primitive.insert("material".into(), material.into());
        }
        primitive
    }

    /// Adds vertex attributes and returns the accessor. `bounds` are required for positions.
    fn attribute<const N: usize>(&mut self, vectors: &[[f32; N]], bounds: bool) -> usize {
        let start = self.begin();
        for x in vectors.iter().flatten() {
            self.bytes.extend(x.to_le_bytes());
        }
        let view = self.end(start, Some(VERTICES));
        let kind = match N {
            2 => "VEC2",
            3 => "VEC3",
            _ => "VEC4",
        };
        let mut accessor = json!({ "bufferView": view, "componentType": FLOAT, "count": vectors.len(), "type": kind });
        if let (true, Some(fields)) = (bounds, accessor.as_object_mut()) {
            let fold = |pick: fn(f32, f32) -> f32, start: f32| {
                let mut bound = [start; N];
                for vector in vectors {
                    for (b, &x) in bound.iter_mut().zip(vector) {
                        *b = pick(*b, x);
                    }
                }
                // Exact in double precision, which the text keeps.
                bound.map(f64::from).to_vec()
            };
            fields.insert("min".into(), fold(f32::min, f32::INFINITY).into());
            fields.insert("max".into(), fold(f32::max, f32::NEG_INFINITY).into());
        }
        self.accessors.add(accessor)
    }

    /// Adds indices, in 16 bits where they fit and returns the accessor.
    fn indices(&mut self, indices: &[u32], vertices: usize) -> usize {
        let start = self.begin();
        // The highest index of each size is reserved (primitive restart).
        let short = vertices <= usize::from(u16::MAX);
        for &index in indices {
            if short {
                self.bytes.extend(u16::try_from(index).unwrap_or(u16::MAX).to_le_bytes());
            } else {
                self.bytes.extend(index.to_le_bytes());
            }
        }
        let view = self.end(start, Some(INDICES));
        let component = if short { UNSIGNED_SHORT } else { UNSIGNED_INT };
        self.accessors
            .add(json!({ "bufferView": view, "componentType": component, "count": indices.len(), "type": "SCALAR" }))
    }

    /// Adds an image and returns the buffer view.
    pub fn image(&mut self, bytes: &[u8]) -> usize {
        let start = self.begin();
        self.bytes.extend(bytes);
        self.end(start, None)
    }

    /// Adds an image of the prop's own and returns the buffer view, which those that share its bytes share.
    pub fn own_image(&mut self, bytes: &Arc<[u8]>) -> usize {
        if let Some(&view) = self.images.get(&bytes.as_ptr()) {
            return view;
        }
        let view = self.image(bytes);
        self.images.insert(bytes.as_ptr(), view);
        view
    }

    /// Aligns; every component type is at most four bytes.
    fn begin(&mut self) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.bytes.len()
    }

    fn end(&mut self, start: usize, target: Option<u32>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let (Some(target), Some(fields)) = (target, view.as_object_mut()) {
            fields.insert("target".into(), target.into());
        }
        self.views.add(view)
    }

    /// Writes buffer, views and accessors into the root object and returns the bytes.
    pub fn finish(mut self, root: &mut Map<String, Value>) -> Vec<u8> {
        self.begin();
        let empty_view = json!({ "buffer": 0, "byteLength": 4 });
        let empty_accessor = json!({ "componentType": UNSIGNED_BYTE, "count": 1, "type": "SCALAR" });
        root.insert("buffers".into(), json!([{ "byteLength": self.bytes.len() }]));
        root.insert("bufferViews".into(), self.views.finish(&empty_view).into());
        root.insert("accessors".into(), self.accessors.finish(&empty_accessor).into());
        self.bytes
    }
}
