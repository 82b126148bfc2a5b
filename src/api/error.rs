//! Why a prop could not be coated.

use bevy::{ecs::entity::Entity, mesh::PrimitiveTopology};

use crate::{settings::SettingsError, surface::BuildError};

/// Why a prop could not be coated. It keeps its own mesh and material.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("entity {entity} cannot be coated: {cause}")]
pub struct CoatingError {
    /// Entity of the mesh, or of the node whose meshes would have shared a film.
    pub entity: Entity,
    /// What is wrong, and the way out.
    pub cause: CoatingFault,
}

/// What is wrong with a prop, and the way out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CoatingFault {
    /// The mesh follows a skeleton.
    #[error("its mesh is skinned; coat the rigid parts, or bake the pose into a mesh without joints")]
    Skinned,
    /// The mesh has morph targets in use.
    #[error("its mesh is morphed; bake the shape into a mesh without morph targets")]
    Morphed,
    /// The material is see-through.
    #[error(
        "its material is alpha-blended; use `AlphaMode::Opaque` or `AlphaMode::Mask`, or coat the other parts only"
    )]
    AlphaBlended,
    /// The material is not `StandardMaterial`, and stains are to be shown by a material.
    #[error(
        "it has material type {material}; only `StandardMaterial` can be replaced by one with stains: set `Coating::stain_display` to \
         `StainDisplay::VertexColor` or `StainDisplay::None`, which leave the material alone"
    )]
    CustomMaterial {
        /// Type path of the material component.
        material: String,
    },
    /// The mesh asset could not be loaded.
    #[error("its mesh could not be loaded; see the asset server's error")]
    MeshNotLoaded,
    /// The material asset could not be loaded.
    #[error("its material could not be loaded; see the asset server's error")]
    MaterialNotLoaded,
    /// The settings asset could not be loaded.
    #[error("its settings could not be loaded; see the asset server's error")]
    SettingsNotLoaded,
    /// A setting is out of its range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A field of `Coating` is out of its range.
    #[error("`Coating::{field}` is {found}, but must be {range}")]
    Field {
        /// The field.
        field: &'static str,
        /// Its value.
        found: f64,
        /// What it may be.
        range: &'static str,
    },
    /// The mesh consists of points or lines.
    #[error("its mesh is a {0:?}, not of triangles")]
    NotTriangles(PrimitiveTopology),
    /// The mesh has been handed over to the GPU.
    #[error("its mesh is in the render world only; load it with `RenderAssetUsages::MAIN_WORLD` as well")]
    RenderWorldOnly,
    /// The mesh has no positions.
    #[error("its mesh has no positions (`Mesh::ATTRIBUTE_POSITION`)")]
    NoPositions,
    /// An attribute has a format that cannot be read.
    #[error("its mesh has {attribute} of format {found}, which must be {expected}")]
    Format {
        /// The attribute.
        attribute: &'static str,
        /// Its format.
        found: String,
        /// What can be read.
        expected: &'static str,
    },
    /// The prop's world scale is zero or not finite along an axis.
    #[error("its world scale is ({0}, {1}, {2}); no axis may be zero, NaN or infinite")]
    Scale(f32, f32, f32),
    /// The film could not be built.
    #[error(transparent)]
    Build(#[from] BuildError),
}
