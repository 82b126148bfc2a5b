//! Defines the colours and strengths with which aged paint is shaded.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::ReflectDefault;
use bevy_math::Vec3;

use super::surface::SurfaceShading;

/// Shading of a film: colours and strengths of its stains, of the metal under it and of the primer on its back.
///
/// Colours are linear, 0 to 1; sizes are in metres. The amounts of rust, dust and water do not depend on the shading:
/// they are simulated, steered by the [settings](crate::settings).
///
/// ```
/// use bevy_coating::appearance::shading::{FilmShading, StainShading};
///
/// let sooty = FilmShading {
///     stains: StainShading { dust_strength: 0.95, ..StainShading::default() },
///     ..FilmShading::default()
/// };
/// assert_eq!(sooty.metal, FilmShading::default().metal);
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub struct FilmShading {
    /// Colours and strengths of rust that has run off, of dust and of water, on paint and metal.
    pub stains: StainShading,
    /// Shading of the metal under the paint.
    pub metal: MetalShading,
    /// Shading of the back of the paint, which is seen where the paint curls.
    pub primer: PrimerShading,
}

/// Colours and strengths of rust that has run off, of dust and of water.
///
/// Colours are linear, 0 to 1; sizes are in metres.
///
/// ```
/// use bevy_coating::appearance::shading::StainShading;
/// use bevy_math::Vec3;
///
/// // Verdigris on copper instead of rust on steel.
/// let verdigris = StainShading {
///     rust_thin: Vec3::new(0.15, 0.45, 0.33),
///     rust_thick: Vec3::new(0.05, 0.25, 0.18),
///     ..StainShading::default()
/// };
/// assert_eq!(verdigris.rust_strength, 0.85);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub struct StainShading {
    /// Colour of thin run-off: the veil, and the edges and ends of threads. Default: orange, (0.33, 0.105, 0.024).
    pub rust_thin: Vec3,
    /// Colour of thick run-off: threads close to their source. Default: dark brown, (0.06, 0.02, 0.009).
    pub rust_thick: Vec3,
    /// Share of the surface that a thick coat of run-off hides: 0 to 1, default 0.85 (VC 6.1).
    pub rust_strength: f32,
    /// Perceptual roughness of rust: 0.089 to 1, default 0.9.
    pub rust_roughness: f32,
    /// Typical width of the streaks of washed dust and of the threads in which rust runs off, in metres: above 0,
    /// default 0.004. The widest are about 3 times as wide, the finest less than half.
    pub streak_width: f32,
    /// Length of a streak, as a multiple of its width: 1 or more, default 22. Threads of run-off keep their width for
    /// 2.5 times as long; they end where the rust does.
    pub streak_stretch: f32,
    /// Colour of dust and soot. Default: almost black, (0.02, 0.018, 0.016).
    pub dust: Vec3,
    /// Share of the surface that the thickest dust hides: 0 to 1, default 0.75.
    pub dust_strength: f32,
    /// Share of the reflectance that the thickest dust takes away: 0 to 1, default 0.7 (VC 6.2).
    pub dust_dulling: f32,
    /// Size of the patches in which dust gathers, in metres: above 0, default 0.025. Patterns of water are scaled by
    /// it, too.
    pub dust_size: f32,
    /// Share of the light that clean wet paint loses: 0 to 1, default 0.4. Rust and dust soak up water and lose up to
    /// half as much again.
    pub wet_darkening: f32,
    /// Perceptual roughness of a wet surface: 0.089 to 1, default 0.14.
    pub wet_roughness: f32,
    /// Share of the backs of flakes that rust covers where the metal under them has rusted through: 0 to 1, default
    /// 0.9.
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

