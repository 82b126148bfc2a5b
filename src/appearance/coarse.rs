//! The film shown as it is simulated: its own triangles.

use super::{
    FILM_THICKNESS, METAL_DEPTH,
    backs::Backs,
    changes::DisplayChanges,
    corners::CornerAttributes,
    face_slots::FaceSlots,
    metal::Metal,
    moves::Moves,
    normals::CornerFrames,
    part::{MeshPart, vertex_stains},
    wedges::Wedges,
};
use crate::{
    film::{FilmMesh, HalfEdgeId, Topology},
    fracture::FilmForces,
    stain::StainFields,
};

/// Fronts, backs and metal of one film, and the lookups that bring them up to date.
#[derive(Clone, Debug)]
pub(super) struct CoarseSurface {
    attributes: CornerAttributes,
    frames: CornerFrames,
    wedges: Wedges,
    moves: Moves,
    pub fronts: Vec<MeshPart>,
    pub backs: Backs,
    pub metal: Metal,
}

impl CoarseSurface {
    /// Builds the parts of a film at rest. The first [`update`](Self::update) must be one of everything.
    pub fn new(mesh: &FilmMesh, attributes: CornerAttributes, face_slots: &FaceSlots) -> Self {
        let slots = face_slots.slot_count();
        Self {
            frames: CornerFrames::new(mesh, &attributes),
            wedges: Wedges::new(mesh, &attributes, face_slots),
            moves: Moves::default(),
            fronts: vec![MeshPart::default(); slots],
            backs: Backs::new(slots),
            metal: Metal::new(slots),
            attributes,
        }
    }

    /// Brings the parts up to date with the film, which has undergone `changes` since the last update.
    pub fn update(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        stains: &StainFields,
        face_slots: &FaceSlots,
        changes: DisplayChanges,
    ) {
        let DisplayChanges { topology: tore, exposure: exposed, stains: stained, .. } = changes;
        let topology = &mesh.topology;
        if tore {
            self.wedges.renew(topology, face_slots);
            self.write_front_attributes(mesh);
            self.write_front_indices(topology, face_slots);
        }
        // What is new or has new neighbours is looked at like what moved.
        let moved = (changes.moved || tore) && self.moves.follow(mesh, tore);
        if moved {
            self.frames.turn_faces(mesh, &self.attributes, &self.moves);
            self.frames.add_up(topology, &self.moves);
            self.write_front_frames(mesh);
        }
        if tore || exposed {
            self.backs.renew(topology, forces, face_slots, &self.wedges, &self.fronts);
        }
        if moved || tore || exposed {
            self.backs.follow(&self.fronts, mesh.geometry.mean_edge * FILM_THICKNESS);
        }
        if exposed {
            let depth = mesh.geometry.mean_edge * METAL_DEPTH;
            self.metal.renew(mesh, forces, face_slots, &self.wedges, &self.attributes, depth);
        }
        if tore || stained {
            self.write_front_stains(topology, stains);
        }
        if tore || exposed || stained {
            self.backs.stain(&self.fronts);
        }
        if exposed || stained {
            self.metal.stain(stains);
        }
    }

    /// Resizes the front parts and copies the attributes that do not change as the film moves.
    fn write_front_attributes(&mut self, mesh: &FilmMesh) {
        for (slot, part) in self.fronts.iter_mut().enumerate() {
            let corners = self.wedges.corners(slot);
            let count = corners.len();
            part.positions.resize(count, [0.0; 3]);
            part.normals.resize(count, [0.0; 3]);
            part.tangents.resize(if self.attributes.tangents.is_empty() { 0 } else { count }, [0.0; 4]);
            copy(&mut part.uvs, &self.attributes.uvs, corners);
            copy(&mut part.uvs_1, &self.attributes.uvs_1, corners);
            copy(&mut part.colors, &self.attributes.colors, corners);
            let rest = |&h| mesh.geometry.rest_positions[mesh.topology.origin(h).index()].to_array();
            part.keys.clear();
            part.keys.extend(corners.iter().map(|h| h.0));
            part.rest.clear();
            part.rest.extend(corners.iter().map(rest));
            copy(&mut part.rest_normals, &self.attributes.normals, corners);
        }
    }

    /// Writes the stains of every front vertex.
    fn write_front_stains(&mut self, topology: &Topology, stains: &StainFields) {
        for (slot, part) in self.fronts.iter_mut().enumerate() {
            part.stains.clear();
            part.stains.extend(self.wedges.corners(slot).iter().map(|&h| {
                let v = topology.origin(h);
                let (film, metal) = (v.index(), topology.original(v).index());
                let layer = &stains.film;
                vertex_stains(layer.rust(film), layer.dust[film], layer.moisture[film], stains.corrosion[metal])
            }));
        }
    }

    /// Writes the triangles of the front parts.
    fn write_front_indices(&mut self, topology: &Topology, face_slots: &FaceSlots) {
        for part in &mut self.fronts {
            part.indices.clear();
        }
        for f in topology.live_faces().filter(|&f| !face_slots.is_hidden(f)) {
            let corners = face_slots.corners(f).map(|h| self.wedges.vertex_of(h));
            if let Some(part) = self.fronts.get_mut(face_slots.slot(f)) {
                part.indices.extend(corners);
            }
        }
    }

    /// Writes positions, normals and tangents of the front vertices whose faces moved.
    fn write_front_frames(&mut self, mesh: &FilmMesh) {
        let Self { fronts, wedges, frames, attributes, moves, .. } = self;
        for (slot, part) in fronts.iter_mut().enumerate() {
            for (i, &h) in wedges.corners(slot).iter().enumerate() {
                let v = mesh.topology.origin(h);
                if !moves.is_turned(v) {
                    continue;
                }
                part.positions[i] = mesh.geometry.positions[v.index()].to_array();
                let normal = frames.normal(&mesh.topology, attributes, h);
                part.normals[i] = normal.to_array();
                if let Some(tangent) = part.tangents.get_mut(i) {
                    *tangent = frames.tangent(&mesh.topology, attributes, h, normal).to_array();
                }
            }
        }
    }
}

/// Fills `to` with the attribute at each of `corners`; leaves it empty if the prop does not have the attribute.
fn copy<T: Copy + Into<[f32; N]>, const N: usize>(to: &mut Vec<[f32; N]>, from: &[T], corners: &[HalfEdgeId]) {
    to.clear();
    if !from.is_empty() {
        to.extend(corners.iter().map(|h| from[h.index()].into()));
    }
}
