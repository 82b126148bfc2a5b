//! Points of the prop's surface at which the points of each face's grid lie, so that a film is shown finer than it is
//! simulated.
//!
//! ```text
//! corners   where each corner of the film lies on the clean surface
//! lines     creases, borders and seams along which edges of the film run
//! edges     points along the edges: on those lines, or on the surface between two faces
//! faces     points within the faces, from those along their edges
//! ```
//!
//! Points are sought along the normal of the film, not at the nearest place of the surface: nothing is nearest to the
//! top of a rivet but what is over it.

mod corners;
mod edges;
mod faces;
mod ground;
mod lines;
mod seek;
mod shoot;

use bevy_math::Vec3;

use super::film::{BuiltFilm, MAX_FILM_TRIANGLES};
use super::frame::Frame;
use crate::{
    film::FaceGrid,
    rest::{NoRest, Rest, at_once},
    surface::{BuildError, Surface, SurfaceSite, clean_in_pieces},
};
use corners::Corners;
use edges::Edges;
use faces::Faces;
use seek::Seeker;

/// Points of the prop's surface at which the points of each face's grid lie at rest. Made by [`fine_sites`].
///
/// The lists hold one entry for each point of each face's grid: point `i` of face `f` is entry `f * n + i`, with `n`
/// the number of points of the grid.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FineSites {
    /// Position of each point, in the space of the surface. The two faces at an edge have the same positions along it,
    /// to the bit.
    pub positions: Vec<Vec3>,
    /// Point of the surface whose attributes each point has. All sites of a face lie on its own side of every seam.
    pub sites: Vec<SurfaceSite>,
}

/// Returns the points of the surface at which the points of each face's grid lie.
///
/// Corners are those of the film. Points on edges that run along a crease, border or seam lie on that line, and all
/// others on the surface over or under the flat face. Where the surface is further away than half an edge, or the
/// small triangles would be folded over, points stay in the flat face or between the curved edges of it.
///
/// `built` must be a film of `surface`, made by [`build_film`](super::build_film) or a
/// [test piece](super::sample). Faces of any other film stay flat, and so do those that refer to vertices or triangles
/// that do not exist. The result is the same on every run, to the bit.
///
/// # Errors
/// The errors of [`clean`](crate::surface::clean), [`BuildError::Size`] for a surface smaller than 0.1 mm or larger
/// than 1,000 km, and [`BuildError::TooLarge`] if there would be more than [`MAX_FILM_TRIANGLES`] small triangles.
///
/// ```
/// use bevy_coating::{film::FaceGrid, remesh::{fine_sites, sample::curved_plate}};
///
/// let piece = curved_plate(200, 1)?;
/// let grid = FaceGrid::new(2);
/// let fine = fine_sites(&piece.surface, &piece.film, &grid)?;
/// assert_eq!(fine.positions.len(), 200 * grid.points().len());
/// // Point 0 of the grid of face 3 is corner 0 of the face.
/// let point = 3 * grid.points().len();
/// assert_eq!(fine.positions[point], piece.film.positions[piece.film.triangles[3][0] as usize]);
/// assert_eq!(fine.sites[point], piece.film.sites[3 * 3]);
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
pub fn fine_sites(surface: &Surface, built: &BuiltFilm, grid: &FaceGrid) -> Result<FineSites, BuildError> {
    at_once(fine_sites_in_pieces(surface, built, grid, &mut NoRest))
}

/// Does what [`fine_sites`] does, with rests between its pieces.
///
/// # Errors
/// See [`fine_sites`].
pub(crate) async fn fine_sites_in_pieces(
    surface: &Surface,
    built: &BuiltFilm,
    grid: &FaceGrid,
    rest: &mut impl Rest,
) -> Result<FineSites, BuildError> {
    let frame = Frame::of(surface)?;
    let moved = frame.enter(surface);
    let surface = moved.as_ref().unwrap_or(surface);
    let clean = clean_in_pieces(surface, rest).await?;
    let found = built.triangles.len().saturating_mul(grid.triangles().len());
    if found > MAX_FILM_TRIANGLES {
        return Err(BuildError::TooLarge { found, limit: MAX_FILM_TRIANGLES });
    }
    let corners = Corners::new(&clean, built, &frame, rest).await;
    let seeker = Seeker::new(surface, &clean, &corners, rest).await;
    let edges = Edges::new(&seeker, &corners, grid, rest).await;
    let faces = Faces::new(&seeker, &corners, edges, grid, rest).await;
    Ok(FineSites {
        positions: faces
            .positions
            .into_iter()
            .zip(&faces.corner_of)
            .map(|(p, corner)| match corner {
                Some(h) => corners.exact(*h),
                None => frame.outside(p),
            })
            .collect(),
        sites: faces.sites,
    })
}
