//! Holds what can be wrong with a glTF file.

use crate::bake::printable::Printable;

/// Why a file is no usable glTF.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum GltfError {
    /// The file begins neither with the magic number of .glb nor as JSON.
    #[error("is no glTF: it begins neither as .glb nor as JSON; check that it is a model")]
    NotGltf,
    /// The file is not of version 2.
    #[error("is glTF {0}; only 2.x can be read: export it again as glTF 2.0")]
    Version(String),
    /// The file ends too early.
    #[error("is cut off: {what} needs {needed} bytes, there are {found}; copy or export it again")]
    Truncated {
        /// Part that breaks off.
        what: String,
        /// Number of bytes needed.
        needed: u64,
        /// Number of bytes there.
        found: u64,
    },
    /// The chunks of the .glb are in the wrong order.
    #[error("is damaged: its first chunk is not JSON; export it again")]
    NoJson,
    /// The JSON cannot be read; with the cause.
    #[error("has broken JSON: {0}; export it again")]
    Json(serde_json::Error),
    /// The file requires an extension that is not supported; with its name.
    #[error("needs the extension {}, which is unknown and may change its meshes; export it without", Printable(.0))]
    Extension(String),
    /// The file requires an extension that compresses meshes; with its name.
    #[error("needs the extension {0}: its meshes are compressed; export it again without mesh compression")]
    Compressed(String),
    /// Something is referred to that does not exist.
    #[error("{} refers to {kind} {index}, but there are only {count}; export it again", Printable(from))]
    Dangling {
        /// Part of the file that refers to it.
        from: String,
        /// Kind of thing that is referred to.
        kind: &'static str,
        /// Index of the thing.
        index: usize,
        /// Number of things of that kind.
        count: usize,
    },
    /// A buffer or image outside the file cannot be read.
    #[error("{what}: {uri:?} cannot be read: {cause}; keep it beside the file or export as .glb")]
    External {
        /// Name of the buffer or image.
        what: String,
        /// Place where it should be, cut off after 60 characters.
        uri: String,
        /// Why it cannot be read.
        cause: String,
    },
    /// An accessor is not what is needed in its place.
    #[error("accessor {accessor} cannot be {what}: {cause}; export it again")]
    Accessor {
        /// Index of the accessor.
        accessor: usize,
        /// Use of the accessor.
        what: &'static str,
        /// Fault of the accessor.
        cause: String,
    },
    /// A primitive has no positions.
    #[error("mesh {mesh}: primitive {primitive} has no POSITION attribute; export it again")]
    NoPositions {
        /// Index of the mesh.
        mesh: usize,
        /// Index in the mesh.
        primitive: usize,
    },
    /// An index of a primitive is out of range.
    #[error("mesh {mesh}: primitive {primitive} refers to vertex {index}, but has only {vertices}; export it again")]
    IndexOutOfRange {
        /// Index of the mesh.
        mesh: usize,
        /// Index in the mesh.
        primitive: usize,
        /// Index that was found.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A position, or the transform of the node, is not finite.
    #[error("node {}: vertex {vertex} is not at a finite place (NaN or infinite); repair the mesh", Printable(node))]
    NonFinite {
        /// Name or index of the node.
        node: String,
        /// Index of the vertex.
        vertex: usize,
    },
    /// The nodes form no tree; with the index of the node where that shows.
    #[error("node {0} is its own ancestor or has two parents; export it again")]
    NotATree(usize),
    /// There is more of something than can be meant.
    #[error("{what} has {found} elements, more than {limit}; simplify the model")]
    TooMany {
        /// Thing that is too large.
        what: String,
        /// Number of its elements.
        found: u64,
        /// Largest number of elements.
        limit: u64,
    },
}
