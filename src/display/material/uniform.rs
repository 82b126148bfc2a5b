//! Defines the uniform buffer of the stain shader.

use bevy::{math::Vec3, render::render_resource::ShaderType};

use super::view::StainView;
use crate::appearance::shading::{FilmShading, StainPattern};

/// Uniform buffer of a part: colours, strengths and patterns. It has the layout of `StainUniform` in `shading.wgsl`.
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
    alpha_only: u32,
}

impl StainUniform {
    /// Returns the uniform of a part with this shading.
    pub(super) fn new(view: StainView, alpha_only: bool, shading: &FilmShading, pattern: &StainPattern) -> Self {
        // The shader divides by sizes, so a size of 0 would give NaN.
        let size = |size: f32| size.max(1e-5);
        Self {
            rust_thin: shading.stains.rust_thin,
            rust_strength: shading.stains.rust_strength,
            rust_thick: shading.stains.rust_thick,
            rust_roughness: shading.stains.rust_roughness,
            dust: shading.stains.dust,
            dust_strength: shading.stains.dust_strength,
            steel: shading.metal.steel,
            steel_metallic: shading.metal.metallic,
            first_rust: shading.metal.first_rust,
            steel_roughness: shading.metal.roughness,
            rust: shading.metal.rust,
            relief: shading.metal.relief,
            streaks: pattern.streaks,
            streak_width: size(shading.stains.streak_width),
            offset: pattern.offset,
            streak_stretch: shading.stains.streak_stretch.max(1.0),
            dust_dulling: shading.stains.dust_dulling,
            dust_size: size(shading.stains.dust_size),
            wet_darkening: shading.stains.wet_darkening,
            wet_roughness: shading.stains.wet_roughness,
            creep: shading.stains.creep,
            patch_size: size(shading.metal.patch_size),
            view: view as u32,
            alpha_only: u32::from(alpha_only),
        }
    }
}
