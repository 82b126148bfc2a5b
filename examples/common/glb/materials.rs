//! Materials of an aged model: the prop's own, and those of what the paint uncovers.

use serde_json::{Map, Value, json};

use super::buffer::BinaryChunk;
use crate::common::MaterialLibrary;

/// The prop's materials in their order, then those that were needed besides.
pub struct Materials<'a> {
    library: &'a MaterialLibrary,
    materials: Vec<Value>,
    primer: Option<usize>,
    metal: Option<usize>,
}

impl<'a> Materials<'a> {
    pub fn new(library: &'a MaterialLibrary) -> Self {
        Self { library, materials: library.materials.clone(), primer: None, metal: None }
    }

    /// The material of the backs of flakes.
    pub fn primer(&mut self) -> usize {
        *self.primer.get_or_insert_with(|| push(&mut self.materials, primer()))
    }

    /// The material of bare metal.
    pub fn metal(&mut self) -> usize {
        *self.metal.get_or_insert_with(|| push(&mut self.materials, metal()))
    }

    /// Writes materials, textures, samplers and images into the root object, and the extensions they use.
    pub fn write(self, chunk: &mut BinaryChunk, root: &mut Map<String, Value>) {
        let library = self.library;
        let images: Vec<Value> = library
            .images
            .iter()
            .map(|image| {
                let mut fields = image.rest.clone();
                if let Some(name) = &image.name {
                    fields.insert("name".into(), name.clone().into());
                }
                fields.insert("mimeType".into(), image.mime_type.clone().into());
                fields.insert("bufferView".into(), chunk.image(&image.bytes).into());
                fields.into()
            })
            .collect();
        let lists = [
            ("materials", self.materials),
            ("textures", library.textures.clone()),
            ("samplers", library.samplers.clone()),
            ("images", images),
        ];
        let uses = |name: &&String| lists.iter().any(|(_, list)| list.iter().any(|value| mentions(value, name)));
        let used: Vec<&String> = library.extensions_used.iter().filter(uses).collect();
        let required: Vec<&String> = library.extensions_required.iter().filter(|name| used.contains(name)).collect();
        if !used.is_empty() {
            root.insert("extensionsUsed".into(), json!(used));
        }
        if !required.is_empty() {
            root.insert("extensionsRequired".into(), json!(required));
        }
        for (name, list) in lists {
            if !list.is_empty() {
                root.insert(name.into(), list.into());
            }
        }
    }
}

fn push(materials: &mut Vec<Value>, material: Value) -> usize {
    materials.push(material);
    materials.len() - 1
}

/// Whether an object in `value` has the extension `name`.
fn mentions(value: &Value, name: &str) -> bool {
    match value {
        Value::Object(fields) => {
            let own = fields.get("extensions").and_then(Value::as_object).is_some_and(|own| own.contains_key(name));
            own || fields.values().any(|value| mentions(value, name))
        }
        Value::Array(values) => values.iter().any(|value| mentions(value, name)),
        _ => false,
    }
}

/// Red-brown primer.
fn primer() -> Value {
    json!({
        "name": "primer",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.133, 0.033, 0.020, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.9
        }
    })
}

/// Dark rusted metal. Two-sided: a sheet of metal has a back, whatever the prop's own material shows of it.
fn metal() -> Value {
    json!({
        "name": "rusted metal",
        "doubleSided": true,
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.11, 0.045, 0.022, 1.0], "metallicFactor": 0.6, "roughnessFactor": 0.75
        }
    })
}
