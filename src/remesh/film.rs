//! The result of building a film.

use bevy_math::Vec3;

use crate::surface::{BuildWarning, SurfaceSite};

/// Highest number of triangles that a film may have: about 4 million. A good film of one prop needs about 10,000.
pub const MAX_FILM_TRIANGLES: usize = 1 << 22;

/// Film at rest as plain arrays, with the point of the prop's surface at which each of its corners lies. Made by
/// [`build_film`](crate::remesh::build_film) and by the [test pieces](crate::remesh::sample).
///
/// ```
/// use bevy_coating::remesh::sample::plate;
///
/// let piece = plate(50, 1)?;
/// let film = &piece.film;
/// // The first corner of face 0 as a point of the surface.
/// let site = film.sites[0];
/// let corners = piece.surface.triangles[site.triangle as usize].map(|v| piece.surface.positions[v as usize]);
/// let point = corners[0] * site.weights.x + corners[1] * site.weights.y + corners[2] * site.weights.z;
/// assert_eq!(point, film.positions[film.triangles[0][0] as usize]);
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct BuiltFilm {
    /// Rest position of each vertex, in the space of the surface.
    pub positions: Vec<Vec3>,
    /// Vertex indices of each face, counter-clockwise seen from outside. The faces form an oriented manifold, closed or
    /// with borders, of one or several shells.
    pub triangles: Vec<[u32; 3]>,
    /// Slot of each face: see [`Surface::slots`](crate::surface::Surface::slots).
    pub slots: Vec<u32>,
    /// Whether each face has the opposite winding of the surface's triangles on which it lies, because cleaning turned
    /// them.
    pub flipped: Vec<bool>,
    /// Points of the surface at which the corners of the faces lie, three for each face. The three points of a face lie
    /// on the same side of every seam, so attributes can be interpolated over the face.
    pub sites: Vec<SurfaceSite>,
    /// Warnings of cleaning and remeshing.
    pub warnings: Vec<BuildWarning>,
}
