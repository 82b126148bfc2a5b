//! A box with rounded edges, which with nothing but rounding is a sphere.

use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy_coating::surface::Surface;
use std::f32::consts::FRAC_PI_4;

/// Triangles with smooth normals, and texture coordinates without overlap: each of the six sides has a sixth of the
/// texture.
pub struct Shape {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    triangles: Vec<[u32; 3]>,
}

/// Share of a side's part of the texture that is left free around it.
const MARGIN: f32 = 0.02;

/// A box of `half` its size around `centre`, its edges rounded with `radius`, in `segments` from a side's flat part to
/// the middle of the edge.
pub fn rounded_box(centre: Vec3, half: Vec3, radius: f32, segments: u32) -> Shape {
    let mut shape = Shape { positions: vec![], normals: vec![], uvs: vec![], triangles: vec![] };
    let core = (half - radius).max(Vec3::ZERO);
    for side in 0..6 {
        let (w, sign) = (side % 3, if side < 3 { 1.0 } else { -1.0 });
        // Turned so that u, v and the outside are right-handed.
        let (u, v) = if sign > 0.0 { ((w + 1) % 3, (w + 2) % 3) } else { ((w + 2) % 3, (w + 1) % 3) };
        let (columns, rows) = (profile(core[u], radius, segments), profile(core[v], radius, segments));
        let corner = Vec2::new((side % 3) as f32, (side / 3) as f32);
        let first = shape.positions.len() as u32;
        for y in &rows {
            for x in &columns {
                let (mut inner, mut outward) = (Vec3::ZERO, Vec3::ZERO);
                (inner[u], inner[v], inner[w]) = (x.core, y.core, core[w] * sign);
                (outward[u], outward[v], outward[w]) = (x.tangent, y.tangent, sign);
                let normal = outward.normalize();
                shape.positions.push(centre + inner + normal * radius);
                shape.normals.push(normal);
                let at = Vec2::new(x.along, 1.0 - y.along) * (1.0 - 2.0 * MARGIN) + MARGIN;
                shape.uvs.push((corner + at) / Vec2::new(3.0, 2.0));
            }
        }
        let width = columns.len() as u32;
        for y in 1..rows.len() as u32 {
            for x in 1..width {
                let d = first + y * width + x;
                let [a, b, c] = [d - width - 1, d - width, d - 1];
                shape.triangles.extend([[a, b, d], [a, d, c]]);
            }
        }
    }
    shape
}

/// A line across a side: from the middle of one edge to the middle of the other.
struct Station {
    /// Place on the flat part.
    core: f32,
    /// Of the angle by which the normal leans outward.
    tangent: f32,
    /// Length so far: 0 to 1 over the whole line.
    along: f32,
}

fn profile(core: f32, radius: f32, segments: u32) -> Vec<Station> {
    let arc = FRAC_PI_4 * radius;
    let length = 2.0 * (core + arc);
    let bend = |k: u32| FRAC_PI_4 * k as f32 / segments as f32;
    let before = (0..=segments).map(|k| {
        let angle = bend(segments - k);
        Station { core: -core, tangent: -angle.tan(), along: arc * k as f32 / segments as f32 / length }
    });
    // On a sphere the two bends meet without a flat part.
    let first = if core > 0.0 { 0 } else { 1 };
    let after = (first..=segments).map(|k| {
        let angle = bend(k);
        Station { core, tangent: angle.tan(), along: (arc + 2.0 * core + radius * angle) / length }
    });
    before.chain(after).collect()
}

impl Shape {
    pub fn mesh(&self) -> Mesh {
        let indices = self.triangles.iter().flatten().copied().collect();
        Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, self.positions.clone())
            .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, self.normals.clone())
            .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, self.uvs.clone())
            .with_inserted_indices(Indices::U32(indices))
    }

    pub fn surface(&self) -> Surface {
        let corners = || self.triangles.iter().flatten().map(|&i| i as usize);
        Surface {
            positions: self.positions.clone(),
            triangles: self.triangles.clone(),
            normals: corners().map(|i| self.normals[i]).collect(),
            uvs: corners().map(|i| self.uvs[i]).collect(),
            ..Surface::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_and_normals_point_outward() {
        for (half, radius) in [(Vec3::new(0.4, 0.5, 0.1), 0.05), (Vec3::splat(0.4), 0.4)] {
            let shape = rounded_box(Vec3::Y, half, radius, 3);
            for triangle in &shape.triangles {
                let [a, b, c] = triangle.map(|i| shape.positions[i as usize]);
                let face = (b - a).cross(c - a);
                let outward = (a + b + c) / 3.0 - Vec3::Y;
                assert!(face.dot(outward) > 0.0, "{triangle:?} of {half}");
                for i in triangle {
                    assert!(face.normalize().dot(shape.normals[*i as usize]) > 0.9, "{triangle:?} of {half}");
                }
            }
        }
    }

    #[test]
    fn with_nothing_but_rounding_it_is_a_sphere() {
        let shape = rounded_box(Vec3::ZERO, Vec3::splat(0.4), 0.4, 6);
        assert!(shape.positions.iter().all(|p| (p.length() - 0.4).abs() < 1e-6));
    }

    #[test]
    fn it_is_as_large_as_asked_for_and_its_texture_is_used_once() {
        let half = Vec3::new(0.4, 0.5, 0.1);
        let shape = rounded_box(Vec3::ZERO, half, 0.05, 2);
        let most = shape.positions.iter().fold(Vec3::ZERO, |most, p| most.max(p.abs()));
        assert!((most - half).abs().max_element() < 1e-6, "{most}");
        assert!(shape.uvs.iter().all(|uv| uv.min_element() > 0.0 && uv.max_element() < 1.0));
        let mirrored = shape.triangles.iter().filter(|triangle| {
            let [a, b, c] = triangle.map(|i| shape.uvs[i as usize]);
            (b - a).perp_dot(c - a) > 0.0
        });
        // v runs downward: what is seen the right way round has a negative area.
        assert_eq!(mirrored.count(), 0);
    }
}
