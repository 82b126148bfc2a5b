//! Keeps the textures of a material that are not baked: emission, occlusion, and those of extensions.

use serde_json::{Value, json};

use crate::bake::texture_refs::{retain, set_of, use_set, visit};

/// The material without the textures and factors that are baked.
pub fn without_baked(material: &Value) -> Value {
    let mut material = if material.is_object() { material.clone() } else { json!({}) };
    if let Some(fields) = material.as_object_mut() {
        fields.remove("normalTexture");
        if let Some(pbr) = fields.get_mut("pbrMetallicRoughness").and_then(Value::as_object_mut) {
            for key in
                ["baseColorTexture", "baseColorFactor", "metallicRoughnessTexture", "metallicFactor", "roughnessFactor"]
            {
                pbr.remove(key);
            }
        }
    }
    material
}

/// Whether any of a material's textures uses first, and second or later texture coordinates.
pub fn sets(material: &Value) -> [bool; 2] {
    let mut found = [false; 2];
    visit(material, &mut |info| found[set_of(info).min(1) as usize] = true);
    found
}

/// Makes textures that use first coordinates use second ones. Those that used later ones are left out.
pub fn move_to_second(material: &mut Value) {
    retain(material, &mut |info| {
        let first = set_of(info) == 0;
        if first {
            use_set(info, 1);
        }
        first
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_textures_follow_their_coordinates() {
        let material = json!({
            "name": "lamp",
            "normalTexture": { "index": 3 },
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 }, "metallicFactor": 0.5 },
            "emissiveTexture": { "index": 1, "extensions": { "KHR_texture_transform": { "texCoord": 0 } } },
            "occlusionTexture": { "index": 2, "texCoord": 1 },
            "extensions": { "KHR_materials_clearcoat": { "clearcoatTexture": { "index": 4 } } }
        });
        let mut kept = without_baked(&material);
        assert_eq!(sets(&kept), [true, true]);
        move_to_second(&mut kept);
        let expected = json!({
            "name": "lamp",
            "pbrMetallicRoughness": {},
            "emissiveTexture": {
                "index": 1, "texCoord": 1, "extensions": { "KHR_texture_transform": { "texCoord": 1 } }
            },
            "extensions": { "KHR_materials_clearcoat": { "clearcoatTexture": { "index": 4, "texCoord": 1 } } }
        });
        assert_eq!(kept, expected);
        assert_eq!(sets(&without_baked(&json!({ "normalTexture": { "index": 0 } }))), [false, false]);
    }
}
