//! Computes how much rain and sun reaches each prop, by casting rays against the meshes around it.
//!
//! ```text
//! RainShelter, Coating --survey--> ShelterScene (places, one tree of triangles a mesh)
//!                                        |
//! film, rain, sun -----------------------+--cast--> task --advance--> StainFields::exposure
//! ```
//!
//! Nothing is surveyed or cast while there is neither rain nor sun. Then the work of a frame is in proportion to what
//! moved and to what is near it: shelters and films are kept in trees of balls ([`ball_tree`]), in which a shelter that
//! moves finds the films below it, and a film the shelters above it.

mod ball;
mod ball_tree;
mod cast;
mod film;
mod films;
mod key;
mod pieces;
mod scene;
#[cfg(test)]
mod tests;

pub(crate) use cast::cast;
pub(crate) use film::FilmShelter;
pub(crate) use films::ShelteredFilms;
pub(crate) use key::CastOrder;
pub(crate) use scene::{ShelterScene, survey};
