//! Errors of building a film.

use bevy_math::Vec3;

/// Reason why no film can be built of a surface. In a game, the prop then keeps its own mesh.
///
/// ```
/// use bevy_coating::surface::{BuildError, Surface, clean};
///
/// let error = clean(&Surface::default()).unwrap_err();
/// assert_eq!(error, BuildError::NoTriangles);
/// assert_eq!(error.to_string(), "the mesh has no triangles");
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// The surface has no triangles.
    #[error("the mesh has no triangles")]
    NoTriangles,
    /// A list of attributes has the wrong length: not three entries for each triangle, or not one slot for each
    /// triangle.
    #[error("the mesh has {found} {attribute}, but {expected} are needed")]
    AttributeLength {
        /// Name of the attribute, in plural.
        attribute: &'static str,
        /// Number of entries that there are.
        found: usize,
        /// Number of entries that there must be.
        expected: usize,
    },
    /// A position that a triangle uses is NaN or infinite.
    #[error("position {vertex} is not finite: ({x}, {y}, {z})", x = position.x, y = position.y, z = position.z)]
    NonFinitePosition {
        /// Index of the vertex.
        vertex: u32,
        /// Position of the vertex.
        position: Vec3,
    },
    /// A triangle refers to a vertex that does not exist.
    #[error("triangle {triangle} refers to vertex {vertex}, but there are only {vertices}")]
    IndexOutOfRange {
        /// Index of the triangle.
        triangle: u32,
        /// Vertex index that the triangle holds.
        vertex: u32,
        /// Number of vertices that there are.
        vertices: usize,
    },
    /// No triangle has any area: all are points, lines or slivers.
    #[error("all {triangles} triangles are degenerate (no area)")]
    AllDegenerate {
        /// Number of triangles of the surface.
        triangles: usize,
    },
    /// The resolution asked for is out of range.
    #[error("film resolution {found} is out of range: {range}")]
    Resolution {
        /// Resolution that was asked for, in words.
        found: String,
        /// Resolutions that are allowed, in words.
        range: &'static str,
    },
    /// The surface or the film would have more triangles than a film can hold.
    #[error("the film would have {found} triangles, more than the {limit} a film can hold; ask for fewer")]
    TooLarge {
        /// Number of triangles that the film would have.
        found: usize,
        /// Highest number of triangles that is allowed.
        limit: usize,
    },
}
