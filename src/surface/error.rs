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
    /// The surface is too small or too large for lengths in metres in single precision.
    #[error("the mesh is {size} m across, outside of {least} to {most} m; scale it (is its unit right?)")]
    Size {
        /// Longest side of its bounding box.
        size: f64,
        /// Smallest size that is allowed.
        least: f64,
        /// Largest size that is allowed.
        most: f64,
    },
    /// The surface lies so far from its origin that rounding would fold the film's triangles.
    #[error(
        "the mesh lies {distance} m from its origin, where positions are rounded to {rounding} m, too coarse for \
         triangles of {edge} m; move it nearer to its origin or ask for fewer triangles"
    )]
    FarFromOrigin {
        /// Distance of its farthest coordinate.
        distance: f32,
        /// Distance between neighbouring numbers in single precision there.
        rounding: f32,
        /// Mean edge of the film's triangles.
        edge: f32,
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
