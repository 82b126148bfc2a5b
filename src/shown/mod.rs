//! What is shown of a film, as plain arrays: the film wearing the prop's surface, the backs of its flakes and the
//! bare metal beneath.
//!
//! | part | holds | moves |
//! |---|---|---|
//! | [`ShownFilm::front`] | all live faces, with the prop's own corner attributes | with the film |
//! | [`ShownFilm::backs`] | live faces that have separated, seen from behind | with the film |
//! | [`ShownFilm::metal`] | faces that have separated or are gone, at rest, just under the film | never |
//!
//! A face has separated when any of its vertices has. Faces that are still attached have neither back nor metal, so
//! a fresh film looks exactly like the prop that it was made of. The same arrays serve the plugin's meshes and baked
//! models.

mod corners;
mod normals;
mod part;
#[cfg(test)]
mod tests;
mod wedges;

use bevy_math::Vec3;

pub use corners::CornerAttributes;
pub use part::ShownPart;

use crate::{
    film::{FaceId, FilmMesh, HalfEdgeId, Topology, build::BuiltFilm, build::Surface},
    fracture::FilmForces,
};
use normals::CornerFrames;
use wedges::Wedges;

/// Thickness of the paint, in mean edges: how far a flake's back lies behind its front.
pub const FILM_THICKNESS: f32 = 0.01;
/// How far the metal lies under the film at rest, in mean edges: more than the thickness, so that it never shows
/// through the back of a flake that has only just let go.
pub const METAL_DEPTH: f32 = 0.02;

/// What [`ShownFilm::update`] changed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ShownChange {
    /// Vertices of fronts and backs were added or renumbered, and their indices rewritten; else only positions,
    /// normals and tangents were.
    pub topology: bool,
    /// Other faces than before show their backs or the metal under them.
    pub exposure: bool,
}

/// The shown parts of one film, and what is needed to bring them up to date.
#[derive(Clone, Debug)]
pub struct ShownFilm {
    attributes: CornerAttributes,
    slots: Vec<u32>,
    flipped: Vec<bool>,
    frames: CornerFrames,
    wedges: Wedges,
    fronts: Vec<ShownPart>,
    backs: ShownPart,
    metal: ShownPart,
    seen: Option<Seen>,
}

/// The film's state at the last update, as far as it matters to connectivity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Seen {
    vertices: usize,
    torn: u32,
    removed: usize,
    separated: usize,
}

impl ShownFilm {
    /// The shown parts of the film of `built`, which was made of `surface`, in the state of `mesh` and `forces`.
    pub fn new(built: &BuiltFilm, surface: &Surface, mesh: &FilmMesh, forces: &FilmForces) -> Self {
        let attributes = CornerAttributes::sample(built, surface, mesh);
        let faces = mesh.topology.face_count();
        let mut slots = built.slots.clone();
        slots.resize(faces, 0);
        let mut flipped = built.flipped.clone();
        flipped.resize(faces, false);
        let slot_count = slots.iter().max().map_or(0, |&slot| slot as usize + 1);
        let mut shown = Self {
            frames: CornerFrames::new(mesh),
            wedges: Wedges::new(mesh, &attributes, &slots),
            attributes,
            slots,
            flipped,
            fronts: vec![ShownPart::default(); slot_count],
            backs: ShownPart::default(),
            metal: ShownPart::default(),
            seen: None,
        };
        shown.update(mesh, forces);
        shown
    }

    /// Number of slots: primitives, each with a material of its own.
    pub fn slot_count(&self) -> usize {
        self.fronts.len()
    }

    /// The film of one slot; `None` for a slot that no face has.
    pub fn front(&self, slot: usize) -> Option<&ShownPart> {
        self.fronts.get(slot)
    }

    /// The backs of the flakes of all slots: positions and normals only.
    pub fn backs(&self) -> &ShownPart {
        &self.backs
    }

    /// The bare metal of all slots, with first texture coordinates where the prop has some.
    pub fn metal(&self) -> &ShownPart {
        &self.metal
    }

    /// Brings the parts up to date with the film.
    pub fn update(&mut self, mesh: &FilmMesh, forces: &FilmForces) -> ShownChange {
        let topology = &mesh.topology;
        let seen = Seen {
            vertices: topology.vertex_count(),
            torn: forces.torn_edges,
            removed: topology.face_count() - topology.live_faces().count(),
            separated: topology.all_vertices().filter(|&v| !forces.is_attached(v)).count(),
        };
        let topology_changed = self
            .seen
            .is_none_or(|old| (old.vertices, old.torn, old.removed) != (seen.vertices, seen.torn, seen.removed));
        let exposure_changed =
            self.seen.is_none_or(|old| (old.removed, old.separated) != (seen.removed, seen.separated));
        self.seen = Some(seen);
        if topology_changed {
            self.wedges.renew(topology, &self.slots);
            self.write_front_attributes();
            self.write_front_indices(topology);
        }
        self.frames.turn_faces(mesh);
        self.write_front_frames(mesh);
        if topology_changed || exposure_changed {
            self.write_back_indices(topology, forces);
        }
        self.write_back_frames(mesh.geometry.mean_edge * FILM_THICKNESS);
        if exposure_changed {
            self.write_metal(mesh, forces);
        }
        ShownChange { topology: topology_changed, exposure: exposure_changed }
    }

