//! Finds out which elements of a document's lists are referred to.

use std::collections::BTreeSet;

use serde_json::Value;

/// Indices that are referred to. Extensions that nobody here knows are looked through for the usual names; what is no
/// reference may count as one, which costs no more than bytes.
#[derive(Debug, Default)]
pub struct Uses {
    pub accessors: BTreeSet<usize>,
    pub images: BTreeSet<usize>,
    pub materials: BTreeSet<usize>,
    pub meshes: BTreeSet<usize>,
    pub textures: BTreeSet<usize>,
    pub views: BTreeSet<usize>,
}

impl Uses {
    /// Finds what all of `values` refer to.
    pub fn of<'a>(values: impl IntoIterator<Item = &'a Value>) -> Self {
        let mut uses = Self::default();
        values.into_iter().for_each(|value| uses.add(value));
        uses
    }

    /// Adds what a value and all in it refer to.
    pub fn add(&mut self, value: &Value) {
        match value {
            Value::Object(fields) => {
                for (key, value) in fields {
                    self.add_field(key, value);
                    self.add(value);
                }
            }
            Value::Array(values) => values.iter().for_each(|value| self.add(value)),
            _ => {}
        }
    }

    /// Adds what a field refers to itself.
    pub fn add_field(&mut self, key: &str, value: &Value) {
        match key {
            "accessor" | "indices" | "input" | "inverseBindMatrices" | "output" => self.accessors.extend(index(value)),
            "attributes" => self.accessors.extend(indices_in(value)),
            "targets" => self.accessors.extend(value.as_array().into_iter().flatten().flat_map(indices_in)),
            "bufferView" => self.views.extend(index(value)),
            "source" | "image" => self.images.extend(index(value)),
            "material" => self.materials.extend(index(value)),
            "mesh" => self.meshes.extend(index(value)),
            "texture" => self.textures.extend(index(value)),
            _ if key.ends_with("Texture") => self.textures.extend(index(&value["index"])),
            _ => {}
        }
    }
}

/// The index that a value is.
pub fn index(value: &Value) -> Option<usize> {
    value.as_u64().and_then(|index| usize::try_from(index).ok())
}

fn indices_in(value: &Value) -> impl Iterator<Item = usize> + '_ {
    value.as_object().into_iter().flat_map(|fields| fields.values()).filter_map(index)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn references_are_found_where_they_usually_are() {
        let uses = Uses::of([&json!({
            "primitives": [{
                "attributes": { "POSITION": 1, "_OWN": 2 }, "indices": 3, "targets": [{ "POSITION": 4 }], "material": 5,
                "extensions": { "KHR_materials_variants": { "mappings": [{ "material": 6, "variants": [0] }] } }
            }],
            "animations": [{ "samplers": [{ "input": 7, "output": 8 }] }],
            "sparse": { "indices": { "bufferView": 9 } },
            "emissiveTexture": { "index": 10 },
            "extensions": { "EXT_texture_webp": { "source": 11 } },
            "extras": { "mesh": 12 }
        })]);
        assert_eq!(uses.accessors, [1, 2, 3, 4, 7, 8].into());
        assert_eq!((uses.materials, uses.views, uses.textures), ([5, 6].into(), [9].into(), [10].into()));
        assert_eq!((uses.images, uses.meshes), ([11].into(), [12].into()));
    }
}
