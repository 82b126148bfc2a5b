//! Writing an aged model as binary glTF 2.0.
//!
//! One node and mesh for each prop, moved to its place in the scene, with one primitive for each material: the prop's own on the film,
//! primer on the backs of flakes, and rusted metal beneath. What is shown is made by `bevy_coating::shown`, as in a
//! running game.

mod buffer;
mod materials;

use bevy_coating::shown::ShownFilm;
use bevy_math::Vec3;
use serde_json::{Map, Value, json};

use super::{BakeError, Baked, Slot, props::Prop};
use buffer::BinaryChunk;
use materials::Materials;

/// The aged model as the bytes of a .glb file.
///
/// # Errors
/// [`BakeError::TooLarge`].
pub fn aged_glb(baked: &mut Baked) -> Result<Vec<u8>, BakeError> {
    let Baked { props, films, stopwatch, materials, .. } = baked;
    let shown: Vec<ShownFilm> = stopwatch.mesh(|| {
        let pairs = props.iter().zip(films.iter());
        pairs
            .map(|(prop, film)| ShownFilm::new(&prop.built, &prop.surface, &film.mesh, &film.forces, &film.stains))
            .collect()
    });
    let mut chunk = BinaryChunk::default();
    let mut materials = Materials::new(materials);
    let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
    for (prop, shown) in props.iter().zip(&shown) {
        let primitives = primitives(prop, shown, &mut chunk, &mut materials);
        if !primitives.is_empty() {
            let mut node = json!({ "name": prop.name, "mesh": meshes.len() });
            if let (true, Some(fields)) = (prop.origin != Vec3::ZERO, node.as_object_mut()) {
                fields.insert("translation".into(), json!(prop.origin.to_array()));
            }
            nodes.push(node);
            meshes.push(json!({ "name": prop.name, "primitives": primitives }));
        }
    }

    let mut root = Map::new();
    let mut asset = json!({ "version": "2.0", "generator": concat!("bevy_coating ", env!("CARGO_PKG_VERSION")) });
    if let (Some(copyright), Some(fields)) = (&baked.copyright, asset.as_object_mut()) {
        fields.insert("copyright".into(), copyright.clone().into());
    }
    root.insert("asset".into(), asset);
    root.insert("scene".into(), 0.into());
    root.insert("scenes".into(), json!([{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }]));
    root.insert("nodes".into(), nodes.into());
    root.insert("meshes".into(), meshes.into());
    materials.write(&mut chunk, &mut root);
    let bytes = chunk.finish(&mut root);
    assemble(&root, bytes).ok_or_else(|| BakeError::TooLarge { origin: baked.origin.clone() })
}

/// The primitives of one prop.
fn primitives(prop: &Prop, shown: &ShownFilm, chunk: &mut BinaryChunk, materials: &mut Materials) -> Vec<Value> {
    let mut primitives = Vec::new();
    for (i, &slot) in prop.slots.iter().enumerate() {
        if let Some(front) = shown.front(i).filter(|part| !part.is_empty()) {
            primitives.push(chunk.primitive(front, slot, slot.material));
        }
    }
    // Neither has a texture, so neither needs coordinates for one.
    let plain = Slot::default();
    if !shown.backs().is_empty() {
        primitives.push(chunk.primitive(shown.backs(), plain, Some(materials.primer())));
    }
    if !shown.metal().is_empty() {
        primitives.push(chunk.primitive(shown.metal(), plain, Some(materials.metal())));
    }
    primitives
}

/// Header, JSON chunk and binary chunk; `None` beyond 4 GiB.
fn assemble(root: &Map<String, Value>, mut binary: Vec<u8>) -> Option<Vec<u8>> {
    let mut json = serde_json::to_vec(root).ok()?;
    json.resize(json.len().next_multiple_of(4), b' ');
    binary.resize(binary.len().next_multiple_of(4), 0);
    let length = u32::try_from(12 + 8 + json.len() + 8 + binary.len()).ok()?;
    let mut bytes = Vec::with_capacity(length as usize);
    bytes.extend(b"glTF");
    bytes.extend(2u32.to_le_bytes());
    bytes.extend(length.to_le_bytes());
    for (kind, chunk) in [(b"JSON", json), (b"BIN\0", binary)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    Some(bytes)
}
