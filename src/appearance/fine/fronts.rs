//! Builds the fine fronts: the grids of all faces, bent with the film and chipped where it has torn.

use super::{
    base::{Base, Place},
    lanes::{AtRest, Bend, LANES, collect, spread},
    mean_stains,
    outline::Outlines,
    patch::Patch,
    vertex_frames::VertexFrames,
};
use crate::{
    appearance::{
        blocks::Blocks, corners::CornerAttributes, face_slots::FaceSlots, part::MeshPart, part_changes::PartChanges,
        seen::Seen,
    },
    film::{FaceId, FilmMesh},
};

/// Fronts of all slots.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct FineFronts {
    /// Vertices and triangles of the front of each slot.
    pub parts: Vec<MeshPart>,
    pub changes: Vec<PartChanges>,
    pub(super) outlines: Outlines,
    /// First vertex of each face in the part of its slot.
    pub(super) first: Vec<u32>,
    /// Place of each face's triangles.
    blocks: Blocks,
    /// Faces that were chipped otherwise, moved, and stained otherwise in the last update.
    pub(super) chipped: Vec<FaceId>,
    pub(super) bent: Vec<FaceId>,
    pub(super) stained: Vec<FaceId>,
}

/// Face with what is needed to place its points.
struct Shape {
    patch: Patch,
    corners: [usize; 3],
    /// Whether the face lies as at rest.
    still: bool,
}

impl FineFronts {
    /// Gives every face its vertices, at rest and without triangles.
    pub fn new(mesh: &FilmMesh, face_slots: &FaceSlots, base: &Base, amplitude: f32) -> Self {
        let slots = face_slots.slot_count();
        let mut fronts = Self {
            parts: vec![MeshPart::default(); slots],
            changes: vec![PartChanges::default(); slots],
            outlines: Outlines::new(mesh, base, amplitude),
            first: Vec::with_capacity(mesh.topology.face_count()),
            blocks: Blocks::new(0, base.grid.triangles().len()),
            ..Self::default()
        };
        let CornerAttributes { normals, uvs, uvs_1, tangents, colors } = &base.attributes;
        for f in mesh.topology.all_faces() {
            let part = &mut fronts.parts[face_slots.slot(f)];
            fronts.first.push(part.positions.len() as u32);
            let range = base.index(f, 0)..base.index(f, base.points);
            copy(&mut part.positions, &base.positions, range.clone());
            copy(&mut part.normals, normals, range.clone());
            copy(&mut part.uvs, uvs, range.clone());
            copy(&mut part.uvs_1, uvs_1, range.clone());
            copy(&mut part.tangents, tangents, range.clone());
            copy(&mut part.colors, colors, range);
        }
        for part in &mut fronts.parts {
            part.rest.clone_from(&part.positions);
            part.rest_normals.clone_from(&part.normals);
            part.stains.resize(part.positions.len(), [0.0; 4]);
        }
        fronts
    }

    /// Brings the fronts up to date with what is different about the film.
    pub(super) fn update(
        &mut self,
        mesh: &FilmMesh,
        face_slots: &FaceSlots,
        base: &Base,
        frames: &VertexFrames,
        seen: &Seen,
    ) {
        self.changes.iter_mut().for_each(|changes| changes.begin(seen.differences.whole));
        self.chip(mesh, face_slots, base, seen);
        self.renew_triangles(mesh, face_slots, base, seen);
        self.bent.clear();
        if seen.moved {
            let is_turned = |f: &FaceId| mesh.topology.corners(*f).iter().any(|&v| seen.moves.is_turned(v));
            self.bent.extend(mesh.topology.live_faces().filter(is_turned));
            self.bend(mesh, face_slots, base, frames);
        }
        self.stain(mesh, face_slots, base, seen);
    }

    /// Returns the vertices of `f` in the part of its slot.
    pub(super) fn vertices_of(&self, base: &Base, f: FaceId) -> std::ops::Range<usize> {
        let first = self.first[f.index()] as usize;
        first..first + base.points
    }

    /// Shapes the outlines of faces at edges that have torn.
    fn chip(&mut self, mesh: &FilmMesh, face_slots: &FaceSlots, base: &Base, seen: &Seen) {
        let Self { parts, changes, outlines, first, chipped, .. } = self;
        chipped.clear();
        if seen.differences.whole {
            chipped.extend(mesh.topology.live_faces());
        } else {
            chipped.extend(seen.differences.tears.iter().map(|h| h.face()).filter(|&f| mesh.topology.is_live(f)));
        }
        chipped.retain(|&f| outlines.has_torn(mesh, f));
        for &f in chipped.iter() {
            let (slot, first) = (face_slots.slot(f), first[f.index()] as usize);
            outlines.shape(mesh, base, f, |i, place| put(&mut parts[slot], first + i, place));
            changes[slot].renewed.add(first..first + base.points);
        }
    }

