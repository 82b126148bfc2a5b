//! Defines the outline of a prop: the sides from which its surface is drawn, and the holes that a mask cuts into it.

use bevy::{asset::Handle, image::Image, math::Affine2, mesh::UvChannel, reflect::prelude::*};

/// Sides and holes of a prop whose material is not a `StandardMaterial`, for the backs of its flakes and its bare
/// metal.
///
/// The plugin reads both from a `StandardMaterial` itself, and ignores this setting then. It cannot look into other
/// materials. The default is what Bevy draws by default: front sides only, without holes.
///
/// ```
/// use bevy_coating::prelude::*;
///
/// // A sheet of metal with a material of the game's own, drawn from both sides.
/// let outline = PropOutline { double_sided: true, ..PropOutline::default() };
/// let sheet = Coating::default().with_stain_display(StainDisplay::VertexColor).with_outline(outline.clone());
/// assert_eq!(sheet.outline, outline);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub struct PropOutline {
    /// Whether the surface is drawn from both sides. Default false.
    pub double_sided: bool,
    /// Mask that cuts holes into the surface. Default: none.
    pub mask: Option<PropMask>,
}

/// Mask that cuts holes into a prop: where the texture's alpha is below [`cutoff`](Self::cutoff), nothing is drawn.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn fence(assets: &AssetServer) -> Coating {
///     let mask = PropMask { texture: assets.load("fence.png"), ..PropMask::default() };
///     let outline = PropOutline { double_sided: true, mask: Some(mask) };
///     Coating::default().with_stain_display(StainDisplay::VertexColor).with_outline(outline)
/// }
/// # assert_eq!(PropMask::default().cutoff, 0.5);
/// ```
#[derive(Clone, Debug, PartialEq, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub struct PropMask {
    /// Texture whose alpha counts.
    pub texture: Handle<Image>,
    /// Alpha below which nothing is drawn: 0 to 1, default 0.5.
    pub cutoff: f32,
    /// Texture coordinates of the prop's mesh that the texture is read at. Default: the first.
    pub channel: UvChannel,
    /// Transform of these coordinates. Default: none.
    pub uv_transform: Affine2,
}

impl Default for PropMask {
    fn default() -> Self {
        Self { texture: Handle::default(), cutoff: 0.5, channel: UvChannel::default(), uv_transform: Affine2::IDENTITY }
    }
}
