//! What stands around props and keeps rain and sun off them.
//!
//! ```text
//! RainShelter, Coating --survey--> ShelterScene (places, one tree of triangles a mesh)
//!                                        |
//! film, rain, sun -----------------------+--cast--> task --advance--> StainFields::exposure
//! ```
//!
//! All of it happens only while there is rain or sun.

mod cast;
mod film;
mod key;
mod scene;

pub(crate) use cast::cast;
pub(crate) use film::FilmShelter;
pub(crate) use key::CastOrder;
pub(crate) use scene::{ShelterScene, survey};
