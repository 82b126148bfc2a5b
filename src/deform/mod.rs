//! PBD-2: position-based bending without inertia (VC 4 and appendix).
//!
//! Positions are projected onto each constraint in turn (Gauss-Seidel); attached vertices have inverse mass 0,
//! separated ones 1. The solver of this module is plain and exact: the reference for faster ones.
//!
//! | part | module | source |
//! |---|---|---|
//! | constraints and where they come from | [`constraints`] | VC 5, fig. 7 |
//! | length constraint | [`length`] | VC 4.2 |
//! | bend constraint | [`bend`] | VC 4.3, appendix, with the misprint of the projection put right |
//! | half-space and sweeps | [`solver`] | VC 5 |
//! | loose pieces keep their place | [`rigid`] | beyond the paper |

pub mod bend;
pub mod constraints;
pub mod length;
mod link;
pub mod rigid;
pub mod solver;

#[cfg(test)]
mod tests;

pub use bend::BendConstraint;
pub use constraints::FilmConstraints;
pub use length::LengthConstraint;
pub use link::follow_fracture;
pub use solver::{BendScratch, bend_film, sweeps_of_step};
