//! Defines [`Outline`], what the backs and the metal of a primitive take over from the prop's material.

use bevy::{
    asset::Handle, color::Alpha, image::Image, material::OpaqueRendererMethod, math::Affine2, mesh::UvChannel,
    pbr::StandardMaterial, prelude::AlphaMode, render::render_resource::Face,
};

use crate::{
    api::outline::{PropMask, PropOutline},
    appearance::shading::StainPart,
    mesh_reader::SlotAttributes,
};

/// Sides and holes of a primitive of the prop, and the passes that draw it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Outline {
    cull_mode: Option<Face>,
    double_sided: bool,
    mask: Option<Mask>,
    fog_enabled: bool,
    depth_bias: f32,
    opaque_render_method: OpaqueRendererMethod,
}

/// Holes of a primitive.
#[derive(Clone, Debug, PartialEq)]
struct Mask {
    mode: AlphaMode,
    /// Alpha of the material's own colour.
    alpha: f32,
    texture: Option<Handle<Image>>,
    channel: UvChannel,
    uv_transform: Affine2,
}

impl From<&StandardMaterial> for Outline {
    fn from(own: &StandardMaterial) -> Self {
        let mask = matches!(own.alpha_mode, AlphaMode::Mask(_) | AlphaMode::AlphaToCoverage).then(|| Mask {
            mode: own.alpha_mode,
            alpha: own.base_color.alpha(),
            texture: own.base_color_texture.clone(),
            channel: own.base_color_channel.clone(),
            uv_transform: own.uv_transform,
        });
        Self {
            cull_mode: own.cull_mode,
            double_sided: own.double_sided,
            mask,
            fog_enabled: own.fog_enabled,
            depth_bias: own.depth_bias,
            opaque_render_method: own.opaque_render_method,
        }
    }
}

impl From<&PropOutline> for Outline {
    fn from(given: &PropOutline) -> Self {
        let sides = if given.double_sided { None } else { Some(Face::Back) };
        let mask = given.mask.clone().map(|PropMask { texture, cutoff, channel, uv_transform }| Mask {
            mode: AlphaMode::Mask(cutoff),
            alpha: 1.0,
            texture: Some(texture),
            channel,
            uv_transform,
        });
        let standard = Self::from(&StandardMaterial::default());
        Self { cull_mode: sides, double_sided: given.double_sided, mask, ..standard }
    }
}

impl Outline {
    /// Returns whether there are holes.
    pub fn is_masked(&self) -> bool {
        self.mask.is_some()
    }

    /// Returns the attributes that meshes need for the holes to be cut, out of those that the prop's own mesh has.
    pub fn attributes(&self, own: SlotAttributes) -> SlotAttributes {
        let Some(mask) = &self.mask else { return SlotAttributes::default() };
        let reads = |channel| mask.texture.is_some() && mask.channel == channel;
        SlotAttributes {
            uvs: own.uvs && reads(UvChannel::Uv0),
            uvs_1: own.uvs_1 && reads(UvChannel::Uv1),
            colors: own.colors,
            ..SlotAttributes::default()
        }
    }

    /// Returns `material` with these sides and holes, for a `part`.
    ///
    /// The metal is drawn from the sides from which the prop is. Triangles of backs are wound against the prop's, so of
    /// them one side is enough: the one that the prop does not draw, or would not if it were drawn from one only.
    /// `mirrored` says that the prop's transform mirrors it.
    pub fn apply(&self, part: StainPart, mirrored: bool, material: StandardMaterial) -> StandardMaterial {
        let other_side = if mirrored { Face::Front } else { Face::Back };
        let (cull_mode, double_sided) = match part {
            StainPart::Back => (Some(self.cull_mode.unwrap_or(other_side)), false),
            _ => (self.cull_mode, self.double_sided),
        };
        let mut material = StandardMaterial {
            cull_mode,
            double_sided,
            fog_enabled: self.fog_enabled,
            depth_bias: self.depth_bias,
            opaque_render_method: self.opaque_render_method,
            ..material
        };
        if let Some(mask) = &self.mask {
            material.alpha_mode = mask.mode;
            material.base_color.set_alpha(mask.alpha);
            material.base_color_texture.clone_from(&mask.texture);
            material.base_color_channel = mask.channel.clone();
            material.uv_transform = mask.uv_transform;
        }
        material
    }
}
