//! Reports text that is no rating.

/// Error of text that is no rating.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{found:?} is no rating: write it as {expected}")]
pub struct RatingError {
    /// The text.
    pub found: String,
    /// Ways to write such a rating.
    pub expected: &'static str,
}
