//! What a film is built to, and what comes of it.

use bevy_math::Vec3;

use super::isotropic;
use crate::surface::{BuildError, BuildWarning, SurfaceSite};

/// How fine the film is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Debug, Clone, PartialEq),
    type_path = "bevy_coating::remesh"
)]
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

impl FilmResolution {
    /// Checks the range. `None`: keep the mesh.
    pub(super) fn target(self) -> Result<Option<isotropic::Target>, BuildError> {
        let refuse = |found: String, range| Err(BuildError::Resolution { found, range });
        match self {
            Self::Keep => Ok(None),
            Self::Triangles(n) if n < 4 => refuse(format!("{n} triangles"), "at least 4 triangles"),
            Self::Triangles(n) => Ok(Some(isotropic::Target::Count(n))),
            Self::EdgeLength(l) if l.is_finite() && l > 0.0 => Ok(Some(isotropic::Target::Length(l))),
            Self::EdgeLength(l) => refuse(format!("edge length {l}"), "a finite edge length above 0"),
        }
    }
}
