//! The resolution that is asked of a film.

use crate::surface::BuildError;

/// Resolution of a film: the size of its triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Debug, Clone, PartialEq),
    type_path = "bevy_coating::remesh"
)]
pub enum FilmResolution {
    /// Remesh to about this number of triangles, at least 4. Creases and seams may need more; the film then has a
    /// warning.
    Triangles(u32),
    /// Remesh to about this edge length, in the surface's unit, finite and above 0.
    EdgeLength(f32),
    /// Keep the triangles of the surface. They are only cleaned.
    Keep,
}

impl FilmResolution {
    /// Checks the range and returns the target of remeshing, or `None` to keep the triangles.
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

/// Target of remeshing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Target {
    /// Number of triangles.
    Count(u32),
    /// Edge length, in the surface's unit.
    Length(f32),
}

/// Returns the side of the equilateral triangle with this area.
pub(super) fn edge_of_area(area: f64) -> f32 {
    (area * 4.0 / 3.0_f64.sqrt()).sqrt() as f32
}

/// Returns the number of equilateral triangles with this side that cover the area.
pub(super) fn count_of_edge(area: f64, edge: f32) -> f64 {
    area * 4.0 / (3.0_f64.sqrt() * f64::from(edge) * f64::from(edge))
}
