//! How stained surfaces look: from fields to colour, roughness, metalness and relief. The same on the CPU, for baked
//! models, as in the shader (`src/render/weathering.wgsl`), which a test holds together.

use bevy_math::Vec3;

/// What a place of a surface looks like: the inputs of a physically based material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceLook {
    /// Linear base colour.
    pub base_color: Vec3,
    /// 0 dielectric to 1 metal.
    pub metallic: f32,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f32,
    /// Reflectance at normal incidence as Bevy's `StandardMaterial` has it: 0.5 is 4 %.
    pub reflectance: f32,
    /// Relief in metres above the surface, for normals.
    pub height: f32,
}

/// What is known of a place's stains; interpolated from [`ShownPart::stains`](super::ShownPart::stains) and
/// [`ShownPart::rest`](super::ShownPart::rest).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StainSample {
    /// Layers of rust.
    pub rust: f32,
    /// Dust, 0 to 1.
    pub dust: f32,
    /// Moisture, 0 to 1.
    pub moisture: f32,
    /// How far the metal there has rusted, 0 to 1.
    pub corrosion: f32,
    /// The place at rest, in the film's space.
    pub rest: Vec3,
}
