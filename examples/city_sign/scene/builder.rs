//! A mesh under construction: flat-shaded polygons with world-sized texture coordinates, vertex colours
//! and, for the normal maps, tangents taken from the texture coordinates.

use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;

/// One corner: position, texture coordinates, colour that multiplies the material's.
#[derive(Clone, Copy)]
pub struct Corner {
    pub position: Vec3,
    pub uv: Vec2,
    pub colour: Vec3,
}

impl Corner {
    pub fn new(position: Vec3, uv: Vec2, colour: Vec3) -> Self {
        Self { position, uv, colour }
    }
}

#[derive(Default)]
pub struct MeshBuilder {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    uvs: Vec<Vec2>,
    colours: Vec<Vec3>,
    indices: Vec<u32>,
}

impl MeshBuilder {
    pub fn vertex(&mut self, corner: Corner, normal: Vec3) -> u32 {
        self.positions.push(corner.position);
        self.normals.push(normal);
        self.uvs.push(corner.uv);
        self.colours.push(corner.colour);
        (self.positions.len() - 1) as u32
    }

    pub fn triangle(&mut self, a: u32, b: u32, c: u32) {
        self.indices.extend([a, b, c]);
    }

    /// A flat convex polygon, counter-clockwise seen from outside.
    pub fn polygon(&mut self, corners: &[Corner]) {
        let [a, b, c, ..] = corners else { return };
        let normal = (b.position - a.position).cross(c.position - a.position).normalize_or(Vec3::Y);
        let first = self.positions.len() as u32;
        for corner in corners {
            self.vertex(*corner, normal);
        }
        for i in 1..corners.len() as u32 - 1 {
            self.triangle(first, first + i, first + i + 1);
        }
    }

    /// A box of the given half size; `uv_scale` is texture repeats per metre.
    pub fn cuboid(&mut self, transform: &Transform, half: Vec3, uv_scale: f32, colour: Vec3) {
        for axis in 0..3 {
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            for side in [-1.0, 1.0] {
                let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(a, b)| {
                    let mut p = Vec3::ZERO;
                    p[axis] = half[axis] * side;
                    p[u] = half[u] * a * side;
                    p[v] = half[v] * b;
                    Corner::new(transform.transform_point(p), Vec2::new(p[u], p[v]) * uv_scale, colour)
                });
                self.polygon(&corners);
            }
        }
    }

    /// A round bar along `path`.
    pub fn tube(&mut self, path: &[Vec3], radius: f32, sides: u32, colour: Vec3) {
        let (Some(first), Some(last)) = (path.first(), path.last()) else { return };
        let helper = if (*last - *first).normalize_or(Vec3::Y).y.abs() > 0.9 { Vec3::X } else { Vec3::Y };
        let base = self.positions.len() as u32;
        let mut length = 0.0;
        for (i, &centre) in path.iter().enumerate() {
            let before = path[i.saturating_sub(1)];
            let after = path[(i + 1).min(path.len() - 1)];
            let along = (after - before).normalize_or(Vec3::Y);
            let side = along.cross(helper).normalize_or(Vec3::X);
            let up = side.cross(along);
            length += centre.distance(before);
            for s in 0..=sides {
                let (sin, cos) = (std::f32::consts::TAU * s as f32 / sides as f32).sin_cos();
                let normal = side * cos + up * sin;
                let uv = Vec2::new(s as f32 / sides as f32, length * 2.0);
                self.vertex(Corner::new(centre + normal * radius, uv, colour), normal);
            }
        }
        let ring = sides + 1;
        for i in 0..path.len() as u32 - 1 {
            for s in 0..sides {
                let a = base + i * ring + s;
                self.triangle(a, a + ring, a + 1);
                self.triangle(a + 1, a + ring, a + ring + 1);
            }
        }
    }

    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    /// `usages`: whether it can still be read later, as what shelters props must be.
    pub fn build(self, usages: RenderAssetUsages) -> Mesh {
        let tangents = self.tangents();
        let colours: Vec<[f32; 4]> = self.colours.iter().map(|c| c.extend(1.0).to_array()).collect();
        Mesh::new(PrimitiveTopology::TriangleList, usages)
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, self.positions)
            .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, self.normals)
            .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, self.uvs)
            .with_inserted_attribute(Mesh::ATTRIBUTE_COLOR, colours)
            .with_inserted_attribute(Mesh::ATTRIBUTE_TANGENT, tangents)
            .with_inserted_indices(Indices::U32(self.indices))
    }

    /// Texture directions, averaged over the triangles at each vertex. Our charts are never mirrored, so the
    /// sign is the same everywhere.
    fn tangents(&self) -> Vec<Vec4> {
        let mut sums = vec![Vec3::ZERO; self.positions.len()];
        let mut signs = vec![0.0; self.positions.len()];
        for triangle in self.indices.chunks_exact(3) {
            let [a, b, c] = [triangle[0], triangle[1], triangle[2]].map(|i| i as usize);
            let (e1, e2) = (self.positions[b] - self.positions[a], self.positions[c] - self.positions[a]);
            let (d1, d2) = (self.uvs[b] - self.uvs[a], self.uvs[c] - self.uvs[a]);
            let area = d1.perp_dot(d2);
            let along = (e1 * d2.y - e2 * d1.y) * area.signum();
            for i in [a, b, c] {
                sums[i] += along;
                signs[i] += area;
            }
        }
        let finish = |((sum, normal), sign): ((&Vec3, &Vec3), &f32)| {
            let tangent = (*sum - *normal * normal.dot(*sum)).try_normalize();
            // The texture's v runs downwards, so a chart seen the right way round has a negative area.
            tangent.unwrap_or(normal.any_orthonormal_vector()).extend(if *sign < 0.0 { 1.0 } else { -1.0 })
        };
        sums.iter().zip(&self.normals).zip(&signs).map(finish).collect()
    }
}
