//! Finds which part of the rain and sunlight reaches a surface, by casting rays against the direction in which they
//! fall.
//!
//! Rays are cast from the film at rest, a little off the metal, and meet the film itself and whatever stands around it.
//! From each vertex [`RAYS`] rays fill a narrow cone, so that the borders of sheltered places are soft, as drifting
//! drops and the width of the sun make them. The directions are fixed, so the same scene gives the same bits on any
//! machine and any number of threads.

mod ray;
mod surface;
mod tree;

#[cfg(test)]
mod tests;

pub use ray::Ray;
pub use surface::{Blocker, ExposedSurface, RAYS, SPREAD, exposure_of};
pub use tree::TriangleTree;
