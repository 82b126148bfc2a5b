//! Stains on the film and on the metal under it: rust run-off, black stains and moisture (VC 6).
//!
//! | stage | function | source |
//! |---|---|---|
//! | rust | [`run_off`] | VC 6.1, figs. 9 and 10 |
//! | dust | [`settle_dust`] | VC 6.2, fig. 11 |
//! | moisture | [`wet`] | beyond the paper |
//! | exposure | [`exposure`] | beyond the paper |

mod environment;
pub mod exposure;
mod fields;
mod flow;

pub use environment::Environment;
pub use fields::{Exposure, RustBudget, RustSource, StainFields, StainLayer};
