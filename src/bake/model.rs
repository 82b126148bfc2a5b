//! Holds a model as it was read: surfaces in scene space, and its materials.

use std::{path::PathBuf, sync::Arc};

use bevy_math::{DMat4, DVec3, Quat, Vec3};
use serde_json::Value;

use super::{carried::Carried, warning::BakeWarning};
use crate::{extras::PropExtras, remesh::BuiltFilm, surface::Surface};

/// Everything that a file holds and ageing needs. Read it from a file with [`Input::read`](super::Input::read), from
/// bytes with [`from_gltf`](Self::from_gltf) or [`from_obj`](Self::from_obj), or put it together.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Name of the input in messages: the file or the test piece.
    pub origin: String,
    /// Copyright notice (glTF `asset.copyright`); kept in the aged model.
    pub copyright: Option<String>,
    /// One mesh for each node that has one, in the order in which the scene is walked.
    pub meshes: Vec<ModelMesh>,
    /// Materials of the file.
    pub materials: MaterialLibrary,
    /// Everything that was left out or changed.
    pub warnings: Vec<BakeWarning>,
    /// Document that the model was read from, for all that ageing does not change.
    pub carried: Carried,
    /// Files that the model is made of, as far as it comes from files: outputs must not take their places
    /// ([`StagedFiles::guard`](super::StagedFiles::guard)).
    pub files: Vec<PathBuf>,
}

/// Mesh of one node: one connected prop to the paint.
#[derive(Clone, Debug, Default)]
pub struct ModelMesh {
    /// Name of the node, else of its mesh.
    pub name: String,
    /// Triangles in scene space, but for the place: around [`Self::origin`]. The surface's slots index [`Self::slots`].
    pub surface: Surface,
    /// Place in the scene where the surface's zero lies. Far from it single precision is too coarse for a film: the
    /// rule that no vertex lies below its plane asks for 1e-5 of an edge.
    pub origin: Vec3,
    /// Attributes and material of each primitive.
    pub slots: Vec<Slot>,
    /// Film that comes with the mesh, as test pieces have one; `None`: one is built.
    pub film: Option<BuiltFilm>,
    /// Place in the document that the model was read from; `None`: the aged mesh gets a node of its own.
    pub place: Option<Place>,
    /// Paint by its custom properties, which [`bake`](super::bake()) reads; `None`: it is as
    /// [`BakeOptions::settings`](super::BakeOptions::settings) say.
    pub extras: Option<PropExtras>,
}

/// Place of a mesh in the document that a model was read from.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Index of the node.
    pub node: usize,
    /// Index of the node's mesh.
    pub mesh: usize,
    /// Index in the mesh of each slot's primitive; `None` for those that are left as they are.
    pub primitives: Vec<Option<usize>>,
    /// From the mesh's own space into scene space.
    pub transform: DMat4,
    /// Instance of the node that this is, where the node has several (extension `EXT_mesh_gpu_instancing`).
    pub instance: Option<Instance>,
}

/// One of several instances of a node, in the node's space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instance {
    /// Number of the instance, from 0.
    pub index: usize,
    /// Translation.
    pub translation: Vec3,
    /// Rotation, of unit length.
    pub rotation: Quat,
    /// Scale.
    pub scale: Vec3,
}

/// Moves positions to around the middle of their bounding box, and returns that too.
pub(super) fn centred(positions: &[DVec3]) -> (Vec<Vec3>, Vec3) {
    let finite = || positions.iter().copied().filter(|p| p.is_finite());
    let bounds = finite().map(|p| (p, p)).reduce(|(low, high), (p, _)| (low.min(p), high.max(p)));
    let middle = bounds.map_or(Vec3::ZERO, |(low, high)| (low * 0.5 + high * 0.5).as_vec3());
    let middle = if middle.is_finite() { middle } else { Vec3::ZERO };
    (positions.iter().map(|&p| (p - middle.as_dvec3()).as_vec3()).collect(), middle)
}

/// Attributes that a primitive has, so that nothing is made up in the aged model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slot {
    /// Index into [`MaterialLibrary::materials`]; `None`: glTF's default material.
    pub material: Option<usize>,
    /// Whether it has first texture coordinates.
    pub uvs: bool,
    /// Whether it has second texture coordinates.
    pub uvs_1: bool,
    /// Whether it has tangents.
    pub tangents: bool,
    /// Whether it has vertex colours.
    pub colors: bool,
}

/// Materials as glTF has them. The arrays are kept whole and in order, so that every index in them holds, in extensions
/// that nobody here knows too.
///
/// ```
/// use bevy_coating::bake::MaterialLibrary;
///
/// let mut materials = MaterialLibrary::default();
/// let paint = materials.add_plain_paint();
/// assert_eq!(materials.materials[paint]["name"], "paint");
/// ```
#[derive(Clone, Debug, Default)]
pub struct MaterialLibrary {
    /// Materials (glTF `materials`).
    pub materials: Vec<Value>,
    /// Textures (glTF `textures`).
    pub textures: Vec<Value>,
    /// Samplers (glTF `samplers`).
    pub samplers: Vec<Value>,
    /// Images (glTF `images`) with their bytes; empty if they were skipped.
    pub images: Vec<Image>,
    /// Extensions that the file uses (glTF `extensionsUsed`).
    pub extensions_used: Vec<String>,
    /// Extensions that the file requires (glTF `extensionsRequired`).
    pub extensions_required: Vec<String>,
}

/// A texture image as it was stored.
#[derive(Clone, Debug, Default)]
pub struct Image {
    /// Name, if it has one.
    pub name: Option<String>,
    /// Media type: `image/png`, `image/jpeg`, or one that an extension allows.
    pub mime_type: String,
    /// Bytes of the encoded image; empty if they cannot be read. Images that share them in the file share them here.
    pub bytes: Arc<[u8]>,
    /// Extensions and extras of the image, and its `uri` if its bytes cannot be read.
    pub rest: serde_json::Map<String, Value>,
}

impl MaterialLibrary {
    /// Adds plain two-sided paint, for models that come without materials, and returns its index.
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
