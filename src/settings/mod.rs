//! What a user can set, grouped by stage. Every rate is per unit age.

mod stages;

pub use stages::*;
