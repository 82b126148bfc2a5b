//! Builds the backs of the flakes: the separated faces, wound the other way, one thickness of paint behind their
//! fronts.

use bevy_math::Vec3;

use super::{
    face_slots::{FaceSlots, has_separated},
    part::MeshPart,
    wedges::Wedges,
};
use crate::{
    film::{FaceId, Topology},
    fracture::FilmForces,
};

/// Entry of the lookup for a corner that has no back vertex yet.
const NONE: u32 = u32::MAX;

/// Backs of all slots.
#[derive(Clone, Debug, Default)]
pub(super) struct Backs {
    /// Vertices and triangles of the backs in each slot.
    pub parts: Vec<MeshPart>,
    /// Front vertex of each back vertex of each slot: the back lies behind it.
    fronts: Vec<Vec<u32>>,
    /// Back vertex of each corner that stands for a front vertex, or [`NONE`].
    of_corner: Vec<u32>,
}

impl Backs {
    /// Returns the backs of a fresh film with `slots` slots.
    pub fn new(slots: usize) -> Self {
        Self { parts: vec![MeshPart::default(); slots], fronts: vec![Vec::new(); slots], of_corner: Vec::new() }
    }

    /// Collects the separated faces and builds their triangles again, with the texture coordinates and colours of
    /// `fronts`. Positions and normals come from [`follow`](Self::follow).
    pub fn renew(
        &mut self,
        topology: &Topology,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        wedges: &Wedges,
        fronts: &[MeshPart],
    ) {
        let Self { parts, fronts: behind, of_corner } = self;
        parts.iter_mut().for_each(MeshPart::clear);
        behind.iter_mut().for_each(Vec::clear);
        of_corner.clear();
        of_corner.resize(topology.half_edge_count(), NONE);
        let is_shown = |f: &FaceId| !face_slots.is_hidden(*f) && has_separated(topology, forces, *f);
        for f in topology.live_faces().filter(is_shown) {
            let slot = face_slots.slot(f);
            let [a, b, c] = face_slots.corners(f);
            for h in [a, c, b] {
                let front = wedges.vertex_of(h);
                let back = &mut of_corner[wedges.corners(slot)[front as usize].index()];
                if *back == NONE {
                    *back = behind[slot].len() as u32;
                    behind[slot].push(front);
                }
                parts[slot].indices.push(*back);
            }
        }
        for ((part, behind), front) in parts.iter_mut().zip(behind).zip(fronts) {
            part.positions.resize(behind.len(), [0.0; 3]);
            part.normals.resize(behind.len(), [0.0; 3]);
            gather(&mut part.keys, &front.keys, behind);
            gather(&mut part.uvs, &front.uvs, behind);
            gather(&mut part.uvs_1, &front.uvs_1, behind);
            gather(&mut part.colors, &front.colors, behind);
        }
    }

    /// Copies the stains, rest positions and rest normals of the fronts to the backs.
    pub fn stain(&mut self, fronts: &[MeshPart]) {
        for ((part, behind), front) in self.parts.iter_mut().zip(&self.fronts).zip(fronts) {
            gather(&mut part.stains, &front.stains, behind);
            gather(&mut part.rest, &front.rest, behind);
            gather(&mut part.rest_normals, &front.rest_normals, behind);
        }
    }

    /// Moves each back vertex to `thickness` metres behind its front vertex.
    pub fn follow(&mut self, fronts: &[MeshPart], thickness: f32) {
        for ((part, behind), front) in self.parts.iter_mut().zip(&self.fronts).zip(fronts) {
            for (i, &vertex) in behind.iter().enumerate() {
                let normal = Vec3::from_array(front.normals[vertex as usize]);
                let position = Vec3::from_array(front.positions[vertex as usize]);
                part.positions[i] = (position - normal * thickness).to_array();
                part.normals[i] = (-normal).to_array();
            }
        }
    }
}

/// Fills `to` with the values of the vertices `behind`; leaves it empty where the front has no values.
pub(super) fn gather<T: Copy>(to: &mut Vec<T>, from: &[T], behind: &[u32]) {
    to.clear();
    to.extend(behind.iter().filter_map(|&vertex| from.get(vertex as usize)));
}
