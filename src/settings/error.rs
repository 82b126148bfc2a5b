//! What can be wrong with settings.

use std::fmt;

use super::range::Range;

/// Why settings were refused: what is wrong and, if they were read from a file, where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub struct SettingsError {
    /// Where in which file; `None` for settings that were not read from text.
    pub position: Option<TextPosition>,
    /// What is wrong.
    pub kind: SettingsErrorKind,
}

/// A place in a settings file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextPosition {
    /// Name of the file, as it was given to the reader.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

/// What is wrong with settings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingsErrorKind {
    /// A value is NaN, infinite or outside its range.
    #[error("setting `{field}` is {found}, but its range is {range}")]
    OutOfRange {
        /// Path of the setting, like `tearing.alpha`.
        field: &'static str,
        /// The value it has.
        found: f32,
        /// What it may be.
        range: Range,
    },
    /// A value is no number, or breaks off.
    #[error("setting `{field}` must be a number in its range of {range}: {cause}")]
    Malformed {
        /// Path of the setting.
        field: &'static str,
        /// What it may be.
        range: Range,
        /// What was found instead.
        cause: String,
    },
    /// There is no such setting or stage.
    #[error("there is no setting `{path}`; known here: {}", known.join(", "))]
    UnknownField {
        /// What was asked for.
        path: String,
        /// What there is in its place.
        known: Vec<&'static str>,
    },
    /// A setting or stage is given twice in a file.
    #[error("setting `{path}` is given twice")]
    Duplicate {
        /// What is repeated.
        path: String,
    },
    /// The text is not RON of the expected shape.
    #[error("{0}")]
    Syntax(String),
    /// There is no such preset.
    #[error("there is no preset `{name}`; there are {}", known.join(", "))]
    UnknownPreset {
        /// What was asked for.
        name: String,
        /// The presets there are.
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
