//! A prop as it was read: surfaces in scene space, and its materials.

use bevy_coating::{remesh::BuiltFilm, surface::Surface};
use bevy_math::{DVec3, Vec3};
use serde_json::Value;

/// All that a file holds and ageing needs.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// What to call the input in messages: the file or the generator.
    pub origin: String,
    /// Who made it (glTF `asset.copyright`); kept in the aged model.
    pub copyright: Option<String>,
    /// One mesh for each node that has one, in the order in which the scene is walked.
    pub meshes: Vec<ModelMesh>,
    /// The file's materials.
    pub materials: MaterialLibrary,
    /// What was left out or changed.
    pub warnings: Vec<String>,
}

/// The mesh of one node: one connected prop to the paint.
#[derive(Clone, Debug, Default)]
pub struct ModelMesh {
    /// Name of the node.
    pub name: String,
    /// Its triangles, in scene space but for the place: around [`Self::origin`]. The surface's slots index
    /// [`Self::slots`].
    pub surface: Surface,
    /// Where in the scene the surface's zero lies. Far from it single precision is too coarse for a film: the rule
    /// that no vertex lies below its plane asks for 1e-5 of an edge.
    pub origin: Vec3,
    /// One a primitive.
    pub slots: Vec<Slot>,
    /// A film that comes with the mesh (test pieces); else one is built.
    pub film: Option<BuiltFilm>,
}

/// Moves positions to around the middle of their bounding box, which is given too.
pub fn centred(positions: &[DVec3]) -> (Vec<Vec3>, Vec3) {
    let finite = || positions.iter().copied().filter(|p| p.is_finite());
    let bounds = finite().map(|p| (p, p)).reduce(|(low, high), (p, _)| (low.min(p), high.max(p)));
    let middle = bounds.map_or(Vec3::ZERO, |(low, high)| (low * 0.5 + high * 0.5).as_vec3());
    let middle = if middle.is_finite() { middle } else { Vec3::ZERO };
    (positions.iter().map(|&p| (p - middle.as_dvec3()).as_vec3()).collect(), middle)
}

/// What a primitive has, so that nothing is made up in the aged model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slot {
    /// Index into [`MaterialLibrary::materials`]; `None`: the format's default material.
    pub material: Option<usize>,
    /// Has first texture coordinates.
    pub uvs: bool,
    /// Has second texture coordinates.
    pub uvs_1: bool,
    /// Has tangents.
    pub tangents: bool,
    /// Has vertex colours.
    pub colors: bool,
}

/// Materials as glTF has them. The arrays are kept whole and in order, so that every index in them holds, in
/// extensions that nobody here knows too.
#[derive(Clone, Debug, Default)]
pub struct MaterialLibrary {
    /// glTF `materials`.
    pub materials: Vec<Value>,
    /// glTF `textures`.
    pub textures: Vec<Value>,
    /// glTF `samplers`.
    pub samplers: Vec<Value>,
    /// glTF `images`, with their bytes.
    pub images: Vec<Image>,
    /// glTF `extensionsUsed` of the file.
    pub extensions_used: Vec<String>,
    /// glTF `extensionsRequired` of the file.
    pub extensions_required: Vec<String>,
}

/// A texture image, as it was stored.
#[derive(Clone, Debug, Default)]
pub struct Image {
    /// Name, if it has one.
    pub name: Option<String>,
    /// `image/png`, `image/jpeg`, or what an extension allows.
    pub mime_type: String,
    /// The encoded image.
    pub bytes: Vec<u8>,
    /// Extensions and extras of the image.
    pub rest: serde_json::Map<String, Value>,
}

impl MaterialLibrary {
    /// Adds plain two-sided paint, for models that come without materials. Gives its index.
    pub fn add_plain_paint(&mut self) -> usize {
        self.materials.push(serde_json::json!({
            "name": "paint",
            "doubleSided": true,
            "pbrMetallicRoughness": {
                "baseColorFactor": [0.55, 0.58, 0.60, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.45
            }
        }));
        self.materials.len() - 1
    }
}
