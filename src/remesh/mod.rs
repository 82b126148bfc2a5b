//! From a surface to a film at rest: near-equal, irregular triangles that keep the prop's creases, borders and seams.
//!
//! ```text
//! Surface --clean--> CleanSurface --remesh (or keep)--> BuiltFilm
//! ```
//!
//! Nothing here knows Bevy: a [`Surface`] is plain arrays, so the same code serves the plugin, baking and tests.

mod attributes;
mod chains;
mod collapse;
mod features;
mod film;
mod flip;
mod isotropic;
mod noise;
mod polish;
mod project;
mod reference;
mod relax;
mod resolution;
pub mod sample;
mod sites;
mod split;
#[cfg(test)]
mod tests;
mod topology;
mod work_mesh;

pub use film::{BuiltFilm, MAX_FILM_TRIANGLES};
pub use resolution::FilmResolution;

use crate::surface::{BuildError, Surface, clean};

/// Builds the film of a surface: cleans it, remeshes it to the resolution (or keeps it), and finds where each
/// corner of the film lies on the surface. The seed draws the remeshing's irregularity; the same input and seed
/// give the same film, to the bit.
///
/// # Errors
/// Whatever [`clean`] refuses; [`BuildError::Resolution`] for a resolution that makes no sense;
/// [`BuildError::TooLarge`] for more than [`MAX_FILM_TRIANGLES`].
pub fn build_film(surface: &Surface, resolution: FilmResolution, seed: u64) -> Result<BuiltFilm, BuildError> {
    let target = resolution.target()?;
    let clean = clean(surface)?;
    match target {
        Some(target) => isotropic::remesh(surface, &clean, target, seed),
        None => sites::keep(surface, &clean),
    }
}
