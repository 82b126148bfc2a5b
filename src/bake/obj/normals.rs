//! Makes normals for faces that have none.

use bevy_math::{Vec3, ops};

/// Faces that meet at more than this angle, in radians, have a crease between them where the file gives no
/// normals.
const CREASE: f32 = 0.7;

/// Smooth normals with creases, three a triangle. Positions need not be finite, nor shared between faces
/// that touch: creases are where vertices are split.
pub fn smooth_normals(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Vec3> {
    let cross = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| positions[v as usize]);
        (b - a).cross(c - a)
    };
    // Crosses are twice the area long: large faces count for more.
    let crosses: Vec<Vec3> = triangles.iter().map(cross).collect();
    let units: Vec<Vec3> = crosses.iter().map(|n| n.normalize_or(Vec3::Y)).collect();
    let mut around = vec![Vec::new(); positions.len()];
    for (f, triangle) in triangles.iter().enumerate() {
        for &v in triangle {
            around[v as usize].push(f);
        }
    }
    let smooth = ops::cos(CREASE);
    let normal = |f: usize, v: u32| {
        let near = around[v as usize].iter().filter(|&&g| units[f].dot(units[g]) > smooth);
        near.map(|&g| crosses[g]).sum::<Vec3>().normalize_or(units[f])
    };
    triangles.iter().enumerate().flat_map(|(f, t)| t.map(|v| normal(f, v))).collect()
}
