//! What the shader is told about a part.

use bevy::{
    math::Vec3,
    pbr::{ExtendedMaterial, StandardMaterial},
    render::render_resource::ShaderType,
};

use super::{StainExtension, StainView};
use crate::shown::look::{StainLook, StainPattern};

/// A standard material with stains on it.
pub type StainedMaterial = ExtendedMaterial<StandardMaterial, StainExtension>;

/// `StainUniform` of `look.wgsl`.
#[derive(Clone, Copy, Debug, Default, PartialEq, ShaderType)]
pub struct StainUniform {
    rust_thin: Vec3,
    rust_strength: f32,
    rust_thick: Vec3,
    rust_roughness: f32,
    dust: Vec3,
    dust_strength: f32,
    steel: Vec3,
    steel_metallic: f32,
    first_rust: Vec3,
    steel_roughness: f32,
    rust: Vec3,
    relief: f32,
    streaks: Vec3,
    streak_width: f32,
    offset: Vec3,
    streak_stretch: f32,
    dust_dulling: f32,
    dust_size: f32,
    wet_darkening: f32,
    wet_roughness: f32,
    creep: f32,
    patch_size: f32,
    view: u32,
}

impl StainUniform {
    pub(super) fn new(view: StainView, look: &StainLook, pattern: &StainPattern) -> Self {
        // Sizes divide: what is not above 0 would be drawn as NaN.
        let size = |size: f32| size.max(1e-5);
        Self {
            rust_thin: look.rust_thin,
            rust_strength: look.rust_strength,
            rust_thick: look.rust_thick,
            rust_roughness: look.rust_roughness,
            dust: look.dust,
            dust_strength: look.dust_strength,
            steel: look.steel,
            steel_metallic: look.steel_metallic,
            first_rust: look.first_rust,
            steel_roughness: look.steel_roughness,
            rust: look.rust,
            relief: look.relief,
            streaks: pattern.streaks,
            streak_width: size(look.streak_width),
            offset: pattern.offset,
            streak_stretch: look.streak_stretch.max(1.0),
            dust_dulling: look.dust_dulling,
            dust_size: size(look.dust_size),
            wet_darkening: look.wet_darkening,
            wet_roughness: look.wet_roughness,
            creep: look.creep,
            patch_size: size(look.patch_size),
            view: view as u32,
        }
    }
}
