//! Checks what a document refers to, so that what is carried over is valid glTF.

use serde_json::Value;

use super::{GltfError, container::Container, document::Document};
use crate::bake::{model::MaterialLibrary, texture_refs::retain};

/// Checks all references but those of materials and textures: every buffer view lies in its buffer, every accessor in
/// its views, and what nodes, meshes, skins, animations and scenes refer to is there.
pub fn check(container: &Container) -> Result<(), GltfError> {
    let document = &container.document;
    for i in 0..document.buffer_views.len() {
        container.view(i, &format!("buffer view {i}"))?;
    }
    for i in 0..document.accessors.len() {
        container.check_accessor(i)?;
    }
    let list = |name: &str| container.root.get(name).and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let checks = Checks { document, counts: [list("cameras").len(), list("skins").len()] };
    for (i, node) in list("nodes").iter().enumerate() {
        let from = format!("node {i}");
        for (key, kind) in [("mesh", Kind::Mesh), ("skin", Kind::Skin), ("camera", Kind::Camera)] {
            checks.one(&from, &node[key], kind)?;
        }
        checks.all(&from, &node["children"], Kind::Node)?;
    }
    for (i, scene) in list("scenes").iter().enumerate() {
        checks.all(&format!("scene {i}"), &scene["nodes"], Kind::Node)?;
    }
    for (i, mesh) in list("meshes").iter().enumerate() {
        let from = format!("mesh {i}");
        for primitive in mesh["primitives"].as_array().into_iter().flatten() {
            checks.one(&from, &primitive["indices"], Kind::Accessor)?;
            checks.one(&from, &primitive["material"], Kind::Material)?;
            let targets = primitive["targets"].as_array().into_iter().flatten();
            for attributes in std::iter::once(&primitive["attributes"]).chain(targets) {
                for accessor in attributes.as_object().into_iter().flat_map(|attributes| attributes.values()) {
                    checks.one(&from, accessor, Kind::Accessor)?;
                }
            }
        }
    }
    for (i, skin) in list("skins").iter().enumerate() {
        let from = format!("skin {i}");
        checks.one(&from, &skin["inverseBindMatrices"], Kind::Accessor)?;
        checks.one(&from, &skin["skeleton"], Kind::Node)?;
        checks.all(&from, &skin["joints"], Kind::Node)?;
    }
    for (i, animation) in list("animations").iter().enumerate() {
        let from = format!("animation {i}");
        let samplers = animation["samplers"].as_array().map_or(&[][..], Vec::as_slice);
        for sampler in samplers {
            checks.one(&from, &sampler["input"], Kind::Accessor)?;
            checks.one(&from, &sampler["output"], Kind::Accessor)?;
        }
        for channel in animation["channels"].as_array().into_iter().flatten() {
            checks.one(&from, channel.pointer("/target/node").unwrap_or(&Value::Null), Kind::Node)?;
            in_range(&from, "sampler", &channel["sampler"], samplers.len())?;
        }
    }
    Ok(())
}

/// Kind of a thing that is referred to.
#[derive(Clone, Copy)]
enum Kind {
    Accessor,
    Camera,
    Material,
    Mesh,
    Node,
    Skin,
}

struct Checks<'a> {
    document: &'a Document,
    /// Numbers of cameras and skins.
    counts: [usize; 2],
}

impl Checks<'_> {
    fn one(&self, from: &str, value: &Value, kind: Kind) -> Result<(), GltfError> {
        let (name, count) = match kind {
            Kind::Accessor => ("accessor", self.document.accessors.len()),
            Kind::Camera => ("camera", self.counts[0]),
            Kind::Material => ("material", self.document.materials.len()),
            Kind::Mesh => ("mesh", self.document.meshes.len()),
            Kind::Node => ("node", self.document.nodes.len()),
            Kind::Skin => ("skin", self.counts[1]),
        };
        in_range(from, name, value, count)
    }

    fn all(&self, from: &str, values: &Value, kind: Kind) -> Result<(), GltfError> {
        values.as_array().into_iter().flatten().try_for_each(|value| self.one(from, value, kind))
    }
}

fn in_range(from: &str, kind: &'static str, value: &Value, count: usize) -> Result<(), GltfError> {
    let index = value.as_u64().and_then(|index| usize::try_from(index).ok());
    match index {
        Some(index) if index >= count => Err(GltfError::Dangling { from: from.into(), kind, index, count }),
        _ => Ok(()),
    }
}

/// Removes references of materials to textures that do not exist, and of textures to images and samplers that do not.
/// `images` is the number of images. Returns the number of references that were removed.
pub fn drop_dangling(library: &mut MaterialLibrary, images: usize) -> usize {
    let MaterialLibrary { materials, textures, samplers, .. } = library;
    let dangling = |value: &Value, count: usize| value.as_u64().is_none_or(|index| index >= count as u64);
    let mut dropped = 0;
    for material in materials.iter_mut() {
        retain(material, &mut |info| {
            let keep = !dangling(&info["index"], textures.len());
            dropped += usize::from(!keep);
            keep
        });
    }
    for texture in textures.iter_mut().filter_map(Value::as_object_mut) {
        for (key, count) in [("source", images), ("sampler", samplers.len())] {
            if texture.get(key).is_some_and(|value| dangling(value, count)) {
                texture.remove(key);
                dropped += 1;
            }
        }
        let extensions = texture.get_mut("extensions").and_then(Value::as_object_mut);
        for extension in extensions.into_iter().flat_map(|e| e.values_mut()).filter_map(Value::as_object_mut) {
            if extension.get("source").is_some_and(|value| dangling(value, images)) {
                extension.remove("source");
                dropped += 1;
            }
        }
    }
    dropped
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn references_to_nothing_are_left_out_and_counted() {
        let mut library = MaterialLibrary {
            materials: vec![json!({
                "pbrMetallicRoughness": { "baseColorTexture": { "index": 99 } },
                "normalTexture": { "index": 0 },
                "extensions": { "KHR_materials_sheen": { "sheenColorTexture": { "index": -1 } } }
            })],
            textures: vec![json!({ "source": 1, "sampler": 0 })],
            ..MaterialLibrary::default()
        };
        assert_eq!(drop_dangling(&mut library, 1), 4);
        let expected = json!({
            "pbrMetallicRoughness": {},
            "normalTexture": { "index": 0 },
            "extensions": { "KHR_materials_sheen": {} }
        });
        assert_eq!((&library.materials[0], &library.textures[0]), (&expected, &json!({})));
    }
}
