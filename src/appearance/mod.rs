//! Turns a film into the meshes that are drawn, as plain arrays: the front of the paint, the backs of its flakes, and
//! the bare metal under it.
//!
//! | part | triangles | moves |
//! |---|---|---|
//! | [`FilmAppearance::front`] | all faces that are left, with the prop's own attributes at their corners | with the
//! film |
//! | [`FilmAppearance::backs`] | faces that are left and have separated, seen from behind | with the film |
//! | [`FilmAppearance::metal`] | faces that have separated or are gone, at rest, just under the film | never |
//!
//! A face has separated when any of its vertices has. Faces that are still attached have neither back nor metal, so
//! a fresh film looks exactly like the prop that it was made of. Each slot, which is a primitive of the prop with a
//! material of its own, has its own front, backs and metal. The plugin's meshes and baked models are made of the
//! same arrays. Colours, roughness and relief of stained surfaces are computed in [`shading`].
//!
//! ```
//! use bevy_coating::{
//!     appearance::FilmAppearance, remesh::sample, settings::CoatingSettings, sim::FilmState, stain::Environment,
//! };
//!
//! let (piece, settings) = (sample::plate(200, 1)?, CoatingSettings::default());
//! let mut film = FilmState::new(&piece.film, &settings, 0, 100).ok_or("an empty film")?;
//! let fresh = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
//! assert_eq!(fresh.slot_count(), 1, "the plate is one primitive");
//! assert!(fresh.metal(0).is_some_and(|metal| metal.is_empty()), "fresh paint hides the metal");
//!
//! film.age_to(1.0, &settings, &Environment::default());
//! let aged = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
//! assert!(aged.metal(0).is_some_and(|metal| !metal.is_empty()), "aged paint has separated");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod backs;
mod changes;
mod corners;
mod face_slots;
mod in_slots;
mod metal;
mod moves;
mod normals;
mod part;
pub mod shading;
#[cfg(test)]
mod tests;
mod wedges;

pub use changes::DisplayChanges;
pub use corners::CornerAttributes;
pub use part::MeshPart;

use crate::{
    film::{FilmMesh, HalfEdgeId, Topology},
    fracture::FilmForces,
    remesh::BuiltFilm,
    stain::StainFields,
    surface::Surface,
};
use backs::Backs;
use face_slots::FaceSlots;
use metal::Metal;
use moves::Moves;
use normals::CornerFrames;
use part::vertex_stains;
use wedges::Wedges;

/// Distance between a flake's front and its back, the thickness of the paint, in mean edge lengths of the film.
pub const FILM_THICKNESS: f32 = 0.01;
/// Depth of the bare metal under the film at rest, in mean edge lengths of the film. It is more than
/// [`FILM_THICKNESS`], so that the metal does not show through the back of a flake that has only just separated.
pub const METAL_DEPTH: f32 = 0.02;

/// Front, backs and bare metal of one film as [`MeshPart`]s, and the lookups that bring them up to date.
///
/// The module's page has an [example](self).
#[derive(Clone, Debug)]
pub struct FilmAppearance {
    attributes: CornerAttributes,
    face_slots: FaceSlots,
    frames: CornerFrames,
    wedges: Wedges,
    moves: Moves,
    fronts: Vec<MeshPart>,
    backs: Backs,
    metal: Metal,
    /// [`DisplayChanges::epoch`] of the state that the parts show.
    epoch: u32,
}

impl FilmAppearance {
    /// Builds the parts of a film in the state of `mesh`, `forces` and `stains`. `built` is the film at rest that this
    /// state began with, and `surface` the prop's surface that `built` was made of.
    pub fn new(
        built: &BuiltFilm,
        surface: &Surface,
        mesh: &FilmMesh,
        forces: &FilmForces,
        stains: &StainFields,
    ) -> Self {
        let attributes = CornerAttributes::sample(built, surface, mesh);
        let face_slots = FaceSlots::new(built, mesh.topology.face_count());
        let mut appearance = Self {
            frames: CornerFrames::new(mesh, &attributes),
            wedges: Wedges::new(mesh, &attributes, &face_slots),
            moves: Moves::default(),
            fronts: vec![MeshPart::default(); face_slots.slot_count()],
            backs: Backs::new(face_slots.slot_count()),
            metal: Metal::new(face_slots.slot_count()),
            attributes,
            face_slots,
            epoch: 0,
        };
        appearance.update(mesh, forces, stains, DisplayChanges::everything());
        appearance
    }

