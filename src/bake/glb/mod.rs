//! Writes an aged model as binary glTF 2.0.
//!
//! There is one node and mesh for each prop, moved to its place in the scene, with one primitive for each material: the
//! prop's own on the film, primer on the backs of flakes, and rusted metal beneath. Its appearance is made by
//! [`crate::appearance`], as in a running game; stains come into it by [`super::textures`].

mod buffer;
mod materials;

use bevy_math::Vec3;
use serde_json::{Map, Value, json};

use super::{
    baked::Baked,
    error::BakeError,
    stain_output::StainOutput,
    textures::{Dressed, Textures, dress},
};
use crate::appearance::FilmAppearance;
use buffer::BinaryChunk;
use materials::Materials;

/// Makes the bytes of a .glb file. Adds what could not be done to the warnings.
///
/// # Errors
/// [`BakeError::TooLarge`].
pub fn aged_glb(baked: &mut Baked, stains: StainOutput) -> Result<Vec<u8>, BakeError> {
    let Baked { props, films, stopwatch, materials: library, warnings, .. } = baked;
    let appearances: Vec<FilmAppearance> = stopwatch.mesh(|| {
        let pairs = props.iter().zip(films.iter());
        pairs
            .map(|(prop, film)| FilmAppearance::new(&prop.built, &prop.surface, &film.mesh, &film.forces, &film.stains))
            .collect()
    });
    let dressed: Vec<Dressed> = stopwatch.mesh(|| {
        let mut textures = Textures::default();
        let largest = films.iter().map(|film| film.mesh.geometry.rest_area).fold(0.0, f32::max);
        let all = props.iter().zip(films.iter()).zip(&appearances);
        all.map(|((prop, film), appearance)| {
            let output = stains.for_share(film.mesh.geometry.rest_area / largest);
            dress(prop, film, appearance, library, &mut textures, output)
        })
        .collect()
    });
    warnings.extend(dressed.iter().flat_map(|dressed| dressed.warnings.iter().cloned()));

    let mut chunk = BinaryChunk::default();
    let mut materials = Materials::new(library, dressed.iter().flat_map(|dressed| &dressed.primitives));
    let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
    for (prop, dressed) in props.iter().zip(&dressed) {
        let sheets: Vec<usize> = dressed.sheets.iter().map(|sheet| materials.add_sheet(&prop.name, sheet)).collect();
        let primitives: Vec<Value> = dressed
            .primitives
            .iter()
            .map(|primitive| {
                let material = materials.of(primitive, &sheets);
                chunk.primitive(&primitive.part, primitive.has, material)
            })
            .collect();
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

/// Joins header, JSON chunk and binary chunk; `None` beyond 4 GiB.
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
