//! Takes the document that a model was read from apart, and what is coated out of it.

use std::collections::BTreeSet;

use serde_json::{Map, Value, json};

use super::{
    pool::Pool,
    uses::{Uses, index},
};
use crate::bake::{carried::Carried, coat::Prop, model::Place};

/// Name of the extension that gives a node instances.
const INSTANCING: &str = "EXT_mesh_gpu_instancing";

/// A document without the primitives that are coated.
#[derive(Debug, Default)]
pub struct Document {
    /// Everything that has no field of its own.
    pub root: Map<String, Value>,
    pub nodes: Vec<Value>,
    pub meshes: Pool,
    pub accessors: Pool,
    pub views: Pool,
    /// Elements that the rest refers to.
    pub uses: Uses,
    /// For each prop its node, and the index of its mesh.
    pub places: Vec<Option<Spot>>,
}

/// Place of a prop in a document.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    pub node: usize,
    pub mesh: usize,
}

impl Document {
    /// Takes the props out of a document.
    pub fn without(props: &[Prop], carried: &Carried) -> Self {
        let mut root = carried.root.clone();
        let mut list = |name: &str| match root.remove(name) {
            Some(Value::Array(elements)) => elements,
            _ => Vec::new(),
        };
        let mut nodes = list("nodes");
        let mut meshes = Pool::new(list("meshes"));
        let (mut accessors, mut views) = (Pool::new(list("accessors")), Pool::new(list("bufferViews")));
        let images = Uses::of(&list("images"));
        // These are written again.
        for name in ["buffers", "materials", "textures", "samplers"] {
            list(name);
        }

        let mut coated = Uses::default();
        let owners: Vec<Option<usize>> = props
            .iter()
            .map(|prop| Some(prop.place.as_ref()).flatten().map(|p| strip_node(&mut nodes, p, &mut coated)))
            .collect();
        let left = Uses::of(nodes.iter().chain(root.values())).meshes;
        let own: BTreeSet<usize> = props.iter().filter_map(|prop| Some(prop.place.as_ref()?.mesh)).collect();
        for &mesh in own.iter().filter(|mesh| !left.contains(mesh)) {
            meshes.release(mesh);
        }
        // A mesh that is nowhere else any more is replaced where it was.
        let places = props.iter().zip(owners).map(|(prop, owner)| {
            let (place, node) = (prop.place.as_ref()?, owner?);
            let (rest, gone) = split_mesh(carried.element("meshes", place.mesh), place);
            gone.iter().for_each(|primitive| coated.add(primitive));
            let mesh = if meshes.is_free(place.mesh) { place.mesh } else { meshes.len() };
            meshes.put(mesh, rest);
            Some(Spot { node, mesh })
        });
        let places = places.collect();

        let mut uses = Uses::of(nodes.iter().chain(meshes.elements()));
        for (key, value) in &root {
            uses.add_field(key, value);
            uses.add(value);
        }
        let gone: Vec<usize> = coated.accessors.difference(&uses.accessors).copied().collect();
        for accessor in gone {
            coated.add(accessors.get(accessor));
            accessors.release(accessor);
        }
        accessors.elements().iter().for_each(|accessor| uses.add(accessor));
        // Images are written again, from the library.
        coated.views.extend(images.views);
        for &view in coated.views.difference(&uses.views) {
            views.release(view);
        }
        drop_weights(&mut root, props);
        Self { root, nodes, meshes, accessors, views, uses, places }
    }

    /// Puts a mesh at its place and on its node. A mesh without primitives is none: its place becomes free.
    pub fn put_mesh(&mut self, node: usize, index: usize, mesh: Value) {
        if mesh.get("primitives").and_then(Value::as_array).is_none_or(Vec::is_empty) {
            self.meshes.release(index);
            return;
        }
        self.meshes.put(index, mesh);
        if let Some(fields) = self.nodes.get_mut(node).and_then(Value::as_object_mut) {
            fields.insert("mesh".into(), index.into());
        }
    }

    /// Adds a mesh and returns its index.
    pub fn add_mesh(&mut self, mesh: Value) -> usize {
        self.meshes.add(mesh)
    }

    /// The root object with nodes and meshes.
    pub fn into_root(self) -> Map<String, Value> {
        let Self { mut root, nodes, meshes, .. } = self;
        for (key, list) in [("nodes", nodes), ("meshes", meshes.finish(&Value::Null))] {
            if !list.is_empty() {
                root.insert(key.into(), list.into());
            }
        }
        root
    }

    /// Adds a node and returns its index.
    pub fn add_node(&mut self, node: Value) -> usize {
        self.nodes.push(node);
        self.nodes.len() - 1
    }

