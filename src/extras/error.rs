//! Errors of custom properties.

use super::limits::{KEYS, MOST_START_AGE};
use crate::settings::SettingsError;

/// Reason why the custom properties of a prop were refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExtrasError {
    /// The text is no JSON.
    #[error("custom properties cannot be read: {0}")]
    Json(String),
    /// The property begins like one of a coating, but there is none of its name.
    #[error(
        "there is no custom property `{key}`; there are {}, and settings such as coating.adhesion.mean",
        KEYS.join(", ")
    )]
    UnknownKey {
        /// Name of the property.
        key: String,
    },
    /// The value is of a kind that the property cannot have.
    #[error("custom property `{key}` must be {expected}, but is {found}")]
    Kind {
        /// Name of the property.
        key: String,
        /// What it may be, in words.
        expected: &'static str,
        /// Value that was found, as JSON.
        found: String,
    },
    /// The age to begin with is out of range.
    #[error("custom property `coating_start_age` is {found}, but its range is 0 to {MOST_START_AGE}")]
    StartAge {
        /// Age that was found.
        found: f64,
    },
    /// There is no such preset or setting, or the setting is out of its range.
    #[error("custom property `{key}`: {source}")]
    Settings {
        /// Name of the property.
        key: String,
        /// Reason.
        source: Box<SettingsError>,
    },
}
