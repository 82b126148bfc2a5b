//! Faults of OBJ files.

/// Why a file is no usable OBJ.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ObjError {
    /// The file is no text.
    #[error("is no text, so no .obj; check that it is a model")]
    NotText,
    /// A statement cannot be read.
    #[error("line {line}: {cause}; export it again")]
    Line {
        /// Number of the line, from 1.
        line: usize,
        /// Fault of the statement.
        cause: String,
    },
}
