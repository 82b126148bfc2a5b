//! Names and ranges of custom properties.

/// Oldest age with which a prop may appear.
pub const MOST_START_AGE: f64 = 10.0;

/// Names of the properties, but for those of single settings.
pub(super) const KEYS: [&str; 3] = ["coating", "coating_seed", "coating_start_age"];
