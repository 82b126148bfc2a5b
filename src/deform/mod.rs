//! PBD-2: position-based bending without inertia (VC 4 and appendix).
//!
//! Positions are projected onto each constraint in turn (Gauss-Seidel); attached vertices have inverse mass 0,
//! separated ones 1. There are two solvers: a plain one, the reference, and a packed one that solves 32 constraints at
//! once and visits only what moves.
//!
//! | part | where | source |
//! |---|---|---|
//! | length constraint | `length` | VC 4.2 |
//! | bend constraint | `bend` | VC 4.3, appendix, with the misprint of the projection put right |
//! | contact with the metal | `half_space` | VC 5 |
//! | how much is solved in a step | `pace` | VC 4.1, momentum beyond the paper |
//! | which half-edge carries which constraint | `ledger` | VC 5, fig. 7 |
//! | packs, instruction sets | `packed` | beyond the paper |
//! | one constraint after the other | `plain` | VC 4.1 |
//! | curls at free edges | `curl`, [`follow_free_edges`] | beyond the paper |
//! | what hardly moves is left out | `sleep` | beyond the paper |
//! | loose pieces keep their place | `rigid` | beyond the paper |
//! | the constraints of a film | [`FilmConstraints`] | VC 5 |
//! | constraints follow fracture | [`update_constraints`] | VC 5, fig. 7 |
//! | the solve of a step | [`bend_film`] | VC 4.1, 5 |

mod bend;
mod constraints;
mod curl;
mod free_edges;
mod half_space;
mod ledger;
mod length;
mod mend;
mod pace;
mod packed;
mod plain;
mod renew;
mod repaint;
mod rigid;
mod sleep;
mod solver;
mod update;

#[cfg(test)]
pub(crate) mod tests;

pub use bend::BendConstraint;
pub use constraints::FilmConstraints;
pub(crate) use constraints::saved::code_quality;
pub use free_edges::follow_free_edges;
pub use length::LengthConstraint;
pub use pace::{SolvePace, SolverQuality, sweeps_and_momentum, sweeps_of_step};
pub use packed::level::SimdLevel;
pub use solver::{BendScratch, bend_film};
pub use update::update_constraints;
