//! Defines how stains are drawn on the paint.

use bevy::reflect::prelude::*;

/// Way in which stains are drawn on the front of the paint.
///
/// The backs of flakes and the bare metal always show their stains: with a stained material where
/// [`Material`](Self::Material) is chosen and available, and with vertex colours otherwise.
///
/// ```
/// use bevy_coating::prelude::*;
///
/// // A prop whose material is not a `StandardMaterial`.
/// let toon = Coating::default().with_stain_display(StainDisplay::VertexColor);
/// assert_eq!(Coating::default().stain_display, StainDisplay::Material);
/// # assert_eq!(toon.stain_display, StainDisplay::VertexColor);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq, Hash)]
pub enum StainDisplay {
    /// Extended material: while the prop is coated, its `StandardMaterial` is replaced by `StainedMaterial`, which
    /// draws stains in detail over it. Without feature `render`, or in an app without Bevy's `PbrPlugin`, it is the
    /// same as [`None`](Self::None).
    #[default]
    Material,
    /// Vertex colours: stains are mixed into the colours of the film's vertices, and the prop's material stays. They
    /// are less detailed, but work with any material that uses vertex colours.
    VertexColor,
    /// No stains on the paint. The prop's material stays.
    None,
}
