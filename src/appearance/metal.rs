//! Builds the bare metal: the faces of the film at rest where it has separated or is gone, moved a little inwards.

use super::{
    corners::CornerAttributes,
    face_slots::{FaceSlots, has_separated},
    part::{MeshPart, vertex_stains},
    wedges::Wedges,
};
use crate::{
    film::{FilmMesh, VertexId},
    fracture::FilmForces,
    stain::StainFields,
};

/// Entry of the lookup for a wedge that has no vertex yet.
const NONE: u32 = u32::MAX;

/// Bare metal of all slots.
#[derive(Clone, Debug, Default)]
pub(super) struct Metal {
    /// Vertices and triangles of the metal in each slot.
    pub parts: Vec<MeshPart>,
    /// Metal vertex of each wedge at rest, or [`NONE`].
    of_wedge: Vec<u32>,
    /// Original film vertex above each metal vertex of each slot.
    originals: Vec<Vec<VertexId>>,
}

impl Metal {
    /// Returns the metal under a fresh film with `slots` slots.
    pub fn new(slots: usize) -> Self {
        Self { parts: vec![MeshPart::default(); slots], of_wedge: Vec::new(), originals: vec![Vec::new(); slots] }
    }

    /// Collects the exposed faces and builds their vertices again, `depth` metres under the film at rest.
    pub fn renew(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        wedges: &Wedges,
        attributes: &CornerAttributes,
        depth: f32,
    ) {
        let Self { parts, of_wedge, originals } = self;
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        parts.iter_mut().for_each(MeshPart::clear);
        originals.iter_mut().for_each(Vec::clear);
        of_wedge.clear();
        of_wedge.resize(wedges.rest_count(), NONE);
        for f in topology.all_faces() {
            let covered = topology.is_live(f) && !has_separated(topology, forces, f);
            if covered || face_slots.is_hidden(f) {
                continue;
            }
            let slot = face_slots.slot(f);
            let (part, originals) = (&mut parts[slot], &mut originals[slot]);
            for h in face_slots.corners(f) {
                let vertex = &mut of_wedge[wedges.at_rest(h) as usize];
                if *vertex == NONE {
                    *vertex = part.positions.len() as u32;
                    let original = topology.original(topology.origin(h));
                    let v = original.index();
                    originals.push(original);
                    part.keys.push(h.0);
                    part.rest.push(geometry.rest_positions[v].to_array());
                    part.rest_normals.push(attributes.normals[h.index()].to_array());
                    let outwards = if face_slots.is_flipped(f) { depth } else { -depth };
                    let position = geometry.rest_positions[v] + geometry.rest_normals[v] * outwards;
                    part.positions.push(position.to_array());
                    part.normals.push(attributes.normals[h.index()].to_array());
                    part.uvs.extend(attributes.uvs.get(h.index()).map(|uv| uv.to_array()));
                    part.uvs_1.extend(attributes.uvs_1.get(h.index()).map(|uv| uv.to_array()));
                    part.colors.extend(attributes.colors.get(h.index()).map(|color| color.to_array()));
                }
                part.indices.push(*vertex);
            }
        }
    }

    /// Writes the stains of the metal under each vertex.
    pub fn stain(&mut self, stains: &StainFields) {
        let layer = &stains.metal;
        for (part, originals) in self.parts.iter_mut().zip(&self.originals) {
            part.stains.clear();
            part.stains.extend(
                originals
                    .iter()
                    .map(|v| v.index())
                    .map(|v| vertex_stains(layer.rust(v), layer.dust[v], layer.moisture[v], stains.corrosion[v])),
            );
        }
    }
}
