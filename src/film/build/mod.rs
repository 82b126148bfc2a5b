//! From any triangle surface to a film: clean, weld, make manifold, remesh, half-edge.
//!
//! ```text
//! Surface --clean--> CleanSurface --remesh (or keep)--> BuiltFilm
//! ```
//!
//! Nothing here knows Bevy: a [`Surface`] is plain arrays, so the same code serves the plugin, the bake tool
//! and tests.

pub mod clean;
mod remesh;
pub mod sample;

pub use clean::{CleanSurface, clean};

use bevy_math::{Vec2, Vec3, Vec4};

/// The prop's own surface: the triangles of one connected prop (all primitives of one glTF node), in the
/// prop's space with its world scale applied. Corner attributes hold three entries a triangle, in the order
/// of the triangle's corners; an attribute that the prop does not have is empty.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Vertex positions; unused and repeated ones are fine.
    pub positions: Vec<Vec3>,
    /// Vertex indices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Slot (primitive, material) of each triangle; empty: all are slot 0.
    pub slots: Vec<u32>,
    /// Shading normals, three a triangle; empty: none.
    pub normals: Vec<Vec3>,
    /// First texture coordinates, three a triangle; empty: none.
    pub uvs: Vec<Vec2>,
    /// Second texture coordinates (lightmaps), three a triangle; empty: none.
    pub uvs_1: Vec<Vec2>,
    /// Tangents with handedness in `w`, three a triangle; empty: none.
    pub tangents: Vec<Vec4>,
    /// Linear vertex colours, three a triangle; empty: none.
    pub colors: Vec<Vec4>,
}

/// A place on a [`Surface`]: a triangle and barycentric weights of its corners 0, 1 and 2 (sum 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceSite {
    /// Index into [`Surface::triangles`].
    pub triangle: u32,
    /// Weights of the triangle's corners, in the surface's corner order.
    pub weights: Vec3,
}

/// How fine the film is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FilmResolution {
    /// Remesh to about this many triangles. At least 4.
    Triangles(u32),
    /// Remesh to this edge length, in the surface's unit. Above 0.
    EdgeLength(f32),
    /// Use the mesh as it is, welded and cleaned.
    Keep,
}

/// A film at rest, ready to be aged, and where each of its corners lies on the prop's surface.
#[derive(Clone, Debug, Default)]
pub struct BuiltFilm {
    /// Vertex positions at rest.
    pub positions: Vec<Vec3>,
    /// Vertex indices of each face: an oriented manifold, closed or with borders, of one or several shells.
    pub triangles: Vec<[u32; 3]>,
    /// Slot of each face.
    pub slots: Vec<u32>,
    /// Whether the face runs against the winding of the surface's triangles it lies on (winding was unified).
    pub flipped: Vec<bool>,
    /// Where each corner lies on the surface, three a face. All three corners of a face lie in one chart.
    pub sites: Vec<SurfaceSite>,
    /// What the user should know.
    pub warnings: Vec<BuildWarning>,
}

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

/// Something that was put right or could not be met while building a film.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum BuildWarning {
    /// Triangles without area were dropped.
    DegenerateDropped(u32),
    /// Triangles that repeat another one were dropped.
    DuplicatesDropped(u32),
    /// Edges with more than two faces were split into manifold sheets.
    NonManifoldEdgesSplit(u32),
    /// Vertices where sheets met in a point were split.
    NonManifoldVerticesSplit(u32),
    /// Edges of one-sided shells (Möbius bands) that were cut where the two sides meet.
    OneSidedEdgesCut(u32),
    /// Triangles whose winding was turned to agree with their shell.
    WindingTurned(u32),
    /// Feature lines are denser than the target edge: the film is finer there.
    FeaturesDenserThanTarget {
        /// Triangles asked for.
        target: u32,
        /// Triangles there are.
        triangles: u32,
    },
}

/// Most triangles a film may have: 4 million, 400 times what a film of good looks needs.
pub const MAX_FILM_TRIANGLES: usize = 1 << 22;

/// Builds the film of a surface: cleans it, remeshes it to the resolution (or keeps it), and finds where each
/// corner of the film lies on the surface. The seed draws the remeshing's irregularity; the same input and seed
/// give the same film, to the bit.
///
/// # Errors
/// Whatever [`clean()`] refuses; [`BuildError::Resolution`] for a resolution that makes no sense;
/// [`BuildError::TooLarge`] for more than [`MAX_FILM_TRIANGLES`].
pub fn build(surface: &Surface, resolution: FilmResolution, seed: u64) -> Result<BuiltFilm, BuildError> {
    let target = resolution.target()?;
    let clean = clean(surface)?;
    match target {
        Some(target) => remesh::remesh(surface, &clean, target, seed),
        None => remesh::keep(surface, &clean),
    }
}

impl FilmResolution {
    /// Checks the range. `None`: keep the mesh.
    fn target(self) -> Result<Option<remesh::Target>, BuildError> {
        let refuse = |found: String, range| Err(BuildError::Resolution { found, range });
        match self {
            Self::Keep => Ok(None),
            Self::Triangles(n) if n < 4 => refuse(format!("{n} triangles"), "at least 4 triangles"),
            Self::Triangles(n) => Ok(Some(remesh::Target::Count(n))),
            Self::EdgeLength(l) if l.is_finite() && l > 0.0 => Ok(Some(remesh::Target::Length(l))),
            Self::EdgeLength(l) => refuse(format!("edge length {l}"), "a finite edge length above 0"),
        }
    }
}
