//! Makes parts of what is left as it is where no document has it.

use bevy_math::Vec3;

use crate::{
    appearance::MeshPart,
    bake::model::{ModelMesh, Slot},
    surface::Surface,
};

/// Parts of all slots that have triangles, with the slots.
pub fn parts(mesh: &ModelMesh) -> Vec<(MeshPart, Slot)> {
    let parts = mesh.slots.iter().enumerate().map(|(i, &slot)| (part(&mesh.surface, i), slot));
    parts.filter(|(part, _)| !part.is_empty()).collect()
}

/// The triangles of one slot, each with corners of its own.
fn part(surface: &Surface, slot: usize) -> MeshPart {
    let mut part = MeshPart::default();
    let mut indices = 0..;
    for (t, &triangle) in surface.triangles.iter().enumerate() {
        if surface.slots.get(t).map_or(0, |&slot| slot as usize) != slot {
            continue;
        }
        let corners = triangle.map(|v| surface.positions.get(v as usize).copied().unwrap_or_default());
        let flat = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or(Vec3::Y);
        for (k, corner) in corners.into_iter().enumerate() {
            let c = t * 3 + k;
            part.indices.extend(indices.next());
            part.positions.push(corner.to_array());
            part.normals.push(surface.normals.get(c).copied().unwrap_or(flat).to_array());
            part.uvs.extend(surface.uvs.get(c).map(|uv| uv.to_array()));
            part.uvs_1.extend(surface.uvs_1.get(c).map(|uv| uv.to_array()));
            part.tangents.extend(surface.tangents.get(c).map(|t| t.to_array()));
            part.colors.extend(surface.colors.get(c).map(|color| color.to_array()));
        }
    }
    part
}