    /// The corners of a face in the order in which it is shown: that of the prop's own triangle.
    fn shown_corners(&self, f: FaceId) -> [HalfEdgeId; 3] {
        let [a, b, c] = f.half_edges();
        if self.flipped[f.index()] { [a, c, b] } else { [a, b, c] }
    }

    fn write_front_attributes(&mut self) {
        for (slot, part) in self.fronts.iter_mut().enumerate() {
            let corners = self.wedges.corners(slot);
            let count = corners.len();
            part.positions.resize(count, [0.0; 3]);
            part.normals.resize(count, [0.0; 3]);
            part.tangents.resize(if self.attributes.tangents.is_empty() { 0 } else { count }, [0.0; 4]);
            copy(&mut part.uvs, &self.attributes.uvs, corners);
            copy(&mut part.uvs_1, &self.attributes.uvs_1, corners);
            copy(&mut part.colors, &self.attributes.colors, corners);
        }
    }

    fn write_front_indices(&mut self, topology: &Topology) {
        for part in &mut self.fronts {
            part.indices.clear();
        }
        for f in topology.live_faces() {
            let corners = self.shown_corners(f).map(|h| self.wedges.vertex_of(h));
            if let Some(part) = self.fronts.get_mut(self.slots[f.index()] as usize) {
                part.indices.extend(corners);
            }
        }
    }

    fn write_front_frames(&mut self, mesh: &FilmMesh) {
        for (slot, part) in self.fronts.iter_mut().enumerate() {
            for (i, &h) in self.wedges.corners(slot).iter().enumerate() {
                let v = mesh.topology.origin(h);
                part.positions[i] = mesh.geometry.positions[v.index()].to_array();
                let normal = self.frames.normal(&mesh.topology, &self.attributes, h);
                part.normals[i] = normal.to_array();
                if let Some(tangent) = part.tangents.get_mut(i) {
                    *tangent = self.frames.tangent(&mesh.topology, &self.attributes, h, normal).to_array();
                }
            }
        }
    }

    fn write_back_indices(&mut self, topology: &Topology, forces: &FilmForces) {
        self.backs.indices.clear();
        self.wedges.backs.clear();
        self.wedges.back_of.clear();
        self.wedges.back_of.resize(topology.half_edge_count(), u32::MAX);
        for f in topology.live_faces().filter(|&f| has_separated(topology, forces, f)) {
            let [a, b, c] = self.shown_corners(f);
            for h in [a, c, b] {
                // One back vertex for each front vertex, found through the corner that stands for it.
                let slot = self.slots[f.index()] as usize;
                let front = self.wedges.vertex_of(h);
                let stands = self.wedges.corners(slot)[front as usize];
                let back = &mut self.wedges.back_of[stands.index()];
                if *back == u32::MAX {
                    *back = self.wedges.backs.len() as u32;
                    self.wedges.backs.push((slot as u32, front));
                }
                self.backs.indices.push(*back);
            }
        }
        self.backs.positions.resize(self.wedges.backs.len(), [0.0; 3]);
        self.backs.normals.resize(self.wedges.backs.len(), [0.0; 3]);
    }

    fn write_back_frames(&mut self, thickness: f32) {
        for (i, &(slot, front)) in self.wedges.backs.iter().enumerate() {
            let part = &self.fronts[slot as usize];
            let normal = Vec3::from_array(part.normals[front as usize]);
            let position = Vec3::from_array(part.positions[front as usize]);
            self.backs.positions[i] = (position - normal * thickness).to_array();
            self.backs.normals[i] = (-normal).to_array();
        }
    }

    fn write_metal(&mut self, mesh: &FilmMesh, forces: &FilmForces) {
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        let depth = geometry.mean_edge * METAL_DEPTH;
        self.metal.clear();
        self.wedges.metal_of.clear();
        self.wedges.metal_of.resize(self.wedges.rest_count(), u32::MAX);
        for f in topology.all_faces() {
            if topology.is_live(f) && !has_separated(topology, forces, f) {
                continue;
            }
            for h in self.shown_corners(f) {
                let index = &mut self.wedges.metal_of[self.wedges.rest[h.index()] as usize];
                if *index == u32::MAX {
                    *index = self.metal.positions.len() as u32;
                    let v = topology.original(topology.origin(h)).index();
                    let inwards = if self.flipped[f.index()] { depth } else { -depth };
                    let position = geometry.rest_positions[v] + geometry.rest_normals[v] * inwards;
                    self.metal.positions.push(position.to_array());
                    self.metal.normals.push(self.attributes.normals[h.index()].to_array());
                    if let Some(uv) = self.attributes.uvs.get(h.index()) {
                        self.metal.uvs.push(uv.to_array());
                    }
                }
                self.metal.indices.push(*index);
            }
        }
    }
}

/// Whether any vertex of `f` has separated.
fn has_separated(topology: &Topology, forces: &FilmForces, f: FaceId) -> bool {
    topology.corners(f).iter().any(|&v| !forces.is_attached(v))
}

/// Rewrites `to` with the attribute at each of `corners`; empties it if the prop does not have the attribute.
fn copy<T: Copy + Into<[f32; N]>, const N: usize>(to: &mut Vec<[f32; N]>, from: &[T], corners: &[HalfEdgeId]) {
    to.clear();
    if !from.is_empty() {
        to.extend(corners.iter().map(|h| from[h.index()].into()));
    }
}
