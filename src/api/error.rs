//! Defines the errors with which a prop is refused.

use bevy::{ecs::entity::Entity, mesh::PrimitiveTopology};

use crate::{masks::MaskError, settings::SettingsError, surface::BuildError};

/// Error that says why a prop could not be coated. The prop keeps its own mesh and material.
///
/// It is logged and sent as [`FilmFailed`](super::messages::FilmFailed).
///
/// ```
/// use bevy::prelude::Entity;
/// use bevy_coating::prelude::*;
///
/// let error = CoatingError { entity: Entity::PLACEHOLDER, cause: CoatingFault::NoPositions };
/// assert!(error.to_string().ends_with("its mesh has no positions (`Mesh::ATTRIBUTE_POSITION`)"));
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("entity {entity} cannot be coated: {cause}")]
pub struct CoatingError {
    /// Entity of the mesh, or of the node whose meshes would have shared a film.
    pub entity: Entity,
    /// Fault of the prop; its text names the way out.
    pub cause: CoatingFault,
}

/// Fault of a prop that cannot be coated. Its text says what is wrong and how to mend it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CoatingFault {
    /// Mesh that follows a skeleton.
    #[error("its mesh is skinned; coat the rigid parts, or bake the pose into a mesh without joints")]
    Skinned,
    /// Mesh with morph targets in use.
    #[error("its mesh is morphed; bake the shape into a mesh without morph targets")]
    Morphed,
    /// Material that is alpha-blended, of a mesh that has a `Coating` itself. Below a coating such meshes are left
    /// alone.
    #[error("its material is alpha-blended; use `AlphaMode::Opaque` or `AlphaMode::Mask`")]
    AlphaBlended,
    /// Material that light passes through, of a mesh that has a `Coating` itself. Below a coating such meshes are left
    /// alone.
    #[error("light passes through its material; set `StandardMaterial::specular_transmission` to 0")]
    Transmissive,
    /// Material other than `StandardMaterial`, while stains are to be drawn by a material
    /// ([`StainDisplay::Material`](super::stain_display::StainDisplay::Material)).
    #[error(
        "it has material type {material}; only `StandardMaterial` can be replaced by one with stains: set \
         `Coating::stain_display` to `StainDisplay::VertexColor` or `StainDisplay::None`, which leave the material \
         alone"
    )]
    CustomMaterial {
        /// Type path of the material component.
        material: String,
    },
    /// Mesh asset that could not be loaded.
    #[error("its mesh could not be loaded; see the asset server's error")]
    MeshNotLoaded,
    /// Material asset that could not be loaded.
    #[error("its material could not be loaded; see the asset server's error")]
    MaterialNotLoaded,
    /// Settings asset that could not be loaded.
    #[error("its settings could not be loaded; see the asset server's error")]
    SettingsNotLoaded,
    /// Image of a mask that could not be loaded.
    #[error("its mask image `{name}` could not be loaded; see the asset server's error")]
    MaskNotLoaded {
        /// Name of the image in [`CoatingMasks::images`](super::masks::CoatingMasks::images).
        name: String,
    },
    /// Image of a mask that cannot be read: compressed, or on the GPU only.
    #[error("its mask image `{name}` cannot be read: {cause}")]
    MaskImage {
        /// Name of the image in [`CoatingMasks::images`](super::masks::CoatingMasks::images).
        name: String,
        /// Reason in words, with the way out.
        cause: String,
    },
    /// Mask that is out of range, or looks at something that the prop does not have.
    #[error(transparent)]
    Mask(#[from] MaskError),
    /// Setting that is out of its range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// Field of `Coating` that is out of its range.
    #[error("`Coating::{field}` is {found}, but must be {range}")]
    Field {
        /// Name of the field.
        field: &'static str,
        /// Value of the field.
        found: f64,
        /// Range of values that are allowed.
        range: &'static str,
    },
    /// Mesh of points or lines instead of triangles.
    #[error("its mesh is a {0:?}, not of triangles")]
    NotTriangles(PrimitiveTopology),
    /// Mesh whose data is on the GPU only.
    #[error("its mesh is in the render world only; load it with `RenderAssetUsages::MAIN_WORLD` as well")]
    RenderWorldOnly,
    /// Mesh without positions.
    #[error("its mesh has no positions (`Mesh::ATTRIBUTE_POSITION`)")]
    NoPositions,
    /// Vertex attribute of a format that cannot be read.
    #[error("its mesh has {attribute} of format {found}, which must be {expected}")]
    Format {
        /// Name of the attribute.
        attribute: &'static str,
        /// Format of the attribute.
        found: String,
        /// Formats that can be read.
        expected: &'static str,
    },
    /// World scale of the prop that is zero or not finite along an axis: its x, y and z.
    #[error("its world scale is ({0}, {1}, {2}); no axis may be zero, NaN or infinite")]
    Scale(f32, f32, f32),
    /// Unit of the world, [`CoatingUnit::metres`](super::unit::CoatingUnit::metres), that is NaN or out of its range.
    #[error("`CoatingUnit::metres` is {0}, but must be 0.0001 to 10000")]
    Unit(f32),
    /// Surface of which no film could be built.
    #[error(transparent)]
    Build(#[from] BuildError),
}
