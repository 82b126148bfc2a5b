//! Holds what can go wrong between a prop's file and its aged model.

use std::{io, path::PathBuf};

use super::{
    gltf::GltfError,
    limits::{MAX_AGE, MAX_STEPS_PER_AGE, TEXTURE_SIZES, UNITS},
    obj::ObjError,
};
use crate::{film::InvariantError, masks::MaskError, settings::SettingsError, surface::BuildError};

/// Why a prop could not be aged, or the result not be written. Its text is one line: where, what, and where it helps,
/// the way out.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BakeError {
    /// A file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file's name does not end like a model.
    #[error("{}: is no .glb, .gltf or .obj file; convert it to .glb", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
    },
    /// The file is no usable glTF.
    #[error("{}: {source}", path.display())]
    Gltf {
        /// The file.
        path: PathBuf,
        /// Fault of the file.
        source: GltfError,
    },
    /// The file is no usable OBJ.
    #[error("{}: {source}", path.display())]
    Obj {
        /// The file.
        path: PathBuf,
        /// Fault of the file.
        source: ObjError,
    },
    /// There is nothing to coat.
    #[error("{origin}: holds no triangle mesh; export the model with its meshes as triangles")]
    Empty {
        /// Name of the input.
        origin: String,
    },
    /// Everything is glass or excluded.
    #[error("{origin}: all of it is glass (alpha-blended or transmissive) or excluded, so there is nothing to age")]
    AllLeftAlone {
        /// Name of the input.
        origin: String,
    },
    /// The options are out of their ranges.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// No film can be made of a mesh.
    #[error("{origin}: mesh {mesh:?}: {source}")]
    Build {
        /// Name of the input.
        origin: String,
        /// Name of the mesh.
        mesh: String,
        /// Why no film can be made of it.
        source: BuildError,
    },
    /// A mask cannot be put on a mesh.
    #[error("{origin}: mesh {mesh:?}: {source}")]
    Mask {
        /// Name of the input.
        origin: String,
        /// Name of the mesh.
        mesh: String,
        /// Why not.
        source: MaskError,
    },
    /// A mask, or a file of masks, cannot be used.
    #[error(transparent)]
    Masks(#[from] MaskError),
    /// The image of a mask cannot be used.
    #[error("{}: is no image for a mask: {cause}; save it as PNG or JPEG", path.display())]
    MaskImage {
        /// The file.
        path: PathBuf,
        /// Why not.
        cause: String,
    },
    /// A film is no sound film, or broke a rule of the method while it aged: a fault of this crate.
    #[error("{origin}: mesh {mesh:?}: the film is broken: {source}; please report this with the file and the options")]
    Broken {
        /// Name of the input.
        origin: String,
        /// Name of the mesh.
        mesh: String,
        /// Fault of the film.
        source: BrokenFilm,
    },
    /// The aged model does not fit into a binary glTF.
    #[error("{origin}: the aged model is larger than the 4 GiB a .glb can hold; ask for fewer triangles")]
    TooLarge {
        /// Name of the input.
        origin: String,
    },
    /// A file to be written is one that is read, or another one that is written.
    #[error("{}: is the same file as {}, which is needed too; choose another name", path.display(), other.display())]
    Overlap {
        /// The file to be written.
        path: PathBuf,
        /// Path by which it is needed as well.
        other: PathBuf,
    },
    /// A file cannot be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
}

/// Which option is out of its range.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OptionsError {
    /// [`BakeOptions::age`](super::BakeOptions::age) is NaN, negative or too great.
    #[error("the age is {found}, not a number from 0 to {MAX_AGE}")]
    Age {
        /// The age asked for.
        found: f64,
    },
    /// [`BakeOptions::steps`](super::BakeOptions::steps) is 0 or too great.
    #[error("the number of steps per unit age is {found}, not a number from 1 to {MAX_STEPS_PER_AGE}")]
    Steps {
        /// The number asked for.
        found: u32,
    },
    /// [`BakeOptions::metres_per_unit`](super::BakeOptions::metres_per_unit) is NaN or out of its range.
    #[error("a unit is {found} metres long, not {} to {}", UNITS.start(), UNITS.end())]
    Unit {
        /// The length asked for, in metres.
        found: f32,
    },
    /// Textures are smaller or larger than [`TEXTURE_SIZES`].
    #[error(
        "the size of textures is {found} texels, not a number from {} to {}",
        TEXTURE_SIZES.start(),
        TEXTURE_SIZES.end()
    )]
    TextureSize {
        /// Texels along a side that were asked for.
        found: u32,
    },
    /// [`BakeOptions::resolution`](super::BakeOptions::resolution) has a number out of its range.
    #[error(transparent)]
    Resolution(BuildError),
    /// A field of [`BakeOptions::detail`](super::BakeOptions::detail) is out of its range.
    #[error("{field} is {found}, not {range}")]
    Detail {
        /// Path of the field.
        field: &'static str,
        /// Its value.
        found: f64,
        /// Its range in words.
        range: &'static str,
    },
    /// A mask is out of its range.
    #[error(transparent)]
    Mask(#[from] MaskError),
    /// A setting of the coating is out of its range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
}

/// How a film is broken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BrokenFilm {
    /// The film that was built, or came with the mesh, is no oriented manifold.
    #[error("its faces are no oriented manifold")]
    NotManifold,
    /// The film was not built.
    #[error("it was not built")]
    NotBuilt,
    /// An invariant does not hold after ageing.
    #[error(transparent)]
    Invariant(#[from] InvariantError),
}
