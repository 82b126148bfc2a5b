//! Builds the fine bare metal: the prop's own surface where the film has separated or is gone, a little inwards.

use bevy_math::Vec3;

use super::{base::Base, mean_stains};
use crate::{
    appearance::{
        corners::CornerAttributes,
        face_slots::{FaceSlots, has_separated},
        part::{MeshPart, vertex_stains},
    },
    film::{FaceGrid, FaceId, FilmMesh},
    fracture::FilmForces,
    stain::StainFields,
};

/// Bare metal of all slots.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct FineMetal {
    /// Vertices and triangles of the metal in each slot: the grids of its [`faces`](Self::faces).
    pub parts: Vec<MeshPart>,
    /// Exposed faces of each slot.
    faces: Vec<Vec<FaceId>>,
}

impl FineMetal {
    /// Returns the metal under a fresh film with `slots` slots.
    pub fn new(slots: usize) -> Self {
        Self { parts: vec![MeshPart::default(); slots], faces: vec![Vec::new(); slots] }
    }

    /// Collects the exposed faces and builds their vertices again, `depth` metres under the prop's surface.
    pub fn renew(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        grid: &FaceGrid,
        base: &Base,
        depth: f32,
    ) {
        let Self { parts, faces } = self;
        let topology = &mesh.topology;
        parts.iter_mut().for_each(MeshPart::clear);
        faces.iter_mut().for_each(Vec::clear);
        let CornerAttributes { normals, uvs, uvs_1, colors, .. } = &base.attributes;
        for f in topology.all_faces() {
            let covered = topology.is_live(f) && !has_separated(topology, forces, f);
            if covered || face_slots.is_hidden(f) {
                continue;
            }
            let (slot, flipped) = (face_slots.slot(f), face_slots.is_flipped(f));
            let part = &mut parts[slot];
            faces[slot].push(f);
            let first = part.positions.len() as u32;
            for &[a, b, c] in grid.triangles() {
                let [b, c] = if flipped { [c, b] } else { [b, c] };
                part.indices.extend([first + a, first + b, first + c]);
            }
            let corners = topology.corners(f).map(|v| mesh.geometry.rest_normals[topology.original(v).index()]);
            let inwards = if flipped { depth } else { -depth };
            for (i, b) in grid.points().iter().enumerate() {
                let at = base.index(f, i);
                let normal = (corners[0] * b.x + corners[1] * b.y + corners[2] * b.z).normalize_or(corners[0]);
                part.positions.push((base.positions[at] + normal * inwards).to_array());
                part.rest.push(base.positions[at].to_array());
                part.normals.push(normals[at].to_array());
                part.uvs.extend(uvs.get(at).map(|uv| uv.to_array()));
                part.uvs_1.extend(uvs_1.get(at).map(|uv| uv.to_array()));
                part.colors.extend(colors.get(at).map(|color| color.to_array()));
                part.keys.push(at as u32);
            }
        }
        for part in parts {
            part.rest_normals.clone_from(&part.normals);
        }
    }

    /// Writes the stains of the metal.
    pub fn stain(&mut self, mesh: &FilmMesh, stains: &StainFields, grid: &FaceGrid) {
        let layer = &stains.metal;
        for (part, faces) in self.parts.iter_mut().zip(&self.faces) {
            part.stains.clear();
            for &f in faces {
                let corners = mesh.topology.corners(f).map(|v| mesh.topology.original(v).index());
                let corners = corners
                    .map(|v| vertex_stains(layer.rust(v), layer.dust[v], layer.moisture[v], stains.corrosion[v]));
                part.stains.extend(grid.points().iter().map(|&b: &Vec3| mean_stains(&corners, b)));
            }
        }
    }
}
