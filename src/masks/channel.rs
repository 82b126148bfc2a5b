//! Channels, texture coordinates, and what lies beyond images.

use serde::{Deserialize, Serialize};

/// Channel of an image or of vertex colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Channel {
    /// Red, which is grey in grey images.
    #[default]
    Red,
    /// Green.
    Green,
    /// Blue.
    Blue,
    /// Alpha: 1 is opaque.
    Alpha,
}

/// Set of texture coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum UvSet {
    /// The first set (glTF's `TEXCOORD_0`).
    #[default]
    First,
    /// The second set (glTF's `TEXCOORD_1`), often that of a lightmap, in which nothing overlaps.
    Second,
}

/// Ways in which an image goes on beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The image again, each mirrored.
    Mirror,
    /// Its outermost texels.
    Clamp,
}
