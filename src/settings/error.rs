//! Errors of settings.

use std::fmt;

use super::range::Range;

/// Reason why settings were refused, with the position in the text if they were read from one.
///
/// ```
/// use bevy_coating::settings::{CoatingSettings, SettingsErrorKind};
///
/// let error = CoatingSettings::from_ron("(\n  tearing: (gamma: 2.0),\n)", "barrel.coating.ron").unwrap_err();
/// assert!(matches!(error.kind, SettingsErrorKind::UnknownField { .. }));
/// assert_eq!(error.position.unwrap().line, 2);
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub struct SettingsError {
    /// Position in the text; `None` for settings that were not read from text.
    pub position: Option<TextPosition>,
    /// Fault that was found.
    pub kind: SettingsErrorKind,
}

/// Position in the text of a settings file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextPosition {
    /// Name of the file, as it was given to [`CoatingSettings::from_ron`](crate::settings::CoatingSettings::from_ron).
    pub file: String,
    /// Number of the line, from 1.
    pub line: usize,
    /// Number of the character in the line, from 1.
    pub column: usize,
}

/// Fault of settings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingsErrorKind {
    /// A value is NaN, infinite or outside its range.
    #[error("setting `{field}` is {found}, but its range is {range}")]
    OutOfRange {
        /// Path of the setting, like `tearing.alpha`.
        field: &'static str,
        /// Value that was given.
        found: f32,
        /// Range of the setting.
        range: Range,
    },
    /// A value is not a number, or the text ends in it.
    #[error("setting `{field}` must be a number in its range of {range}: {cause}")]
    Malformed {
        /// Path of the setting, like `tearing.alpha`.
        field: &'static str,
        /// Range of the setting.
        range: Range,
        /// Reason in words, with the text that was found.
        cause: String,
    },
    /// A setting has names, and the value is none of them.
    #[error("setting `{field}` must be one of {}: {cause}", known.join(", "))]
    UnknownName {
        /// Path of the setting, like `scale.rules`.
        field: &'static str,
        /// Names that it may have.
        known: Vec<&'static str>,
        /// Reason in words, with the text that was found.
        cause: String,
    },
    /// There is no such setting or stage.
    #[error("there is no setting `{path}`; known here: {}", known.join(", "))]
    UnknownField {
        /// Path that was given.
        path: String,
        /// Names that are known there: stages, or paths of settings.
        known: Vec<&'static str>,
    },
    /// A setting or stage is given twice in a file.
    #[error("setting `{path}` is given twice")]
    Duplicate {
        /// Name of the stage, or path of the setting, that is repeated.
        path: String,
    },
    /// The text is not RON, or not a struct of settings. Holds the message of the parser.
    #[error("{0}")]
    Syntax(String),
    /// There is no preset of the given name.
    #[error("there is no preset `{name}`; there are {}", known.join(", "))]
    UnknownPreset {
        /// Name that was given.
        name: String,
        /// Names of all presets.
        known: Vec<&'static str>,
    },
}

impl SettingsErrorKind {
    pub(super) fn unknown_field(path: impl Into<String>, known: impl IntoIterator<Item = &'static str>) -> Self {
        Self::UnknownField { path: path.into(), known: known.into_iter().collect() }
    }
}

impl From<SettingsErrorKind> for SettingsError {
    fn from(kind: SettingsErrorKind) -> Self {
        Self { position: None, kind }
    }
}

impl fmt::Display for SettingsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.position {
            Some(TextPosition { file, line, column }) => write!(f, "{file}:{line}:{column}: {}", self.kind),
            None => self.kind.fmt(f),
        }
    }
}
