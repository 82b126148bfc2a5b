//! Writing an aged model as binary glTF 2.0.
//!
//! One node and mesh for each prop, in scene space, with one primitive for each material: the prop's own where the
//! paint holds, the same seen from the front only where it has separated, primer on the backs of flakes, and rusted
//! metal beneath.

mod buffer;
mod materials;

use serde_json::{Map, Value, json};

use super::{BakeError, Baked, shown};
use buffer::BinaryChunk;
use materials::Materials;

/// The aged model as the bytes of a .glb file.
///
/// # Errors
/// [`BakeError::TooLarge`].
pub fn aged_glb(baked: &mut Baked) -> Result<Vec<u8>, BakeError> {
    let Baked { props, films, stopwatch, materials, .. } = baked;
    let shown = stopwatch.mesh(|| {
        let parts = props.iter().zip(films.iter());
        parts.map(|(prop, film)| shown::parts(prop, film)).collect::<Vec<_>>()
    });
    let mut chunk = BinaryChunk::default();
    let mut materials = Materials::new(materials);
    let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
    for (prop, parts) in props.iter().zip(&shown) {
        let primitives: Vec<Value> = parts
            .iter()
            .map(|part| {
                let mut primitive = chunk.primitive(part);
                if let (Some(material), Some(fields)) =
                    (materials.of(part.matter, &prop.slots), primitive.as_object_mut())
                {
                    fields.insert("material".into(), material.into());
                }
                primitive
            })
            .collect();
        if primitives.is_empty() {
            continue;
        }
        nodes.push(json!({ "name": prop.name, "mesh": meshes.len() }));
        meshes.push(json!({ "name": prop.name, "primitives": primitives }));
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
