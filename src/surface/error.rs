//! Reasons why no film can be made of a surface.

use bevy_math::Vec3;

/// Why no film can be made of a surface. The prop keeps its own mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum BuildError {
    /// There is nothing to coat.
    #[error("the mesh has no triangles")]
    NoTriangles,
    /// A corner attribute's length is not three a triangle.
    #[error("the mesh has {found} {attribute}, but {expected} are needed")]
    AttributeLength {
        /// Which attribute.
        attribute: &'static str,
        /// How many there are.
        found: usize,
        /// How many there must be.
        expected: usize,
    },
    /// A position is NaN or infinite.
    #[error("position {vertex} is not finite: ({x}, {y}, {z})", x = position.x, y = position.y, z = position.z)]
    NonFinitePosition {
        /// Index of the vertex.
        vertex: u32,
        /// The position.
        position: Vec3,
    },
    /// A triangle refers to a vertex that does not exist.
    #[error("triangle {triangle} refers to vertex {vertex}, but there are only {vertices}")]
    IndexOutOfRange {
        /// Index of the triangle.
        triangle: u32,
        /// The index it holds.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// All triangles are degenerate: points, lines or slivers without area.
    #[error("all {triangles} triangles are degenerate (no area)")]
    AllDegenerate {
        /// Number of triangles of the surface.
        triangles: usize,
    },
    /// The resolution asked for makes no sense.
    #[error("film resolution {found} is out of range: {range}")]
    Resolution {
        /// What was asked for.
        found: String,
        /// What is allowed.
        range: &'static str,
    },
    /// More elements than a film can hold.
    #[error("the film would have {found} triangles, more than the {limit} a film can hold; ask for fewer")]
    TooLarge {
        /// How many triangles.
        found: usize,
        /// How many at most.
        limit: usize,
    },
}
