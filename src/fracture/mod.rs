//! Static simulation: fracture decided by balance of forces (VC 5).
//!
//! | stage | function | source |
//! |---|---|---|
//! | forces age | [`age_forces`] | VC 5.1, 5.2 |
//! | separation | [`separate`] | VC 5.1, eq. 4 |
//! | tearing | [`tear`] | VC 5.2 |
//! | stripping | [`strip`] | VC 5.3 |
//!
//! Every stage is a function on borrowed parts and writes what it did into [`FilmChanges`]. Each does work in proportion
//! to what happens, not to the film's size: what ages everywhere at one rate is kept once ([`FilmForces`]), what will
//! happen is predicted, and pieces are followed edit by edit.

mod adhesion;
mod aging;
mod balance;
mod binding;
mod event_queue;
mod forces;
mod predictions;
mod separation;
mod stripping;
mod tearing;

#[cfg(test)]
mod tests;

pub use adhesion::adhesion_field;
pub use aging::age_forces;
pub use forces::FilmForces;
pub use separation::{bending_force, separate, separation_age, sigmoid};
pub use stripping::strip;
pub use tearing::{FractureScratch, tear};

#[cfg(doc)]
use crate::film::FilmChanges;
