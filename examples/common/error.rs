//! What can go wrong between a prop's file and its aged model. Every error is one line: where, what, and where
//! it helps, the way out.

use std::{io, path::PathBuf};

use bevy_coating::{film::InvariantError, surface::BuildError};

use super::{gltf::GltfError, obj::ObjError};

/// Why a prop could not be aged, or the result not be written.
#[derive(Debug, thiserror::Error)]
pub enum BakeError {
    /// A file cannot be read.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
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
        /// What is wrong with it.
        source: GltfError,
    },
    /// The file is no usable OBJ.
    #[error("{}: {source}", path.display())]
    Obj {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: ObjError,
    },
    /// There is nothing to coat.
    #[error("{origin}: holds no triangle mesh; export the model with its meshes as triangles")]
    Empty {
        /// The input.
        origin: String,
    },
    /// No film can be made of a mesh.
    #[error("{origin}: mesh {mesh:?}: {source}")]
    Build {
        /// The input.
        origin: String,
        /// Name of the mesh.
        mesh: String,
        /// Why not.
        source: BuildError,
    },
    /// The film is more than a film can be, or the aged film broke a rule of the method: a fault of ours.
    #[error("{origin}: mesh {mesh:?}: the film is broken: {cause}; please report this with the file and the options")]
    Broken {
        /// The input.
        origin: String,
        /// Name of the mesh.
        mesh: String,
        /// What is broken.
        cause: String,
    },
    /// The aged model does not fit into a binary glTF.
    #[error("{origin}: the aged model is larger than the 4 GiB a .glb can hold; ask for fewer triangles")]
    TooLarge {
        /// The input.
        origin: String,
    },
    /// A file cannot be written.
    #[error("{}: cannot be written: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}
