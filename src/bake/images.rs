//! Says whether texture images are read.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

/// Whether texture images are read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Images {
    /// Images are read, as [`Baked::glb`](super::Baked::glb) needs them.
    #[default]
    Load,
    /// Images are left where they are: enough for figures and lists of vertices.
    Skip,
}
