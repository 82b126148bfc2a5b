//! PBD-2: position-based bending without inertia (VC 4 and appendix).
//!
//! Positions are projected onto each constraint in turn (Gauss-Seidel); attached vertices have inverse mass 0,
//! separated ones 1. There are two solvers: a plain one, the reference, and a packed one that solves 32 constraints at
//! once and visits only what moves.
//!
//! | part | module | source |
//! |---|---|---|
//! | constraints and where they come from | [`constraints`] | VC 5, fig. 7 |
//! | length constraint | [`length`] | VC 4.2 |
//! | bend constraint | [`bend`] | VC 4.3, appendix, with the misprint of the projection put right |
//! | the solve of a step | [`solver`] | VC 4.1, 5 |
//! | one constraint after the other | [`plain`] | VC 4.1 |
//! | packs, instruction sets, momentum | `packed` | beyond the paper |
//! | what hardly moves is not looked at | `sleep` | beyond the paper |
//! | loose pieces keep their place | [`rigid`] | beyond the paper |

pub mod bend;
pub mod constraints;
pub mod length;
mod packed;
pub mod plain;
mod regions;
pub mod rigid;
mod sleep;
pub mod solver;
mod update;

#[cfg(test)]
mod tests;

pub use bend::BendConstraint;
pub use constraints::FilmConstraints;
pub use length::LengthConstraint;
pub use packed::SimdLevel;
pub use solver::{BendScratch, SolvePace, SolverQuality, bend_film, sweeps_and_momentum, sweeps_of_step};
pub use update::update_constraints;
