//! Colours and strengths of all that shows where paint ages.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::ReflectDefault;
use bevy_math::Vec3;

use super::SurfaceShading;

/// How a film is shaded: its stains, the metal under it and the primer on its back. Colours are linear, 0 to 1; sizes
/// in metres. How much rust, dust and water there is follows from the [settings](crate::settings) instead.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub struct FilmShading {
    /// Rust that has run off, dust and water, on paint and metal.
    pub stains: StainShading,
    /// The metal under the paint.
    pub metal: MetalShading,
    /// The back of the paint, seen where it curls.
    pub primer: PrimerShading,
}

/// Colours and strengths of rust that has run off, of dust and of water.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub struct StainShading {
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
    /// How much of the reflectance dust takes (VC 6.2): 0 to 1, default 0.7.
    pub dust_dulling: f32,
    /// Size of the patches in which dust gathers: above 0, default 25 mm.
    pub dust_size: f32,
    /// How much darker wet paint is: 0 to 1, default 0.4. Rust and dust, which soak it up, darken half as much again.
    pub wet_darkening: f32,
    /// Roughness of a wet surface: 0.089 to 1, default 0.14.
    pub wet_roughness: f32,
    /// How far rust creeps over the backs of flakes from where the metal under them rusts: 0 to 1, default 0.9.
    pub creep: f32,
}

impl Default for StainShading {
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
        }
    }
}

/// The metal under the paint: what it is made of, and what it rusts to.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub struct MetalShading {
    /// Colour of metal that has not rusted: bright steel, sRGB (0.67, 0.66, 0.65).
    pub steel: Vec3,
    /// How metallic it reflects where it has not rusted: 0 to 1, default 0.9. Bare metal looks dull without an
    /// environment map.
    pub metallic: f32,
    /// Perceptual roughness where it has not rusted: 0.089 to 1, default 0.42.
    pub roughness: f32,
    /// Colour of the first rust: almost black.
    pub first_rust: Vec3,
    /// Colour of the layers that rust grows to: orange-brown, sRGB (0.532, 0.285, 0.138).
    pub rust: Vec3,
    /// Size of the patches in which metal rusts: above 0, default 35 mm. Scales, pits and grit come in fixed shares
    /// of it.
    pub patch_size: f32,
    /// Height of thick layers of rust over the bare metal: 0 or more, default 0.5 mm.
    pub relief: f32,
}

impl Default for MetalShading {
    fn default() -> Self {
        Self {
            steel: Vec3::new(0.406_448_78, 0.393_162_76, 0.380_130_7),
            metallic: 0.9,
            roughness: 0.42,
            first_rust: Vec3::new(0.034, 0.018, 0.011),
            rust: Vec3::new(0.244_933_44, 0.066_125_04, 0.016_999_12),
            patch_size: 0.035,
            relief: 0.0005,
        }
    }
}

#[cfg(feature = "plugin")]
impl MetalShading {
    /// Sets the colour of metal that has not rusted.
    pub fn with_steel(self, color: impl Into<bevy::color::Color>) -> Self {
        Self { steel: linear(color.into()), ..self }
    }

    /// Sets the colour of the layers that rust grows to.
    pub fn with_rust(self, color: impl Into<bevy::color::Color>) -> Self {
        Self { rust: linear(color.into()), ..self }
    }
}

/// The back of the paint, without stains.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub struct PrimerShading {
    /// Colour: a warm grey, sRGB (0.55, 0.52, 0.47).
    pub color: Vec3,
    /// Perceptual roughness: 0.089 to 1, default 0.85.
    pub roughness: f32,
    /// Reflectance at normal incidence as Bevy's `StandardMaterial` has it: 0 to 1, default 0.3.
    pub reflectance: f32,
}

impl Default for PrimerShading {
    fn default() -> Self {
        Self { color: Vec3::new(0.263_175_1, 0.233_022_2, 0.187_820_77), roughness: 0.85, reflectance: 0.3 }
    }
}

#[cfg(feature = "plugin")]
impl<C: Into<bevy::color::Color>> From<C> for PrimerShading {
    /// The default primer in another colour.
    fn from(color: C) -> Self {
        Self { color: linear(color.into()), ..Self::default() }
    }
}

impl PrimerShading {
    /// Returns the inputs of a physically based material for it.
    pub fn surface(&self) -> SurfaceShading {
        SurfaceShading {
            base_color: self.color,
            metallic: 0.0,
            roughness: self.roughness,
            reflectance: self.reflectance,
            height: 0.0,
        }
    }
}

#[cfg(feature = "plugin")]
fn linear(color: bevy::color::Color) -> Vec3 {
    use bevy::color::ColorToComponents;
    color.to_linear().to_vec3()
}

#[cfg(all(test, feature = "plugin"))]
mod tests {
    use super::*;

    #[test]
    fn default_colors_are_the_srgb_ones_of_their_docs() {
        let color = bevy::color::Color::srgb;
        let metal = MetalShading::default();
        assert_eq!(metal.clone().with_steel(color(0.67, 0.66, 0.65)).steel, metal.steel);
        assert_eq!(metal.clone().with_rust(color(0.532, 0.285, 0.138)).rust, metal.rust);
        assert_eq!(PrimerShading::from(color(0.55, 0.52, 0.47)), PrimerShading::default());
    }
}
