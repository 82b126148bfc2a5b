//! A plain wall to show things before: its light and materials, and writing on it.

use super::label::Label;
use bevy::light::NotShadowCaster;
use bevy::prelude::*;

/// From where the sun shines, a unit vector: the upper left, so low that curled film casts shadows.
pub fn sun_direction() -> Vec3 {
    Vec3::new(-0.60, 0.50, 0.62).normalize()
}

/// The wall itself.
pub fn plaster() -> StandardMaterial {
    StandardMaterial {
        base_color: Color::linear_rgb(0.42, 0.42, 0.415),
        perceptual_roughness: 0.9,
        reflectance: 0.3,
        ..default()
    }
}

/// Paint of any colour.
pub fn paint(base_color: Color) -> StandardMaterial {
    StandardMaterial { base_color, perceptual_roughness: 0.45, ..default() }
}

/// The colour of paint where it does not matter.
pub const PALE_GREEN: Color = Color::srgb(0.62, 0.75, 0.74);

/// A sheet with nothing but writing on it, so many metres high, around zero.
pub fn sheet(
    label: Label,
    height: f32,
    meshes: &mut Assets<Mesh>,
    materials: &mut Assets<StandardMaterial>,
) -> impl Bundle {
    let ink = materials.add(StandardMaterial {
        base_color: Color::linear_rgb(0.02, 0.02, 0.022),
        base_color_texture: Some(label.image),
        alpha_mode: AlphaMode::Blend,
        unlit: true,
        ..default()
    });
    let mesh = meshes.add(Rectangle::new(height * label.aspect, height));
    (Mesh3d(mesh), MeshMaterial3d(ink), NotShadowCaster)
}
