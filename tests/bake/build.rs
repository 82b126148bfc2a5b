//! Builds small glTF files.

use serde_json::{Value, json};

/// A document with its buffer, views and accessors.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    pub root: Value,
    binary: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Builder {
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds bytes and returns the buffer view.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.binary.resize(self.binary.len().next_multiple_of(4), 0);
        self.views.push(json!({ "buffer": 0, "byteOffset": self.binary.len(), "byteLength": bytes.len() }));
        self.binary.extend(bytes);
        self.views.len() - 1
    }

    /// Adds an accessor of floats, `width` an element.
    pub fn accessor(&mut self, values: &[f32], width: usize) -> usize {
        let bytes: Vec<u8> = values.iter().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes);
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][width - 1];
        let bound = |pick: fn(f32, f32) -> f32| -> Vec<f32> {
            (0..width).filter_map(|k| values.iter().skip(k).step_by(width).copied().reduce(pick)).collect()
        };
        self.accessors.push(json!({
            "bufferView": view, "componentType": 5126, "count": values.len() / width, "type": kind,
            "min": bound(f32::min), "max": bound(f32::max)
        }));
        self.accessors.len() - 1
    }

    /// A primitive: a square of side 1 that faces z, `n` by `n` quadrangles, with material 0 and these attributes.
    pub fn plate(&mut self, n: usize, attributes: &[&str]) -> Value {
        self.plate_at(n, attributes, [0.0; 3])
    }

    /// The same, at a place.
    pub fn plate_at(&mut self, n: usize, attributes: &[&str], at: [f32; 3]) -> Value {
        let grid: Vec<[f32; 2]> =
            (0..=n).flat_map(|y| (0..=n).map(move |x| [x as f32 / n as f32, y as f32 / n as f32])).collect();
        let each = |of: &dyn Fn([f32; 2]) -> Vec<f32>| -> Vec<f32> { grid.iter().flat_map(|&p| of(p)).collect() };
        let positions = self.accessor(&each(&|[x, y]| vec![x + at[0], y + at[1], at[2]]), 3);
        let mut written = json!({ "POSITION": positions });
        for name in attributes {
            let accessor = match *name {
                "NORMAL" => self.accessor(&each(&|_| vec![0.0, 0.0, 1.0]), 3),
                "TANGENT" => self.accessor(&each(&|_| vec![1.0, 0.0, 0.0, 1.0]), 4),
                "WEIGHTS_0" => self.accessor(&each(&|_| vec![1.0, 0.0, 0.0, 0.0]), 4),
                "JOINTS_0" => {
                    let view = self.view(&vec![0; grid.len() * 4]);
                    self.accessors.push(
                        json!({ "bufferView": view, "componentType": 5121, "count": grid.len(), "type": "VEC4" }),
                    );
                    self.accessors.len() - 1
                }
                _ => self.accessor(&each(&|[x, y]| vec![x, 1.0 - y]), 2),
            };
            written[*name] = accessor.into();
        }
        let n = n as u16;
        let quads = (0..n).flat_map(|y| (0..n).map(move |x| y * (n + 1) + x));
        let indices: Vec<u8> =
            quads.flat_map(|a| [a, a + 1, a + n + 2, a, a + n + 2, a + n + 1]).flat_map(u16::to_le_bytes).collect();
        let view = self.view(&indices);
        self.accessors
            .push(json!({ "bufferView": view, "componentType": 5123, "count": indices.len() / 2, "type": "SCALAR" }));
        json!({ "attributes": written, "indices": self.accessors.len() - 1, "material": 0 })
    }

    /// The file.
    pub fn glb(&self) -> Vec<u8> {
        let mut root = self.root.clone();
        root["bufferViews"] = self.views.clone().into();
        root["accessors"] = self.accessors.clone().into();
        root["buffers"] = json!([{ "byteLength": self.binary.len() }]);
        assemble(&root, &self.binary)
    }
}

/// Bytes of a .glb.
pub fn assemble(root: &Value, binary: &[u8]) -> Vec<u8> {
    let mut json = root.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((28 + json.len() as u32 + binary.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}
