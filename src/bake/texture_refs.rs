//! Walks over the references to textures in a material, those of extensions that nobody here knows too.

use serde_json::{Map, Value};

/// Returns the texture coordinates that a reference uses.
pub fn set_of(info: &Map<String, Value>) -> u64 {
    let moved = info.get("extensions").and_then(|e| e["KHR_texture_transform"]["texCoord"].as_u64());
    moved.or_else(|| info.get("texCoord")?.as_u64()).unwrap_or(0)
}

/// Makes a reference use the texture coordinates `set`.
pub fn use_set(info: &mut Map<String, Value>, set: u64) {
    info.insert("texCoord".into(), set.into());
    if let Some(moved) = info.get_mut("extensions").and_then(|e| e.get_mut("KHR_texture_transform"))
        && !moved["texCoord"].is_null()
    {
        moved["texCoord"] = set.into();
    }
}

/// Walks through all references to textures and removes those that `keep` does not want.
pub fn retain(value: &mut Value, keep: &mut impl FnMut(&mut Map<String, Value>) -> bool) {
    match value {
        Value::Object(fields) => fields.retain(|key, value| {
            let info = value.as_object_mut().filter(|info| is_reference(key, info));
            if info.is_some_and(|info| !keep(info)) {
                return false;
            }
            retain(value, keep);
            true
        }),
        Value::Array(values) => values.iter_mut().for_each(|value| retain(value, keep)),
        _ => {}
    }
}

/// Calls `with` for all references to textures.
pub fn visit<'a>(value: &'a Value, with: &mut impl FnMut(&'a Map<String, Value>)) {
    match value {
        Value::Object(fields) => {
            for (key, value) in fields {
                if let Some(info) = value.as_object().filter(|info| is_reference(key, info)) {
                    with(info);
                }
                visit(value, with);
            }
        }
        Value::Array(values) => values.iter().for_each(|value| visit(value, with)),
        _ => {}
    }
}

fn is_reference(key: &str, info: &Map<String, Value>) -> bool {
    key.ends_with("Texture") && info.contains_key("index")
}
