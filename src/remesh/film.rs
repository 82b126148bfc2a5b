//! The film as it is built: arrays of triangles at rest.

use bevy_math::Vec3;

use crate::surface::{BuildWarning, SurfaceSite};

/// Most triangles a film may have: 4 million, 400 times what a film of good looks needs.
pub const MAX_FILM_TRIANGLES: usize = 1 << 22;

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
