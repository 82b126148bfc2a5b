//! Computes how much rain and sun reaches each prop, by casting rays against the meshes around it.
//!
//! ```text
//! RainShelter, Coating --survey--> ShelterScene (places, one tree of triangles a mesh)
//!                                        |
//! film, rain, sun -----------------------+--cast--> task --advance--> StainFields::exposure
//! ```
//!
//! Nothing is surveyed or cast while there is neither rain nor sun.

mod cast;
mod film;
mod key;
mod scene;

pub(crate) use cast::cast;
pub(crate) use film::FilmShelter;
pub(crate) use key::CastOrder;
pub(crate) use scene::{ShelterScene, survey};
