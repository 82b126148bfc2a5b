//! Makes normals for faces that have none.

use bevy_math::{Vec3, ops};

/// Faces that meet at more than this angle, in radians, have a crease between them where the file gives no
/// normals.
const CREASE: f32 = 0.7;

/// Smooth normals with creases, three a triangle. Positions need not be finite, nor shared between faces
/// that touch: creases are where vertices are split.
pub fn smooth_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let place = |v: u32| positions.get(v as usize).copied().unwrap_or_default();
    // Crosses are twice the area long: large faces count for more. With each its direction.
    let cross = |t: &[u32; 3]| {
        let [a, b, c] = t.map(place);
        let cross = (b - a).cross(c - a);
        (cross, cross.normalize_or(Vec3::Y))
    };
    let faces: Vec<(Vec3, Vec3)> = triangles.iter().map(cross).collect();
    let mut around = vec![Vec::new(); positions.len()];
    for (f, triangle) in triangles.iter().enumerate() {
        for &v in triangle {
            if let Some(around) = around.get_mut(v as usize) {
                around.push(f);
            }
        }
    }
    let smooth = ops::cos(CREASE);
    let normal = |unit: Vec3, v: u32| {
        let near = around.get(v as usize).into_iter().flatten().filter_map(|&face| faces.get(face));
        let near = near.filter(|(_, other)| unit.dot(*other) > smooth);
        near.map(|(cross, _)| *cross).sum::<Vec3>().normalize_or(unit)
    };
    triangles.iter().zip(&faces).flat_map(|(t, (_, unit))| t.map(|v| normal(*unit, v))).collect()
}
