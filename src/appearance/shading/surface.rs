//! Defines [`SurfaceShading`], the material inputs that shading begins with and ends with.

use bevy_math::Vec3;

/// Inputs of a physically based material at one place of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceShading {
    /// Base colour: linear, 0 to 1.
    pub base_color: Vec3,
    /// Metalness: 0 (dielectric) to 1 (metal).
    pub metallic: f32,
    /// Perceptual roughness: 0 to 1.
    pub roughness: f32,
    /// Reflectance at normal incidence in the scale of Bevy's `StandardMaterial`: 0 to 1, where 0.5 is 4 %.
    pub reflectance: f32,
    /// Height above the surface, in metres. Its slope tilts the normals of thick rust.
    pub height: f32,
}
