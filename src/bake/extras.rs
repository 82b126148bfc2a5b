//! Reads what the custom properties of a model's nodes, meshes and materials say about paint.

use std::rc::Rc;

use serde_json::Value;

use super::{
    carried::Carried,
    model::{Model, ModelMesh, Slot},
    warning::BakeWarning,
};
use crate::extras::{ExtrasError, PropCoating, PropExtras};

/// What custom properties say; `None`: nothing about paint.
type Said = Option<Rc<Result<PropExtras, ExtrasError>>>;

/// Sets the [paint](ModelMesh::extras) of each mesh of a model by its custom properties: those of a material that all
/// of it wears, else of its node, else of the mesh itself, else of the nodes above. What cannot be used is left as it
/// is, with a warning.
pub fn read_extras(model: &mut Model) {
    let Model { carried, meshes, materials, warnings, .. } = model;
    let by_node = said_by_nodes(carried);
    let materials: Vec<Said> = materials.materials.iter().map(|material| said(&material["extras"])).collect();
    for mesh in meshes {
        let Some(place) = &mesh.place else { continue };
        let (own, above) = by_node.get(place.node).cloned().unwrap_or_default();
        let of_mesh = || said(&carried.element("meshes", place.mesh)["extras"]);
        let mut found = own.or_else(of_mesh).or(above);
        let of_slots = |slot: &Slot| slot.material.and_then(|m| materials.get(m)).cloned().flatten();
        // Slots that a material leaves alone are taken out one by one.
        let painted = |said: &Said| !matches!(said.as_deref(), Some(Ok(PropExtras::Exclude)));
        let mut of_materials: Vec<Said> = mesh.slots.iter().map(of_slots).filter(painted).collect();
        of_materials.dedup();
        match of_materials.as_slice() {
            [only @ Some(_)] => found = only.clone(),
            several if several.iter().any(Option::is_some) => {
                warnings.push(BakeWarning::MaterialPaint { mesh: mesh.name.clone() });
            }
            _ => {}
        }
        match found.as_deref() {
            Some(Ok(extras)) => mesh.extras = Some(extras.clone()),
            Some(Err(cause)) => {
                warnings.push(BakeWarning::CustomProperties { mesh: mesh.name.clone(), cause: cause.clone() });
                mesh.extras = Some(PropExtras::Exclude);
            }
            None => {}
        }
    }
}

/// Returns whether a material says that what wears it is not painted.
pub fn excludes(material: &Value) -> bool {
    matches!(said(&material["extras"]).as_deref(), Some(Ok(PropExtras::Exclude)))
}

/// Returns what each node itself says, and what the nearest node above it does.
fn said_by_nodes(carried: &Carried) -> Vec<(Said, Said)> {
    let nodes: &[Value] = carried.root.get("nodes").and_then(Value::as_array).map_or(&[], Vec::as_slice);
    let mut all: Vec<(Said, Said)> = nodes.iter().map(|node| (said(&node["extras"]), None)).collect();
    let children = |node: usize| {
        let children = nodes.get(node).and_then(|node| node["children"].as_array()).into_iter().flatten();
        children.filter_map(Value::as_u64).filter_map(|child| usize::try_from(child).ok())
    };
    let mut is_child = vec![false; nodes.len()];
    for child in (0..nodes.len()).flat_map(children) {
        if let Some(is_child) = is_child.get_mut(child) {
            *is_child = true;
        }
    }
    // A stack, as a chain of nodes may be as deep as its file is long. What is in a circle has no root, so none is met
    // twice.
    let mut open: Vec<usize> = (0..nodes.len()).filter(|&node| is_child.get(node) == Some(&false)).collect();
    let mut seen = vec![false; nodes.len()];
    while let Some(node) = open.pop() {
        match seen.get_mut(node) {
            Some(seen) if !*seen => *seen = true,
            _ => continue,
        }
        let Some((own, above)) = all.get(node).cloned() else { continue };
        let below = own.or(above);
        for child in children(node) {
            if let Some((_, above)) = all.get_mut(child) {
                above.clone_from(&below);
            }
            open.push(child);
        }
    }
    all
}

/// Returns what custom properties say.
fn said(extras: &Value) -> Said {
    if extras.is_null() {
        return None;
    }
    PropExtras::read(&extras.to_string()).transpose().map(Rc::new)
}

