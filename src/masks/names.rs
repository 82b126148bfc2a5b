//! Names of what masks do.

/// Names of the effects, in the order of their fields.
pub(super) const EFFECTS: [&str; 6] = ["adhesion", "binding", "contraction", "dust", "rust", "moisture"];
