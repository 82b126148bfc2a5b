//! Collects the binary chunk: accessors and images, each in a buffer view of its own.

use serde_json::{Map, Value, json};

use crate::{appearance::MeshPart, bake::model::Slot};

const FLOAT: u32 = 5126;
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
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl BinaryChunk {
    /// Adds a primitive, with those attributes that the slot `has`.
    pub fn primitive(&mut self, part: &MeshPart, has: Slot, material: Option<usize>) -> Value {
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
            attributes.insert("TEXCOORD_1".into(), self.attribute(&part.uvs_1, false).into());
        }
        if has.colors && !part.colors.is_empty() {
            attributes.insert("COLOR_0".into(), self.attribute(&part.colors, false).into());
        }
        let indices = self.indices(&part.indices, part.positions.len());
        match material {
            Some(material) => json!({ "attributes": attributes, "indices": indices, "material": material }),
            None => json!({ "attributes": attributes, "indices": indices }),
        }
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
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds indices, in 16 bits where they fit and returns the accessor.
    fn indices(&mut self, indices: &[u32], vertices: usize) -> usize {
        let start = self.begin();
        // The highest index of each size is reserved (primitive restart).
        let short = vertices <= usize::from(u16::MAX);
        for &index in indices {
            if short {
                self.bytes.extend((index as u16).to_le_bytes());
            } else {
                self.bytes.extend(index.to_le_bytes());
            }
        }
        let view = self.end(start, Some(INDICES));
        let component = if short { UNSIGNED_SHORT } else { UNSIGNED_INT };
        self.accessors
            .push(json!({ "bufferView": view, "componentType": component, "count": indices.len(), "type": "SCALAR" }));
        self.accessors.len() - 1
    }

    /// Adds an image and returns the buffer view.
    pub fn image(&mut self, bytes: &[u8]) -> usize {
        let start = self.begin();
        self.bytes.extend(bytes);
        self.end(start, None)
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
        self.views.push(view);
        self.views.len() - 1
    }

    /// Writes buffer, views and accessors into the root object and returns the bytes.
    pub fn finish(self, root: &mut Map<String, Value>) -> Vec<u8> {
        root.insert("buffers".into(), json!([{ "byteLength": self.bytes.len() }]));
        root.insert("bufferViews".into(), self.views.into());
        root.insert("accessors".into(), self.accessors.into());
        self.bytes
    }
}
