//! What is written below the panels.

use crate::common_scene::label::Pen;
use bevy::light::NotShadowCaster;
use bevy::prelude::*;

/// Writes `text` with its middle at `at`, `height` metres high, or less where it would be wider than `width`; turned to
/// whoever looks along `turn`.
pub fn write(
    commands: &mut Commands,
    meshes: &mut Assets<Mesh>,
    materials: &mut Assets<StandardMaterial>,
    images: &mut Assets<Image>,
    pen: &Pen,
    text: &str,
    at: Transform,
    [height, width]: [f32; 2],
) {
    if text.is_empty() {
        return;
    }
    let label = pen.write(text, images);
    let ink = materials.add(StandardMaterial {
        base_color: Color::linear_rgb(0.02, 0.02, 0.022),
        base_color_texture: Some(label.image),
        alpha_mode: AlphaMode::Blend,
        unlit: true,
        ..default()
    });
    let height = height.min(width / label.aspect);
    let sheet = meshes.add(Rectangle::new(height * label.aspect, height));
    commands.spawn((Mesh3d(sheet), MeshMaterial3d(ink), at, NotShadowCaster));
}