/// Shading of the metal under the paint, bright and rusted.
///
/// Colours are linear, 0 to 1; sizes are in metres.
///
/// ```
/// use bevy_coating::appearance::shading::MetalShading;
/// use bevy_math::Vec3;
///
/// let copper = MetalShading { steel: Vec3::new(0.93, 0.37, 0.24), ..MetalShading::default() };
/// assert_eq!(copper.roughness, MetalShading::default().roughness);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub struct MetalShading {
    /// Colour of metal that has not rusted. Default: bright steel, sRGB (0.67, 0.66, 0.65).
    pub steel: Vec3,
    /// Metalness where the metal has not rusted: 0 to 1, default 0.9. Bare metal looks dull without an environment map.
    pub metallic: f32,
    /// Perceptual roughness where the metal has not rusted: 0.089 to 1, default 0.42.
    pub roughness: f32,
    /// Colour of the first rust. Default: almost black, (0.034, 0.018, 0.011).
    pub first_rust: Vec3,
    /// Mean colour of thick, layered rust. Default: orange-brown, sRGB (0.532, 0.285, 0.138).
    pub rust: Vec3,
    /// Size of the patches in which metal rusts, in metres: above 0, default 0.035. Scales, pits and grit have fixed
    /// shares of it.
    pub patch_size: f32,
    /// Height of thick layers of rust over the bare metal, in metres: 0 or more, default 0.0005.
    pub relief: f32,
}

impl Default for MetalShading {
    fn default() -> Self {
        Self {
            steel: Vec3::new(0.406_448_33, 0.393_123_2, 0.380_056_32),
            metallic: 0.9,
            roughness: 0.42,
            first_rust: Vec3::new(0.034, 0.018, 0.011),
            rust: Vec3::new(0.244_864_37, 0.066_030_33, 0.016_964_128),
            patch_size: 0.035,
            relief: 0.0005,
        }
    }
}

#[cfg(feature = "plugin")]
impl MetalShading {
    /// Sets the colour of metal that has not rusted.
    ///
    /// ```
    /// use bevy::color::Color;
    /// use bevy_coating::appearance::shading::MetalShading;
    ///
    /// let brass = MetalShading::default()
    ///     .with_steel(Color::srgb(0.78, 0.63, 0.32))
    ///     .with_rust(Color::srgb_u8(70, 110, 90));
    /// assert!(brass.steel.x > brass.steel.z, "brass is yellow");
    /// ```
    pub fn with_steel(self, color: impl Into<bevy::color::Color>) -> Self {
        Self { steel: linear(color.into()), ..self }
    }

    /// Sets the mean colour of thick, layered rust.
    pub fn with_rust(self, color: impl Into<bevy::color::Color>) -> Self {
        Self { rust: linear(color.into()), ..self }
    }
}

/// Shading of the back of the paint, without stains.
///
/// With feature `plugin` a Bevy colour converts into the default primer of that colour.
///
/// ```
/// use bevy_coating::appearance::shading::PrimerShading;
/// use bevy_math::Vec3;
///
/// let red_lead = PrimerShading { color: Vec3::new(0.35, 0.06, 0.03), ..PrimerShading::default() };
/// assert_eq!(red_lead.surface().base_color, red_lead.color);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub struct PrimerShading {
    /// Colour, linear. Default: a warm grey, sRGB (0.55, 0.52, 0.47).
    pub color: Vec3,
    /// Perceptual roughness: 0.089 to 1, default 0.85.
    pub roughness: f32,
    /// Reflectance at normal incidence in the scale of Bevy's `StandardMaterial`: 0 to 1, default 0.3.
    pub reflectance: f32,
}

impl Default for PrimerShading {
    fn default() -> Self {
        Self { color: Vec3::new(0.263_273_42, 0.233_022_03, 0.187_316_66), roughness: 0.85, reflectance: 0.3 }
    }
}

#[cfg(feature = "plugin")]
impl<C: Into<bevy::color::Color>> From<C> for PrimerShading {
    /// Returns the default primer in another colour.
    fn from(color: C) -> Self {
        Self { color: linear(color.into()), ..Self::default() }
    }
}

impl PrimerShading {
    /// Returns the material inputs of the clean primer: not metallic and without relief.
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

/// Returns the linear components of a colour.
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
