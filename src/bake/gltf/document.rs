//! Holds the part of a glTF document that ageing needs. Unknown properties are ignored, so that a fault in a part that
//! does not matter here is none.

use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::{Map, Value};

use super::GltfError;

/// The root object.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Document {
    pub asset: Asset,
    pub scene: Option<usize>,
    #[serde(default)]
    pub scenes: Vec<Scene>,
    #[serde(default)]
    pub nodes: Vec<Node>,
    #[serde(default)]
    pub meshes: Vec<Mesh>,
    #[serde(default)]
    pub accessors: Vec<Accessor>,
    #[serde(default)]
    pub buffer_views: Vec<BufferView>,
    #[serde(default)]
    pub buffers: Vec<Buffer>,
    #[serde(default)]
    pub images: Vec<Image>,
    #[serde(default)]
    pub materials: Vec<Value>,
    #[serde(default)]
    pub textures: Vec<Value>,
    #[serde(default)]
    pub samplers: Vec<Value>,
    #[serde(default)]
    pub extensions_used: Vec<String>,
    #[serde(default)]
    pub extensions_required: Vec<String>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Asset {
    pub version: String,
    pub copyright: Option<String>,
}

#[derive(Debug, Deserialize)]
pub struct Scene {
    #[serde(default)]
    pub nodes: Vec<usize>,
}

#[derive(Debug, Deserialize)]
pub struct Node {
    pub name: Option<String>,
    pub mesh: Option<usize>,
    pub skin: Option<usize>,
    #[serde(default)]
    pub children: Vec<usize>,
    pub matrix: Option<[f32; 16]>,
    pub translation: Option<[f32; 3]>,
    pub rotation: Option<[f32; 4]>,
    pub scale: Option<[f32; 3]>,
    #[serde(default)]
    pub extensions: Map<String, Value>,
}

#[derive(Debug, Deserialize)]
pub struct Mesh {
    pub name: Option<String>,
    pub primitives: Vec<Primitive>,
}

#[derive(Debug, Deserialize)]
pub struct Primitive {
    pub attributes: Attributes,
    pub indices: Option<usize>,
    pub material: Option<usize>,
    pub mode: Option<u32>,
    #[serde(default)]
    pub targets: Vec<Value>,
}

/// Accessors by the names of attributes.
#[derive(Debug, Deserialize)]
pub struct Attributes(BTreeMap<String, Value>);

impl Attributes {
    /// The accessor of an attribute.
    pub fn get(&self, name: &str) -> Option<usize> {
        self.0.get(name)?.as_u64().and_then(|index| usize::try_from(index).ok())
    }

    /// The sets of texture coordinates that there are, ascending.
    pub fn sets(&self) -> Vec<usize> {
        let mut sets: Vec<usize> =
            self.0.keys().filter_map(|name| name.strip_prefix("TEXCOORD_")?.parse().ok()).collect();
        sets.sort_unstable();
        sets
    }

    /// The accessor of a set of texture coordinates.
    pub fn set(&self, set: usize) -> Option<usize> {
        self.get(&format!("TEXCOORD_{set}"))
    }

    /// Whether there are attributes that a film does not have, but for texture coordinates and what skins need.
    pub fn has_more(&self) -> bool {
        let known = ["POSITION", "NORMAL", "TANGENT", "COLOR_0"];
        let skinned =
            |name: &str| name.starts_with("TEXCOORD_") || name.starts_with("JOINTS_") || name.starts_with("WEIGHTS_");
        self.0.keys().any(|name| !known.contains(&name.as_str()) && !skinned(name))
    }
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Accessor {
    pub buffer_view: Option<usize>,
    #[serde(default)]
    pub byte_offset: u64,
    pub component_type: u32,
    #[serde(default)]
    pub normalized: bool,
    pub count: u64,
    pub r#type: String,
    pub sparse: Option<Sparse>,
}

#[derive(Debug, Deserialize)]
pub struct Sparse {
    pub count: u64,
    pub indices: SparseIndices,
    pub values: SparseValues,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SparseIndices {
    pub buffer_view: usize,
    #[serde(default)]
    pub byte_offset: u64,
    pub component_type: u32,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct SparseValues {
    pub buffer_view: usize,
    #[serde(default)]
    pub byte_offset: u64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct BufferView {
    pub buffer: usize,
    #[serde(default)]
    pub byte_offset: u64,
    pub byte_length: u64,
    pub byte_stride: Option<u64>,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Buffer {
    pub uri: Option<String>,
    pub byte_length: u64,
}

#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
pub struct Image {
    pub uri: Option<String>,
    pub buffer_view: Option<usize>,
    pub mime_type: Option<String>,
    pub name: Option<String>,
    /// Extensions and extras.
    #[serde(flatten)]
    pub rest: Map<String, Value>,
}

/// The element that `from` refers to.
pub fn lookup<'a, T>(items: &'a [T], index: usize, kind: &'static str, from: &str) -> Result<&'a T, GltfError> {
    let dangling = || GltfError::Dangling { from: from.into(), kind, index, count: items.len() };
    items.get(index).ok_or_else(dangling)
}
