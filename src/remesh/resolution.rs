//! How fine a film is asked to be.

use crate::surface::BuildError;

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

impl FilmResolution {
    /// Checks the range. `None`: keep the mesh.
    pub(super) fn target(self) -> Result<Option<Target>, BuildError> {
        let refuse = |found: String, range| Err(BuildError::Resolution { found, range });
        match self {
            Self::Keep => Ok(None),
            Self::Triangles(n) if n < 4 => refuse(format!("{n} triangles"), "at least 4 triangles"),
            Self::Triangles(n) => Ok(Some(Target::Count(n))),
            Self::EdgeLength(l) if l.is_finite() && l > 0.0 => Ok(Some(Target::Length(l))),
            Self::EdgeLength(l) => refuse(format!("edge length {l}"), "a finite edge length above 0"),
        }
    }
}

/// What to remesh to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Target {
    /// This many triangles.
    Count(u32),
    /// This edge length.
    Length(f32),
}