impl ModelMesh {
    /// Returns the paint that the custom properties of the mesh give it.
    pub(super) fn coating(&self) -> Option<&PropCoating> {
        match &self.extras {
            Some(PropExtras::Coat(coating)) => Some(coating),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use crate::{bake::model::Place, settings::Preset};

    fn model(document: Value) -> Model {
        let Value::Object(root) = document else { panic!("a document") };
        let list = |name: &str| root.get(name).and_then(Value::as_array).cloned().unwrap_or_default();
        let mut model = Model::default();
        for (node, json) in list("nodes").iter().enumerate() {
            let Some(mesh) = json["mesh"].as_u64() else { continue };
            let slots = json["materials"].as_array().into_iter().flatten();
            let slots = slots.map(|m| Slot { material: m.as_u64().map(|m| m as usize), ..Slot::default() }).collect();
            let transform = bevy_math::DMat4::IDENTITY;
            let place = Place { node, mesh: mesh as usize, primitives: Vec::new(), transform, instance: None };
            model.meshes.push(ModelMesh { name: format!("n{node}"), slots, place: Some(place), ..Default::default() });
        }
        model.materials.materials = list("materials");
        model.carried.root = root;
        read_extras(&mut model);
        model
    }

    fn presets(model: &Model) -> Vec<Option<Preset>> {
        model.meshes.iter().map(|mesh| mesh.coating().map(|coating| coating.preset)).collect()
    }

    #[test]
    fn objects_go_before_meshes_and_both_before_what_is_above() {
        let model = model(json!({
            "nodes": [
                { "children": [1, 2, 3], "extras": { "coating": "harsh" } },
                { "mesh": 0 },
                { "mesh": 1 },
                { "mesh": 1, "extras": { "coating": "marine" }, "children": [4] },
                { "mesh": 0, "extras": { "mass": 3 } },
                { "mesh": 0 },
            ],
            "meshes": [{}, { "extras": { "coating": "gentle" } }],
        }));
        use Preset::{Gentle, Harsh, Marine};
        assert_eq!(presets(&model), [Some(Harsh), Some(Gentle), Some(Marine), Some(Marine), None]);
        assert!(model.warnings.is_empty());
    }

    #[test]
    fn a_material_counts_where_all_of_a_mesh_wears_it() {
        let model = model(json!({
            "nodes": [
                { "mesh": 0, "materials": [1, 1], "extras": { "coating": "harsh" } },
                { "mesh": 0, "materials": [1, 0] },
                { "mesh": 0, "materials": [1, 2] },
            ],
            "meshes": [{}],
            "materials": [{}, { "extras": { "coating": "marine" } }, { "extras": { "coating": false } }],
        }));
        assert_eq!(presets(&model), [Some(Preset::Marine), None, Some(Preset::Marine)]);
        assert_eq!(model.warnings, [BakeWarning::MaterialPaint { mesh: "n1".into() }]);
        assert_eq!([0, 1, 2].map(|m| excludes(&model.materials.materials[m])), [false, false, true]);
    }

    #[test]
    fn what_cannot_be_used_is_left_alone_with_a_warning() {
        let model = model(json!({ "nodes": [{ "mesh": 0, "extras": { "coating": "hrash" } }], "meshes": [{}] }));
        assert_eq!(model.meshes[0].extras, Some(PropExtras::Exclude));
        let text = model.warnings[0].to_string();
        assert!(
            text.starts_with("n0: is left as it is: custom property `coating`") && text.contains("harsh"),
            "{text}"
        );
    }

    #[test]
    fn deep_and_circular_nodes_come_to_an_end() {
        let mut nodes: Vec<Value> = (1..50_000).map(|child| json!({ "children": [child] })).collect();
        nodes.push(json!({ "mesh": 0 }));
        nodes[0]["extras"] = json!({ "coating": "marine" });
        let deep = model(json!({ "nodes": nodes, "meshes": [{}] }));
        assert_eq!(presets(&deep), [Some(Preset::Marine)]);
        let circle = json!({ "nodes": [{ "children": [1], "mesh": 0 }, { "children": [0, 7] }], "meshes": [{}] });
        assert_eq!(presets(&model(circle)), [None]);
    }
}
