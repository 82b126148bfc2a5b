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

/// Backs of all slots in one part.
#[derive(Clone, Debug, Default)]
pub(super) struct Backs {
    /// Vertices and triangles of the backs.
    pub part: MeshPart,
    /// Slot and front vertex of each back vertex: the back lies behind it.
    fronts: Vec<(usize, u32)>,
    /// Back vertex of each corner that stands for a front vertex, or [`NONE`].
    of_corner: Vec<u32>,
}

impl Backs {
    /// Collects the separated faces and builds their triangles again. Positions and normals come from
    /// [`follow`](Self::follow).
    pub fn renew(&mut self, topology: &Topology, forces: &FilmForces, face_slots: &FaceSlots, wedges: &Wedges) {
        let Self { part, fronts, of_corner } = self;
        part.clear();
        fronts.clear();
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
                    *back = fronts.len() as u32;
                    fronts.push((slot, front));
                }
                part.indices.push(*back);
            }
        }
        part.positions.resize(fronts.len(), [0.0; 3]);
        part.normals.resize(fronts.len(), [0.0; 3]);
    }

    /// Copies the stains, rest positions and rest normals of the fronts to the backs.
    pub fn stain(&mut self, fronts: &[MeshPart]) {
        let Self { part, fronts: behind, .. } = self;
        part.stains.clear();
        part.stains.extend(behind.iter().map(|&(slot, vertex)| fronts[slot].stains[vertex as usize]));
        part.rest.clear();
        part.rest.extend(behind.iter().map(|&(slot, vertex)| fronts[slot].rest[vertex as usize]));
        part.rest_normals.clear();
        part.rest_normals.extend(behind.iter().map(|&(slot, vertex)| fronts[slot].rest_normals[vertex as usize]));
    }

    /// Moves each back vertex to `thickness` metres behind its front vertex.
    pub fn follow(&mut self, fronts: &[MeshPart], thickness: f32) {
        for (i, &(slot, vertex)) in self.fronts.iter().enumerate() {
            let front = &fronts[slot];
            let normal = Vec3::from_array(front.normals[vertex as usize]);
            let position = Vec3::from_array(front.positions[vertex as usize]);
            self.part.positions[i] = (position - normal * thickness).to_array();
            self.part.normals[i] = (-normal).to_array();
        }
    }
}
