//! How the paint shows its stains.

use bevy::reflect::prelude::*;

/// How stains are shown on the front of the paint. Backs of flakes and bare metal, which are the plugin's own, always
/// show theirs: with a material of their own where that is chosen and there is one, else with vertex colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq, Hash)]
pub enum StainDisplay {
    /// While it is coated, the prop's `StandardMaterial` is replaced by an extension of it that draws stains in detail
    /// (`StainedMaterial`); everything else of it stays as it is. Without feature `render`, or in an app without
    /// Bevy's `PbrPlugin`, the same as [`None`](Self::None).
    #[default]
    Material,
    /// The prop's material is not touched: stains go into the colours of the film's vertices, over those that the prop
    /// has. Less detail, but works with any material that heeds vertex colours.
    VertexColor,
    /// Stains are not shown on the paint.
    None,
}