    /// Returns the number of slots. Each primitive of the prop is a slot and has a material of its own.
    pub fn slot_count(&self) -> usize {
        self.fronts.len()
    }

    /// Returns the front of the paint in one slot; `None` if `slot` is not below [`slot_count`](Self::slot_count).
    pub fn front(&self, slot: usize) -> Option<&MeshPart> {
        self.fronts.get(slot)
    }

    /// Returns the backs of the flakes in one slot, without tangents; `None` if `slot` is not below
    /// [`slot_count`](Self::slot_count).
    pub fn backs(&self, slot: usize) -> Option<&MeshPart> {
        self.backs.parts.get(slot)
    }

    /// Returns the bare metal in one slot, without tangents; `None` if `slot` is not below
    /// [`slot_count`](Self::slot_count).
    pub fn metal(&self, slot: usize) -> Option<&MeshPart> {
        self.metal.parts.get(slot)
    }

    /// Hides slot `slot` for good: its faces have no front, no back and no metal from the next update on, which must
    /// count as a change of everything.
    pub fn hide_slot(&mut self, slot: usize) {
        self.face_slots.hide(slot);
    }

    /// Returns whether each face is in a slot that is [hidden](Self::hide_slot).
    pub fn hidden_faces(&self) -> Vec<bool> {
        self.face_slots.hidden_faces()
    }

    /// Brings the parts up to date with the film, which has undergone `changes` since the last update.
    ///
    /// `changes` of another [epoch](DisplayChanges::epoch) than the last update's count as a change of everything.
    pub fn update(&mut self, mesh: &FilmMesh, forces: &FilmForces, stains: &StainFields, changes: DisplayChanges) {
        let replaced = std::mem::replace(&mut self.epoch, changes.epoch) != changes.epoch;
        let changes = if replaced { DisplayChanges::everything() } else { changes };
        let DisplayChanges { topology: tore, exposure: exposed, stains: stained, .. } = changes;
        let topology = &mesh.topology;
        if tore {
            self.wedges.renew(topology, &self.face_slots);
            self.write_front_attributes(mesh);
            self.write_front_indices(topology);
        }
        // What is new or has new neighbours is looked at like what moved.
        let moved = (changes.moved || tore) && self.moves.follow(mesh, tore);
        if moved {
            self.frames.turn_faces(mesh, &self.attributes, &self.moves);
            self.frames.add_up(topology, &self.moves);
            self.write_front_frames(mesh);
        }
        if tore || exposed {
            self.backs.renew(topology, forces, &self.face_slots, &self.wedges, &self.fronts);
        }
        if moved || tore || exposed {
            self.backs.follow(&self.fronts, mesh.geometry.mean_edge * FILM_THICKNESS);
        }
        if exposed {
            let depth = mesh.geometry.mean_edge * METAL_DEPTH;
            self.metal.renew(mesh, forces, &self.face_slots, &self.wedges, &self.attributes, depth);
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
            part.corners.clear();
            part.corners.extend_from_slice(corners);
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
    fn write_front_indices(&mut self, topology: &Topology) {
        for part in &mut self.fronts {
            part.indices.clear();
        }
        for f in topology.live_faces().filter(|&f| !self.face_slots.is_hidden(f)) {
            let corners = self.face_slots.corners(f).map(|h| self.wedges.vertex_of(h));
            if let Some(part) = self.fronts.get_mut(self.face_slots.slot(f)) {
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
