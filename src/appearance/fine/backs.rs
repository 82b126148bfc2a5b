//! Builds the backs of fine flakes, and the rims that join fronts and backs along cracks.

use bevy_math::{Vec3, Vec3A};

use super::{outline::Outlines, unit, vertex_frames::VertexFrames};
use crate::{
    appearance::{
        backs::gather,
        face_slots::{FaceSlots, has_separated},
        part::MeshPart,
    },
    film::{FaceGrid, FaceId, FilmMesh, HalfEdgeId},
    fracture::FilmForces,
};

/// Backs and rims of all slots.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct FineBacks {
    /// Vertices and triangles in each slot: first those behind the points of the grids of [`faces`](Self::faces), then
    /// two rows for each of [`rims`](Self::rims), at the front and at the back.
    pub parts: Vec<MeshPart>,
    /// Faces of each slot that have a back.
    faces: Vec<Vec<FaceId>>,
    /// Half-edges of each slot that have a rim.
    rims: Vec<Vec<HalfEdgeId>>,
    /// Front vertex of each vertex of each slot.
    fronts: Vec<Vec<u32>>,
}

impl FineBacks {
    /// Returns the backs of a fresh film with `slots` slots.
    pub fn new(slots: usize) -> Self {
        Self {
            parts: vec![MeshPart::default(); slots],
            faces: vec![Vec::new(); slots],
            rims: vec![Vec::new(); slots],
            fronts: vec![Vec::new(); slots],
        }
    }

    /// Collects the separated faces and their free edges, and builds their triangles again. Positions and normals come
    /// from [`follow`](Self::follow).
    pub fn renew(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        grid: &FaceGrid,
        first: &[u32],
        front_parts: &[MeshPart],
    ) {
        let Self { parts, faces, rims, fronts } = self;
        let topology = &mesh.topology;
        parts.iter_mut().for_each(MeshPart::clear);
        faces.iter_mut().for_each(Vec::clear);
        rims.iter_mut().for_each(Vec::clear);
        fronts.iter_mut().for_each(Vec::clear);
        for f in topology.live_faces() {
            if face_slots.is_hidden(f) || !has_separated(topology, forces, f) {
                continue;
            }
            let (slot, flipped) = (face_slots.slot(f), face_slots.is_flipped(f));
            let own = fronts[slot].len() as u32;
            for &[a, b, c] in grid.triangles() {
                let [b, c] = if flipped { [b, c] } else { [c, b] };
                parts[slot].indices.extend([own + a, own + b, own + c]);
            }
            faces[slot].push(f);
            fronts[slot].extend((0..grid.points().len() as u32).map(|i| first[f.index()] + i));
            let is_free = |h: &HalfEdgeId| {
                let ends = [topology.origin(*h), topology.target(*h)];
                topology.bound_twin(*h).is_none() && !ends.iter().any(|&v| forces.is_attached(v))
            };
            rims[slot].extend(f.half_edges().into_iter().filter(is_free));
        }
        for (slot, part) in parts.iter_mut().enumerate() {
            let fronts = &mut fronts[slot];
            for &h in &rims[slot] {
                let edge = grid.edge(h.index() % 3);
                let (own, row) = (fronts.len() as u32, edge.len() as u32);
                for _ in 0..2 {
                    fronts.extend(edge.iter().map(|&i| first[h.face().index()] + i));
                }
                for i in own..own + row - 1 {
                    let [top, bottom] = [i, i + row];
                    part.indices.extend(if face_slots.is_flipped(h.face()) {
                        [top, bottom + 1, bottom, top, top + 1, bottom + 1]
                    } else {
                        [top, bottom, bottom + 1, top, bottom + 1, top + 1]
                    });
                }
            }
            let front = &front_parts[slot];
            part.positions.resize(fronts.len(), [0.0; 3]);
            part.normals.resize(fronts.len(), [0.0; 3]);
            gather(&mut part.uvs, &front.uvs, fronts);
            gather(&mut part.uvs_1, &front.uvs_1, fronts);
            gather(&mut part.colors, &front.colors, fronts);
            // Three vertices may stand for one of the front: behind it, and on a rim above and below.
            let points = faces[slot].len() * grid.points().len();
            let rows = 2 * (1 + (1u32 << grid.level()));
            part.keys.extend(fronts.iter().enumerate().map(|(i, &front_vertex)| {
                let kind = if i < points { 0 } else { 1 + 2 * ((i - points) as u32 % rows) / rows };
                3 * front.keys[front_vertex as usize] + kind
            }));
        }
    }

    /// Copies the stains, rest positions and rest normals of the fronts.
    pub fn stain(&mut self, front_parts: &[MeshPart]) {
        for ((part, fronts), front) in self.parts.iter_mut().zip(&self.fronts).zip(front_parts) {
            gather(&mut part.stains, &front.stains, fronts);
            gather(&mut part.rest, &front.rest, fronts);
            gather(&mut part.rest_normals, &front.rest_normals, fronts);
        }
    }

    /// Moves the vertices behind their fronts, `thickness` metres along the normals of the film.
    pub(super) fn follow(
        &mut self,
        mesh: &FilmMesh,
        face_slots: &FaceSlots,
        grid: &FaceGrid,
        outlines: &Outlines,
        frames: &VertexFrames,
        front_parts: &[MeshPart],
        thickness: f32,
    ) {
        let points = grid.points().len();
        for (slot, part) in self.parts.iter_mut().enumerate() {
            let front = &front_parts[slot];
            let place = |vertex: u32| Vec3A::from_array(front.positions[vertex as usize]);
            // The normal of the film at a point of a face, outwards as the prop has it.
            let normal_of = |f: FaceId, i: u32| {
                let b = outlines.chipped(f, points).map_or(grid.points()[i as usize], |points| points[i as usize].1);
                let [p, q, r] = mesh.topology.corners(f).map(|v| frames.normals[v.index()]);
                unit(p * b.x + q * b.y + r * b.z, p)
            };
            let side = |f: FaceId| if face_slots.is_flipped(f) { -1.0 } else { 1.0 };
            let mut to = 0;
            for &f in &self.faces[slot] {
                for i in 0..points as u32 {
                    let vertex = self.fronts[slot][to];
                    let back = place(vertex) - normal_of(f, i) * (side(f) * thickness);
                    part.positions[to] = back.to_array();
                    part.normals[to] = (-Vec3::from_array(front.normals[vertex as usize])).to_array();
                    to += 1;
                }
            }
            for &h in &self.rims[slot] {
                let (f, edge) = (h.face(), grid.edge(h.index() % 3));
                let vertices = &self.fronts[slot][to..to + edge.len()];
                for (i, (&vertex, &point)) in vertices.iter().zip(edge).enumerate() {
                    let (before, after) = (vertices[i.saturating_sub(1)], vertices[(i + 1).min(edge.len() - 1)]);
                    let normal = normal_of(f, point);
                    let aside = unit((place(after) - place(before)).cross(normal), normal);
                    let shading = Vec3A::from_array(front.normals[vertex as usize]);
                    let bottom = to + edge.len() + i;
                    part.positions[to + i] = front.positions[vertex as usize];
                    part.normals[to + i] = unit(shading + aside, aside).to_array();
                    part.positions[bottom] = (place(vertex) - normal * (side(f) * thickness)).to_array();
                    part.normals[bottom] = unit(aside - shading, aside).to_array();
                }
                to += 2 * edge.len();
            }
        }
    }
}