    /// Makes a node the child of another.
    pub fn add_child(&mut self, parent: usize, child: usize) {
        add_child(&mut self.nodes, parent, child);
    }

    /// Adds nodes to the scene that is shown first. A document without scenes gets one, of all nodes at the top.
    pub fn add_to_scene(&mut self, added: &[usize]) {
        let scene = self.root.get("scene").and_then(index).unwrap_or(0);
        let scenes = self.root.entry("scenes").or_insert_with(|| json!([]));
        if let Some(empty) = scenes.as_array_mut().filter(|scenes| scenes.is_empty()) {
            let children: BTreeSet<u64> = self
                .nodes
                .iter()
                .flat_map(|node| node["children"].as_array().into_iter().flatten().filter_map(Value::as_u64))
                .collect();
            let roots: Vec<usize> = (0..self.nodes.len()).filter(|&i| !children.contains(&(i as u64))).collect();
            empty.push(json!({ "nodes": roots }));
            self.root.insert("scene".into(), 0.into());
            return;
        }
        if added.is_empty() {
            return;
        }
        if let Some(fields) = scenes.get_mut(scene).and_then(Value::as_object_mut) {
            let nodes = fields.entry("nodes").or_insert_with(|| json!([]));
            if let Some(nodes) = nodes.as_array_mut() {
                nodes.extend(added.iter().map(|&node| Value::from(node)));
            }
        }
    }
}

/// Takes mesh, skin and weights off a prop's node, and adds a child for an instance. Returns the node that the aged
/// mesh belongs to. Accessors of the instances go to `coated`.
fn strip_node(nodes: &mut Vec<Value>, place: &Place, coated: &mut Uses) -> usize {
    let Some(fields) = nodes.get_mut(place.node).and_then(Value::as_object_mut) else { return place.node };
    for key in ["mesh", "skin", "weights"] {
        fields.remove(key);
    }
    let Some(instance) = &place.instance else { return place.node };
    if let Some(extensions) = fields.get_mut("extensions").and_then(Value::as_object_mut) {
        extensions.remove(INSTANCING).iter().for_each(|extension| coated.add(extension));
        if extensions.is_empty() {
            fields.remove("extensions");
        }
    }
    let name = fields.get("name").and_then(Value::as_str).unwrap_or("instance");
    let child = json!({
        "name": format!("{name} {}", instance.index + 1),
        "translation": instance.translation.to_array(),
        "rotation": instance.rotation.to_array(),
        "scale": instance.scale.to_array(),
    });
    let index = nodes.len();
    nodes.push(child);
    add_child(nodes, place.node, index);
    index
}

fn add_child(nodes: &mut [Value], parent: usize, child: usize) {
    let children = nodes.get_mut(parent).and_then(Value::as_object_mut).map(|fields| fields.entry("children"));
    if let Some(children) = children.map(|entry| entry.or_insert_with(|| json!([]))).and_then(Value::as_array_mut) {
        children.push(child.into());
    }
}

/// The mesh without its coated primitives and without morph targets, and the coated ones.
fn split_mesh(mesh: &Value, place: &Place) -> (Value, Vec<Value>) {
    let mut mesh = mesh.clone();
    let mut gone = Vec::new();
    if let Some(fields) = mesh.as_object_mut() {
        fields.remove("weights");
        let primitives = match fields.remove("primitives") {
            Some(Value::Array(primitives)) => primitives,
            _ => Vec::new(),
        };
        let mut rest = Vec::new();
        for (i, mut primitive) in primitives.into_iter().enumerate() {
            if place.primitives.contains(&Some(i)) {
                gone.push(primitive);
                continue;
            }
            // All primitives of a mesh have the same number of targets, and films have none.
            if let Some(targets) = primitive.as_object_mut().and_then(|fields| fields.remove("targets")) {
                gone.push(json!({ "targets": targets }));
            }
            rest.push(primitive);
        }
        fields.insert("primitives".into(), rest.into());
    }
    (mesh, gone)
}

/// Removes the channels of animations that move morph targets of coated nodes, and animations that have no others.
fn drop_weights(root: &mut Map<String, Value>, props: &[Prop]) {
    let coated: BTreeSet<u64> = props.iter().filter_map(|prop| Some(prop.place.as_ref()?.node as u64)).collect();
    let Some(animations) = root.get_mut("animations").and_then(Value::as_array_mut) else { return };
    animations.retain_mut(|animation| {
        let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) else { return true };
        let before = channels.len();
        channels.retain(|channel| {
            let target = &channel["target"];
            target["path"] != "weights" || !target["node"].as_u64().is_some_and(|node| coated.contains(&node))
        });
        before == 0 || !channels.is_empty()
    });
    if animations.is_empty() {
        root.remove("animations");
    }
}
