//! Finishes the root object and puts the file together.

use std::collections::BTreeSet;

use serde_json::{Map, Value, json};

use crate::bake::{carried::Carried, model::MaterialLibrary};

/// This crate, as generator.
const GENERATOR: &str = concat!("bevy_coating ", env!("CARGO_PKG_VERSION"));
/// Extension that has no place of its own in a document: its accessors are of other types.
const QUANTIZATION: &str = "KHR_mesh_quantization";

/// Writes asset and extensions into the root object. An extension that was somewhere in the document and is nowhere any
/// more is not listed; one that never had a place stays.
pub fn finish_root(
    root: &mut Map<String, Value>,
    carried: &Carried,
    library: &MaterialLibrary,
    copyright: Option<&str>,
) {
    let mut asset = match root.remove("asset") {
        Some(Value::Object(asset)) => asset,
        _ => Map::new(),
    };
    asset.entry("version").or_insert_with(|| "2.0".into());
    let generator = match asset.get("generator").and_then(Value::as_str) {
        Some(own) if own.starts_with(GENERATOR) => own.to_owned(),
        Some(own) => format!("{GENERATOR}, of a model by {own}"),
        None => GENERATOR.into(),
    };
    asset.insert("generator".into(), generator.into());
    match copyright {
        Some(copyright) => _ = asset.insert("copyright".into(), copyright.into()),
        None => _ = asset.remove("copyright"),
    }
    root.insert("asset".into(), asset.into());

    let lists = [&library.materials, &library.textures, &library.samplers];
    let mut before: BTreeSet<&str> = BTreeSet::new();
    carried.root.values().chain(lists.into_iter().flatten()).for_each(|value| collect(value, &mut before));
    before.extend(carried.root.get("extensions").and_then(Value::as_object).into_iter().flat_map(names));
    library
        .images
        .iter()
        .filter_map(|image| image.rest.get("extensions")?.as_object())
        .for_each(|own| before.extend(names(own)));
    let mut now: BTreeSet<&str> = BTreeSet::new();
    root.values().for_each(|value| collect(value, &mut now));
    now.extend(root.get("extensions").and_then(Value::as_object).into_iter().flat_map(names));
    let quantized = is_quantized(root);
    let stays = |name: &&String| match name.as_str() {
        QUANTIZATION => quantized,
        name => now.contains(name) || !before.contains(name),
    };
    let mut used: Vec<String> = library.extensions_used.iter().filter(stays).cloned().collect();
    // Some files do not list all that they use.
    let unlisted = now.iter().filter(|name| !library.extensions_used.iter().any(|used| used == *name));
    used.extend(unlisted.map(|name| (*name).to_owned()));
    let required: Vec<String> =
        library.extensions_required.iter().filter(stays).filter(|name| used.contains(name)).cloned().collect();
    for (key, list) in [("extensionsUsed", used), ("extensionsRequired", required)] {
        root.remove(key);
        if !list.is_empty() {
            root.insert(key.into(), json!(list));
        }
    }
}

/// Collects the names of the extensions of all objects in `value`.
fn collect<'a>(value: &'a Value, found: &mut BTreeSet<&'a str>) {
    match value {
        Value::Object(fields) => {
            found.extend(fields.get("extensions").and_then(Value::as_object).into_iter().flat_map(names));
            fields.iter().filter(|(key, _)| *key != "extras").for_each(|(_, value)| collect(value, found));
        }
        Value::Array(values) => values.iter().for_each(|value| collect(value, found)),
        _ => {}
    }
}

fn names(extensions: &Map<String, Value>) -> impl Iterator<Item = &str> {
    extensions.keys().map(String::as_str)
}

/// Whether an attribute of a mesh has a component type that only the extension allows.
fn is_quantized(root: &Map<String, Value>) -> bool {
    let accessor = |index: &Value| root.get("accessors")?.get(usize::try_from(index.as_u64()?).ok()?);
    let meshes = root.get("meshes").and_then(Value::as_array).into_iter().flatten();
    let primitives = meshes.flat_map(|mesh| mesh["primitives"].as_array().into_iter().flatten());
    let mut attributes = primitives.flat_map(|primitive| primitive["attributes"].as_object().into_iter().flatten());
    attributes.any(|(name, index)| {
        let of = |start: &str| name.starts_with(start);
        let geometry = of("POSITION") || of("NORMAL") || of("TANGENT") || of("TEXCOORD_");
        geometry && accessor(index).is_some_and(|accessor| accessor["componentType"] != 5126)
    })
}

/// Joins header, JSON chunk and binary chunk; `None` beyond 4 GiB.
pub fn assemble(root: &Map<String, Value>, mut binary: Vec<u8>) -> Option<Vec<u8>> {
    let mut json = serde_json::to_vec(root).ok()?;
    json.resize(json.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let length = u32::try_from(12 + 8 + json.len() + 8 + binary.len()).ok()?;
    let mut bytes = Vec::with_capacity(length as usize);
    bytes.extend(b"glTF");
    bytes.extend(2u32.to_le_bytes());
    bytes.extend(length.to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        bytes.extend(u32::try_from(chunk.len()).ok()?.to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    Some(bytes)
}
