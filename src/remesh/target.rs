//! The target of remeshing: the size of one film's triangles.

use crate::surface::BuildError;

/// Target of one film: what [`build_film`](super::build_film) remeshes a surface to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FilmTarget {
    /// About this number of triangles, at least 4. Creases and seams may need more; the film then has a warning.
    Triangles(u32),
    /// About this edge length, in the surface's unit, finite and above 0.
    EdgeLength(f32),
    /// The triangles of the surface, which are only cleaned.
    Keep,
}

impl FilmTarget {
    /// Checks the number against its range.
    pub(super) fn validate(self) -> Result<(), BuildError> {
        let refuse = |found: String, range| Err(BuildError::Resolution { found, range });
        match self {
            Self::Triangles(n) if n < 4 => refuse(format!("{n} triangles"), "at least 4 triangles"),
            Self::EdgeLength(l) if !(l.is_finite() && l > 0.0) => {
                refuse(format!("edge length {l}"), "a finite edge length above 0")
            }
            _ => Ok(()),
        }
    }
}

/// Returns the side of the equilateral triangle with this area.
pub(super) fn edge_of_area(area: f64) -> f32 {
    (area * 4.0 / 3.0_f64.sqrt()).sqrt() as f32
}

/// Returns the number of equilateral triangles with this side that cover the area.
pub(super) fn count_of_edge(area: f64, edge: f32) -> f64 {
    area * 4.0 / (3.0_f64.sqrt() * f64::from(edge) * f64::from(edge))
}