    /// Adds and removes triangles.
    fn renew_triangles(&mut self, mesh: &FilmMesh, face_slots: &FaceSlots, base: &Base, seen: &Seen) {
        let Self { parts, changes, blocks, first, .. } = self;
        if seen.differences.whole {
            parts.iter_mut().for_each(|part| part.indices.clear());
            blocks.clear(mesh.topology.face_count(), parts.len());
            for f in mesh.topology.live_faces().filter(|&f| !face_slots.is_hidden(f)) {
                let slot = face_slots.slot(f);
                let index = blocks.take(f.index(), slot, &mut parts[slot]).index;
                base.put_triangles(&mut parts[slot], first[f.index()], index, face_slots.is_flipped(f));
            }
        }
        for &f in &seen.differences.gone {
            let slot = face_slots.slot(f);
            if let Some(block) = blocks.release(f.index(), slot, &mut parts[slot]) {
                changes[slot].indices.add(blocks.indices_of(block));
            }
        }
    }

    /// Writes positions, normals and tangents of the faces with a corner that moved or turned.
    fn bend(&mut self, mesh: &FilmMesh, face_slots: &FaceSlots, base: &Base, frames: &VertexFrames) {
        let Self { parts, changes, outlines, first, bent, .. } = self;
        for &f in bent.iter() {
            let shape = shape(mesh, frames, f);
            let (slot, first) = (face_slots.slot(f), first[f.index()] as usize);
            let part = &mut parts[slot];
            changes[slot].moved.add(first..first + base.points);
            if shape.still {
                for i in 0..base.points {
                    let to = first + i;
                    part.positions[to] = part.rest[to];
                    part.normals[to] = part.rest_normals[to];
                    if let Some(tangent) = part.tangents.get_mut(to) {
                        *tangent = base.attributes.tangents[base.index(f, i)].to_array();
                    }
                }
                continue;
            }
            let bend = Bend {
                patch: shape.patch,
                rotations: shape.corners.map(|v| frames.rotations[v]),
                rest_normals: shape.corners.map(|v| mesh.geometry.rest_normals[v]),
            };
            let all = outlines.places(base, f).iter().zip(outlines.offsets(base, f));
            for (i, (places, offsets)) in all.enumerate() {
                let from = first + i * LANES;
                let to = (from + LANES).min(first + base.points);
                let mut rest = AtRest {
                    positions: collect(part.rest[from..to].iter().copied()),
                    normals: collect(part.rest_normals[from..to].iter().copied()),
                    ..AtRest::default()
                };
                // Tangents at rest are those of the base: chips shift them too little to be seen.
                let own = base.index(f, i * LANES);
                let tangents = base.attributes.tangents.get(own..own + to - from).unwrap_or_default();
                rest.tangents = collect(tangents.iter().map(|t| [t.x, t.y, t.z]));
                let bent = bend.of(places, &rest, offsets);
                spread(&bent.positions, &mut part.positions[from..to]);
                spread(&bent.normals, &mut part.normals[from..to]);
                for (lane, t) in tangents.iter().enumerate() {
                    let [x, y, z] = bent.tangents.map(|lanes| lanes[lane]);
                    part.tangents[from + lane] = [x, y, z, t.w];
                }
            }
        }
    }

    /// Writes the stains of faces with a corner whose stains changed.
    fn stain(&mut self, mesh: &FilmMesh, face_slots: &FaceSlots, base: &Base, seen: &Seen) {
        let Self { parts, changes, outlines, first, chipped, stained, .. } = self;
        let (topology, look) = (&mesh.topology, &seen.looks.film);
        stained.clear();
        if seen.differences.whole {
            stained.extend(topology.live_faces());
        } else {
            if look.any {
                let has_changed = |f: &FaceId| topology.corners(*f).iter().any(|v| look.has_changed(v.index()));
                stained.extend(topology.live_faces().filter(has_changed));
            }
            stained.extend_from_slice(chipped);
        }
        for &f in stained.iter() {
            let corners = topology.corners(f).map(|v| look.stains[v.index()]);
            let places = outlines.places(base, f);
            let (slot, first) = (face_slots.slot(f), first[f.index()] as usize);
            let to = &mut parts[slot].stains[first..first + base.points];
            for (i, to) in to.iter_mut().enumerate() {
                *to = mean_stains(&corners, places[i / LANES].at(i % LANES));
            }
            changes[slot].stained.add(first..first + base.points);
        }
    }
}

/// Returns the shape of `f` as it is now.
fn shape(mesh: &FilmMesh, frames: &VertexFrames, f: FaceId) -> Shape {
    let corners = mesh.topology.corners(f).map(|v| v.index());
    let still = corners.iter().all(|&v| frames.still[v]);
    let patch = if still {
        Patch::default()
    } else {
        Patch::new(corners.map(|v| mesh.geometry.positions[v].into()), corners.map(|v| frames.normals[v]))
    };
    Shape { patch, corners, still }
}

/// Appends a range of values.
fn copy<T: Copy + Into<[f32; N]>, const N: usize>(to: &mut Vec<[f32; N]>, from: &[T], range: std::ops::Range<usize>) {
    to.extend(from.get(range).unwrap_or_default().iter().map(|&value| value.into()));
}

/// Puts what lies at a place of the film at rest into the vertex `i`.
fn put(part: &mut MeshPart, i: usize, place: Place) {
    part.rest[i] = place.position.to_array();
    part.rest_normals[i] = place.normal.to_array();
    if let Some(uv) = place.uv {
        part.uvs[i] = uv.to_array();
    }
    if let Some(uv) = place.uv_1 {
        part.uvs_1[i] = uv.to_array();
    }
    if let Some(color) = place.color {
        part.colors[i] = color.to_array();
    }
}
