//! Stains on the film and on the metal under it: rust run-off, black stains and moisture (VC 6).
//!
//! | stage | function | source |
//! |---|---|---|
//! | rust | [`run_off`], after [`update_stains`] | VC 6.1, figs. 9 and 10 |
//! | dust | [`settle_dust`] | VC 6.2, fig. 11 |
//! | moisture | [`moisten`] | beyond the paper |
//! | what rain and sun reach, before they are needed | [`exposure`] | beyond the paper |
//!
//! All directions and heights of run-off are those at rest. Stains change slowly, so they are advanced in ticks,
//! [`TICKS_PER_AGE`] to a unit of age, however many steps that takes; only fracture is followed in every step. What a
//! tick does is stable at any length: run-off is solved implicitly, vertex by vertex downhill, the rest by exponentials.

mod corrosion;
mod duplicates;
mod dust;
mod environment;
pub mod exposure;
mod fields;
mod flow;
mod moisture;
mod outflow;
mod rust;
mod shape;
mod sources;
#[cfg(test)]
mod tests;
mod update;
mod validate;

pub use dust::{DustFactors, dust_rate, settle_dust};
pub use environment::Environment;
pub use fields::{Exposure, RustBudget, RustSource, StainFields, StainLayer};
pub use moisture::moisten;
pub use rust::run_off;
pub use update::update_stains;

/// How often per unit age stains are advanced, and display follows them. Films with longer steps advance them in each.
pub const TICKS_PER_AGE: u64 = 100;

/// Below this part of gravity along the surface nothing flows and nothing is a source: a horizontal plate must not
/// bleed through rounding.
const LEAST_PULL: f32 = 1e-3;
