//! Remeshing: builds a film at rest over a surface, of near-equal, irregular triangles that keep the prop's creases,
//! borders and seams (VC 3.3).
//!
//! ```text
//! Surface --clean--> CleanSurface --remesh (or keep)--> BuiltFilm
//! ```
//!
//! A [`Surface`] is plain arrays, so the same code serves the plugin, baking and tests.

mod attributes;
mod chains;
mod collapse;
mod features;
mod film;
mod fine;
mod flip;
mod frame;
mod isotropic;
mod loss;
mod noise;
mod order;
mod polish;
mod project;
mod reference;
mod relax;
mod resolution;
pub mod sample;
mod seams;
mod share;
mod sites;
mod sizing;
mod split;
mod target;
#[cfg(test)]
mod tests;
mod topology;
mod work_mesh;

pub use film::{BuiltFilm, MAX_FILM_TRIANGLES};
pub(crate) use fine::fine_sites_in_pieces;
pub use fine::{FineSites, fine_sites};
pub use resolution::{DEFAULT_GRAIN_SHARE, DEFAULT_MAX_TRIANGLES, FilmResolution, GRAIN_SHARES};
pub use share::{LEAST_TRIANGLES, film_targets, share_triangles};
pub use target::FilmTarget;

use crate::{
    rest::{NoRest, Rest, at_once},
    surface::{BuildError, Surface, clean_in_pieces},
};
use frame::Frame;

/// Builds the film of a surface: cleans the surface, remeshes it to the target (or keeps its triangles), and finds
/// the point of the surface at which each corner of the film lies.
///
/// The seed draws the irregularity of the triangles. The same surface, target and seed give the same film, to the
/// bit.
///
/// # Errors
/// The errors of [`clean`](crate::surface::clean), [`BuildError::Size`] for a surface smaller than 0.1 mm or larger
/// than 1,000 km, [`BuildError::FarFromOrigin`] for one whose film would be folded by rounding,
/// [`BuildError::Resolution`] for a target out of range, and [`BuildError::TooLarge`] if the film would have more than
/// [`MAX_FILM_TRIANGLES`].
///
/// ```
/// use bevy_coating::{film::FilmMesh, remesh::{FilmTarget, build_film}, surface::Surface};
/// use bevy_math::Vec3;
///
/// // A unit square of two triangles becomes a film of about a hundred.
/// let square = Surface {
///     positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
///     triangles: vec![[0, 1, 2], [0, 2, 3]],
///     ..Surface::default()
/// };
/// let film = build_film(&square, FilmTarget::Triangles(100), 7)?;
/// assert!((80..120).contains(&film.triangles.len()));
/// assert_eq!(film.sites.len(), 3 * film.triangles.len());
///
/// let mesh = FilmMesh::new(film.positions, &film.triangles).unwrap();
/// assert!((mesh.geometry.rest_area - 1.0).abs() < 1e-4);
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
pub fn build_film(surface: &Surface, target: FilmTarget, seed: u64) -> Result<BuiltFilm, BuildError> {
    at_once(build_film_in_pieces(surface, target, seed, &mut NoRest))
}

/// Does what [`build_film`] does, with rests between its pieces.
///
/// # Errors
/// See [`build_film`].
pub(crate) async fn build_film_in_pieces(
    surface: &Surface,
    target: FilmTarget,
    seed: u64,
    rest: &mut impl Rest,
) -> Result<BuiltFilm, BuildError> {
    target.validate()?;
    let frame = Frame::of(surface)?;
    let moved = frame.enter(surface);
    let surface = moved.as_ref().unwrap_or(surface);
    let clean = clean_in_pieces(surface, rest).await?;
    frame.leave(isotropic::remesh(surface, &clean, target, seed, rest).await?)
}
