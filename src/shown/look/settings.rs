//! Colours and strengths of stains.

use bevy_math::Vec3;

/// Colours and strengths of stains. What they are made of is in the [settings](crate::settings); this is only how they
/// look. Colours are linear, 0 to 1; sizes in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct StainLook {
    /// Colour of thin run-off, the ends of streaks: orange.
    pub rust_thin: Vec3,
    /// Colour of thick run-off, close to its source: dark brown.
    pub rust_thick: Vec3,
    /// How much of the paint a full coat of rust hides: 0 to 1, default 0.85 (VC 6.1).
    pub rust_strength: f32,
    /// Roughness of rust: 0.089 to 1, default 0.9.
    pub rust_roughness: f32,
    /// Width of the streaks in run-off: above 0, default 4 mm. The widest are two and a half times that, the finest
    /// less than half.
    pub streak_width: f32,
    /// How many times as long as wide a streak is: 1 or more, default 22.
    pub streak_stretch: f32,
    /// Colour of dust and soot: black.
    pub dust: Vec3,
    /// How much of the surface the thickest dust hides: 0 to 1, default 0.75.
    pub dust_strength: f32,
    /// How much of the reflectance it takes (VC 6.2): 0 to 1, default 0.7.
    pub dust_dulling: f32,
    /// Size of the patches in which dust gathers: above 0, default 25 mm.
    pub dust_size: f32,
    /// How much darker wet paint is: 0 to 1, default 0.4. Rust and dust, which soak it up, darken half as much again.
    pub wet_darkening: f32,
    /// Roughness of a wet surface: 0.089 to 1, default 0.14.
    pub wet_roughness: f32,
    /// How far rust creeps over the backs of flakes from where the metal under them rusts: 0 to 1, default 0.9.
    pub creep: f32,
    /// Colour of metal that has not rusted. In a `Coating`, [`MetalLook::steel`](crate::plugin::MetalLook::steel)
    /// stands for this.
    pub steel: Vec3,
    /// How metallic it reflects: 0 to 1. In a `Coating`, `MetalLook::metallic` stands for this.
    pub steel_metallic: f32,
    /// Its roughness: 0.089 to 1. In a `Coating`, `MetalLook::roughness` stands for this.
    pub steel_roughness: f32,
    /// Colour of the first rust on metal: almost black.
    pub first_rust: Vec3,
    /// Colour of the layers that rust grows to on metal: orange. In a `Coating`, `MetalLook::rust` stands for this.
    pub rust: Vec3,
    /// Size of the patches in which metal rusts: above 0, default 35 mm. Scales, pits and grit come in fixed shares
    /// of it.
    pub patch_size: f32,
    /// Height of thick layers of rust over the bare metal: 0 or more, default 0.5 mm.
    pub relief: f32,
}

impl Default for StainLook {
    fn default() -> Self {
        Self {
            rust_thin: Vec3::new(0.33, 0.105, 0.024),
            rust_thick: Vec3::new(0.060, 0.020, 0.009),
            rust_strength: 0.85,
            rust_roughness: 0.9,
            streak_width: 0.004,
            streak_stretch: 22.0,
            dust: Vec3::new(0.020, 0.018, 0.016),
            dust_strength: 0.75,
            dust_dulling: 0.7,
            dust_size: 0.025,
            wet_darkening: 0.4,
            wet_roughness: 0.14,
            creep: 0.9,
            steel: Vec3::new(0.40, 0.39, 0.375),
            steel_metallic: 0.9,
            steel_roughness: 0.42,
            first_rust: Vec3::new(0.034, 0.018, 0.011),
            rust: Vec3::new(0.245, 0.066, 0.017),
            patch_size: 0.035,
            relief: 0.0005,
        }
    }
}
