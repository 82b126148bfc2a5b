//! Errors of masks.

use super::{channel::UvSet, names::EFFECTS};

/// Reason why a mask cannot be used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MaskError {
    /// A number is NaN or out of its range.
    #[error("`{field}` of {of} is {found}, but its range is {least} to {most}")]
    OutOfRange {
        /// Mask or effect.
        of: &'static str,
        /// Name of the number.
        field: &'static str,
        /// Value that was given.
        found: f32,
        /// Least that it may be.
        least: f32,
        /// Most that it may be.
        most: f32,
    },
    /// The ends of a mask's slope are the same.
    #[error("both ends of the mask `{mask}` are {both}, but its weight must run from one to another")]
    NoSlope {
        /// Name of the mask.
        mask: &'static str,
        /// Value of both.
        both: f32,
    },
    /// There is no such effect.
    #[error("a mask has no effect `{name}`; there are {}", EFFECTS.join(", "))]
    UnknownEffect {
        /// Name that was given.
        name: String,
    },
    /// There is no image of the name that a texture mask gives.
    #[error("a mask asks for the image `{name}`, but {}", known_images(known))]
    NoImage {
        /// Name of the image.
        name: String,
        /// Names of the images that there are.
        known: Vec<String>,
    },
    /// The prop does not have the texture coordinates that a texture mask asks for.
    #[error(
        "the mask image `{image}` needs the {} texture coordinates, which the prop does not have: unwrap the model, or \
         use a rule such as Edges, Lower or Noise",
        match uv { UvSet::First => "first", UvSet::Second => "second" }
    )]
    NoCoordinates {
        /// Name of the image.
        image: String,
        /// Set that is missing.
        uv: UvSet,
    },
    /// The prop has no vertex colours.
    #[error("the mask `Color` needs vertex colours, which the prop does not have: paint some, or use a texture")]
    NoColors,
    /// An image does not have as many texels as its size says, or none.
    #[error("a mask image of {width} x {height} texels cannot have {found} texels")]
    ImageSize {
        /// Width in texels.
        width: u32,
        /// Height in texels.
        height: u32,
        /// Number of texels that there are.
        found: usize,
    },
    /// The film has been under way, but masks say how films begin.
    #[error("masks act on fresh films, but this one has taken {steps} steps: apply them at age 0")]
    NotFresh {
        /// Steps that the film has taken.
        steps: u64,
    },
    /// The film is not the one that was built.
    #[error("the film has {found} vertices, but the film that was built has {expected}: give the `BuiltFilm` it is of")]
    OtherFilm {
        /// Number of vertices of the film.
        found: usize,
        /// Number of vertices of the built film.
        expected: usize,
    },
    /// A short text is no mask.
    #[error("{text}: {cause}; write it as WHERE:EFFECT=A..B, such as wear.png:adhesion=1..0.2 or edges:binding=1..0.5")]
    Malformed {
        /// Text that was given.
        text: String,
        /// Reason in words.
        cause: &'static str,
    },
    /// A text is no list of masks.
    #[error("{file}:{line}:{column}: {cause}")]
    Text {
        /// Name of the file.
        file: String,
        /// Number of the line, from 1.
        line: usize,
        /// Number of the character in the line, from 1.
        column: usize,
        /// Reason in words.
        cause: String,
    },
    /// A mask of a list is out of range.
    #[error("{file}: mask {number}: {source}")]
    InFile {
        /// Name of the file.
        file: String,
        /// Number of the mask, from 1.
        number: usize,
        /// Reason.
        source: Box<MaskError>,
    },
}

fn known_images(known: &[String]) -> String {
    if known.is_empty() { "no images were given".into() } else { format!("there are only {}", known.join(", ")) }
}
