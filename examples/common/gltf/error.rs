//! What can be wrong with a glTF file.

/// Why a file is no usable glTF.
#[derive(Debug, thiserror::Error)]
pub enum GltfError {
    /// Neither the magic number of .glb nor JSON.
    #[error("is no glTF: it begins neither as .glb nor as JSON; check that it is a model")]
    NotGltf,
    /// Not version 2.
    #[error("is glTF {0}; only 2.x can be read: export it again as glTF 2.0")]
    Version(String),
    /// The file ends too early.
    #[error("is cut off: {what} needs {needed} bytes, there are {found}; copy or export it again")]
    Truncated {
        /// What breaks off.
        what: String,
        /// Bytes needed.
        needed: u64,
        /// Bytes there.
        found: u64,
    },
    /// Chunks of a .glb in the wrong order.
    #[error("is damaged: its first chunk is not JSON; export it again")]
    NoJson,
    /// The JSON cannot be read.
    #[error("has broken JSON: {0}; export it again")]
    Json(serde_json::Error),
    /// An extension is needed that is not supported.
    #[error("needs the extension {0}, which is not supported; export it without (no mesh compression)")]
    Extension(String),
    /// A reference to something that does not exist.
    #[error("{from} refers to {kind} {index}, but there are only {count}; export it again")]
    Dangling {
        /// Who refers.
        from: String,
        /// To what kind of thing.
        kind: &'static str,
        /// Which one.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A buffer or image outside the file cannot be had.
    #[error("{what}: {uri:?} cannot be read: {cause}; keep it beside the file or export as .glb")]
    External {
        /// Which buffer or image.
        what: String,
        /// Where it should be.
        uri: String,
        /// Why not.
        cause: String,
    },
    /// An accessor is not what is needed in its place.
    #[error("accessor {accessor} cannot be {what}: {cause}; export it again")]
    Accessor {
        /// Which accessor.
        accessor: usize,
        /// What it is used as.
        what: &'static str,
        /// What is wrong.
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
        /// The index found.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// A position, or the transform of the node, is not finite.
    #[error("node {node}: vertex {vertex} is not at a finite place (NaN or infinite); repair the mesh")]
    NonFinite {
        /// Name or index of the node.
        node: String,
        /// Index of the vertex.
        vertex: usize,
    },
    /// The nodes are no tree.
    #[error("node {0} is its own ancestor or has two parents; export it again")]
    NotATree(usize),
    /// More than can be meant.
    #[error("{what} has {found} elements, more than {limit}; simplify the model")]
    TooMany {
        /// What is too large.
        what: String,
        /// How many.
        found: u64,
        /// How many at most.
        limit: u64,
    },
}
