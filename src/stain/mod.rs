//! Stains the film and the metal under it: rust run-off, black stains and moisture (VC 6).
//!
//! | stage | function | source |
//! |---|---|---|
//! | rust | [`run_off`], after [`update_stains`] | VC 6.1, figs. 9 and 10 |
//! | dust | [`settle_dust`] | VC 6.2, fig. 11 |
//! | moisture | [`moisten`] | beyond the paper |
//! | exposure to rain and sun, an input of the others | [`exposure`] | beyond the paper |
//!
//! All directions and heights of run-off are those at rest. Stains change slowly, so they advance in ticks, of which
//! [`TICKS_PER_AGE`] make a unit of age; only [`update_stains`] runs in every step. A tick of any length is stable:
//! run-off is solved implicitly, from the highest vertex to the lowest, and everything else by exponentials.

mod begin;
mod catchments;
mod corrosion;
mod digest;
mod duplicates;
mod dust;
mod environment;
pub mod exposure;
mod fields;
mod flow;
mod layer;
mod mend;
mod moisture;
mod outflow;
mod places;
mod renew;
mod repaint;
mod rust;
mod saved;
mod shape;
pub(crate) mod shown;
mod slope;
mod sources;
mod ticks;
mod touch;
mod update;
mod validate;

pub use dust::{
    factors::{DustFactors, dust_rate},
    settle::settle_dust,
};
pub use environment::Environment;
pub use fields::{Exposure, RustBudget, RustSource, StainFields};
pub use layer::StainLayer;
pub use moisture::moisten;
pub use rust::run_off;
pub use ticks::TICKS_PER_AGE;
pub(crate) use touch::Stain;
pub use update::update_stains;
