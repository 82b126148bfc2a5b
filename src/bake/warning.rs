//! Holds what the user of a baked model should know.

use crate::surface::{BuildError, BuildWarning};

/// Something of a model that was left out, changed or put right. Its text begins with the name of the mesh if it is
/// about one.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BakeWarning {
    /// Primitives of points or lines were left out.
    #[error("{mesh}: {count} primitives of points or lines are left out")]
    PrimitivesSkipped {
        /// Name of the mesh.
        mesh: String,
        /// Number of primitives.
        count: usize,
    },
    /// The mesh has morph targets, which were left out.
    #[error("{mesh}: is morphed: its base shape is aged, the targets are left out")]
    Morphed {
        /// Name of the mesh.
        mesh: String,
    },
    /// The mesh has a skin, which was left out.
    #[error("{mesh}: is skinned: its bind pose is aged, the skin is left out")]
    Skinned {
        /// Name of the mesh.
        mesh: String,
    },
    /// The mesh has more texture coordinates than the two sets that are kept.
    #[error("{mesh}: has more than two sets of texture coordinates; only the first two are kept")]
    ExtraTextureCoordinates {
        /// Name of the mesh.
        mesh: String,
    },
    /// The surface was put right while its film was built.
    #[error("{mesh}: {warning}")]
    Build {
        /// Name of the mesh.
        mesh: String,
        /// Fault of the surface that was put right.
        warning: BuildWarning,
    },
    /// The mesh was left out, because no film can be made of it.
    #[error("{mesh}: left out: {cause}")]
    LeftOut {
        /// Name of the mesh.
        mesh: String,
        /// Why no film can be made of it.
        cause: BuildError,
    },
    /// A material cannot be baked, so the paint that wears it is written without stains.
    #[error("{mesh}: its paint shows no stains: material {material:?} cannot be read: {cause}")]
    MaterialUnreadable {
        /// Name of the mesh.
        mesh: String,
        /// Name of the material; empty if it has none.
        material: String,
        /// Why it cannot be read.
        cause: String,
    },
    /// Textures that are not baked and use second texture coordinates were left out: the baked textures take their
    /// place.
    #[error("{mesh}: textures other than colour, metalness and normals that use second coordinates are left out")]
    SecondCoordinates {
        /// Name of the mesh.
        mesh: String,
    },
    /// The surface falls into more charts than its textures have room for, so its stains are vertex colours.
    #[error(
        "{mesh}: its surface is too rugged for textures of {texels} texels, so it has vertex colours; ask for larger \
         textures"
    )]
    TooRugged {
        /// Name of the mesh.
        mesh: String,
        /// Texels along a side of its textures.
        texels: u32,
    },
    /// A .mtl file cannot be read.
    #[error("{file}: cannot be read: {cause}; its materials are plain paint")]
    MaterialFile {
        /// Name of the file, as the model has it.
        file: String,
        /// Why it cannot be read.
        cause: String,
    },
    /// Statements of a .mtl file were left out.
    #[error("{file}: {count} statements cannot be read and are left out, the first in line {line}: {cause}")]
    MaterialStatements {
        /// Name of the file, as the model has it.
        file: String,
        /// Number of statements.
        count: usize,
        /// Number of the first one's line, from 1.
        line: usize,
        /// Fault of the first one.
        cause: String,
    },
    /// Materials that faces of an .obj file have are in none of its .mtl files.
    #[error("{count} materials are defined in no .mtl file and are plain paint; the first is {first:?}")]
    MaterialsUndefined {
        /// Number of materials.
        count: usize,
        /// Name of the first one.
        first: String,
    },
    /// Images that are files of their own cannot be read.
    #[error("{count} images cannot be read and do not show; the first is {first:?}: {cause}")]
    ImagesUnreadable {
        /// Number of images.
        count: usize,
        /// Path of the first one, as the model has it.
        first: String,
        /// Why that cannot be read.
        cause: String,
    },
    /// Images of a .mtl file were left out, since glTF has no place for them or they do not fit there.
    #[error("{count} images of materials have no place in glTF and are left out: {kinds}")]
    MapsLeftOut {
        /// Number of images.
        count: usize,
        /// Names of the statements, each once.
        kinds: String,
    },
}
