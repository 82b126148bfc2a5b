//! What is written below the panels.

use crate::common_scene::{label::Pen, wall};
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
    let height = height.min(width / label.aspect);
    commands.spawn((wall::sheet(label, height, meshes, materials), at));
}
