//! Reads the instances of a node (extension `EXT_mesh_gpu_instancing`).

use bevy_math::{DMat4, Quat, Vec3};

use super::{GltfError, cache::Cache, document::Node};
use crate::bake::model::Instance;

/// Name of the extension.
const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// Returns the instances of a node; `None` without the extension.
pub fn read(cache: &Cache, node: &Node) -> Result<Option<Vec<Instance>>, GltfError> {
    let Some(extension) = node.extensions.get(INSTANCING) else { return Ok(None) };
    let attributes = &extension["attributes"];
    let accessor = |name: &str| attributes[name].as_u64().and_then(|index| usize::try_from(index).ok());
    let translations = accessor("TRANSLATION").map(|a| cache.triples(a, "translations of instances")).transpose()?;
    let rotations = accessor("ROTATION").map(|a| cache.quadruples(a, "rotations of instances")).transpose()?;
    let scales = accessor("SCALE").map(|a| cache.triples(a, "scales of instances")).transpose()?;
    let counts =
        [translations.as_ref().map(|t| t.len()), rotations.as_ref().map(|r| r.len()), scales.as_ref().map(|s| s.len())];
    let count = counts.into_iter().flatten().min().unwrap_or(0);
    let instance = |index: usize| {
        let vector = |of: &Option<std::rc::Rc<[[f32; 3]]>>, default: Vec3| {
            of.as_ref().and_then(|of| of.get(index)).map_or(default, |&v| v.into())
        };
        let rotation = rotations.as_ref().and_then(|of| of.get(index)).map_or(Quat::IDENTITY, |&q| Quat::from_array(q));
        Instance {
            index,
            translation: vector(&translations, Vec3::ZERO),
            // A quaternion of zeros is no rotation.
            rotation: if rotation.length_squared() > 0.0 { rotation.normalize() } else { Quat::IDENTITY },
            scale: vector(&scales, Vec3::ONE),
        }
    };
    Ok(Some((0..count).map(instance).collect()))
}

/// Returns whether instances have attributes besides their places, which nodes do not have.
pub fn have_more(node: &Node) -> bool {
    let attributes = node.extensions.get(INSTANCING).and_then(|extension| extension["attributes"].as_object());
    let known = ["TRANSLATION", "ROTATION", "SCALE"];
    attributes.is_some_and(|attributes| attributes.keys().any(|name| !known.contains(&name.as_str())))
}

/// From an instance's space into its node's.
pub fn transform(instance: &Instance) -> DMat4 {
    let Instance { translation, rotation, scale, .. } = *instance;
    DMat4::from_scale_rotation_translation(scale.as_dvec3(), rotation.as_dquat().normalize(), translation.as_dvec3())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_that_nodes_do_not_have_are_seen() {
        let node = |attributes: serde_json::Value| -> Node {
            serde_json::from_value(serde_json::json!({ "extensions": { INSTANCING: { "attributes": attributes } } }))
                .expect("a node")
        };
        assert!(!have_more(&node(serde_json::json!({ "SCALE": 1 }))));
        assert!(have_more(&node(serde_json::json!({ "SCALE": 1, "_ID": 2 }))));
    }
}
