//! Decides from the balance of forces where the film separates, tears and comes off (VC 5).
//!
//! This is the static half of the method; [`deform`](crate::deform) is the other. The stages of one step, in their
//! order:
//!
//! | stage | function | source |
//! |---|---|---|
//! | forces age | [`age_forces`] | VC 5.1, 5.2 |
//! | separation | [`separate`] | VC 5.1, eq. 4 |
//! | tearing | [`tear`] | VC 5.2 |
//! | stripping | [`strip`] | VC 5.3 |
//!
//! Every stage is a function that borrows the parts of a film and records in [`FilmChanges`] what it did. Its cost
//! grows with the number of events, not with the size of the film: a change that is the same everywhere is stored once
//! ([`FilmForces`]), separations and tears are predicted and queued by the step in which they can happen first, and
//! connected pieces are updated edit by edit.

mod adhesion;
mod aging;
mod balance;
mod binding;
mod by_hand;
mod digest;
mod drawn;
mod edit;
mod event_queue;
mod follow;
mod forces;
mod hold;
mod mend;
mod neck;
mod neck_search;
mod predictions;
mod relief;
mod renew;
mod repaint;
mod saved;
mod scratch;
mod separation;
mod sigmoid;
mod stripping;
mod tear_edge;
mod tearing;
mod validate;

#[cfg(test)]
mod tests;

pub use adhesion::adhesion_field;
pub use aging::age_forces;
pub(crate) use by_hand::{cut, cut_out, strike};
pub use by_hand::{strip_by_hand, tear_by_hand};
pub use forces::FilmForces;
pub use scratch::FractureScratch;
pub use separation::{age_until_separation, bending_force, separate, separation_age};
pub use sigmoid::sigmoid;
pub use stripping::strip;
pub use tearing::tear;

#[cfg(doc)]
use crate::film::FilmChanges;
