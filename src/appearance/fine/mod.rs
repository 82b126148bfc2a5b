//! The film shown finer than it is simulated (VC 8, fig. 18): every face is a grid of small triangles on the prop's own
//! surface, bent with the film.
//!
//! Each face has its own vertices for good, so a tear renumbers no front. At rest every vertex lies on the prop's
//! surface. A face that has moved is a [curved patch](patch) over its corners, and the height of the prop's surface
//! over the patch at rest is turned with it. Vertices on an edge depend on that edge alone, so bound neighbours meet.

mod backs;
mod base;
mod chips;
mod metal;
mod outline;
mod patch;
#[cfg(test)]
mod tests;
mod vertex_frames;

use bevy_math::{Vec3, Vec3A};

use super::{
    METAL_DEPTH,
    changes::DisplayChanges,
    corners::CornerAttributes,
    detail::Detail,
    face_slots::FaceSlots,
    moves::Moves,
    part::{MeshPart, vertex_stains},
};
use crate::{
    film::{FaceGrid, FaceId, FilmMesh},
    fracture::FilmForces,
    remesh::{BuiltFilm, fine_sites},
    stain::StainFields,
    surface::{BuildError, Surface},
};
use backs::FineBacks;
use base::{Base, Place};
use metal::FineMetal;
use outline::Outlines;
use patch::{Patch, weights};
use vertex_frames::VertexFrames;

/// Fine fronts, backs and metal of one film, and the lookups that bring them up to date.
#[derive(Clone, Debug, Default)]
pub(super) struct FineSurface {
    grid: FaceGrid,
    /// Weights of a patch's control points at each point of the grid.
    weights: Vec<[f32; 10]>,
    base: Base,
    /// First vertex of each face in the front part of its slot.
    first: Vec<u32>,
    outlines: Outlines,
    frames: VertexFrames,
    moves: Moves,
    /// Thickness of the paint, in metres.
    thickness: f32,
    pub fronts: Vec<MeshPart>,
    pub backs: FineBacks,
    pub metal: FineMetal,
}

/// Face with what is needed to place its points.
struct Shape {
    patch: Patch,
    corners: [usize; 3],
    /// Whether the face lies as at rest.
    still: bool,
}

impl FineSurface {
    /// Samples the prop's surface and builds the parts of a film at rest and without cracks. The first
    /// [`update`](Self::update) must be one of everything.
    pub fn new(
        built: &BuiltFilm,
        surface: &Surface,
        mesh: &FilmMesh,
        corners: &CornerAttributes,
        face_slots: &FaceSlots,
        grain: f32,
        detail: Detail,
    ) -> Result<Self, BuildError> {
        let grid = FaceGrid::new(detail.level);
        let sites = fine_sites(surface, built, &grid)?;
        let base = Base::new(&sites, surface, mesh, corners, &grid);
        let weights: Vec<_> = grid.points().iter().map(|&b| weights(b)).collect();
        let outlines = Outlines::new(mesh, &base, &weights, detail.chips * grain);
        let slots = face_slots.slot_count();
        let mut fine = Self {
            frames: VertexFrames::new(mesh),
            first: Vec::with_capacity(mesh.topology.face_count()),
            thickness: detail.thickness * grain,
            fronts: vec![MeshPart::default(); slots],
            backs: FineBacks::new(slots),
            metal: FineMetal::new(slots),
            moves: Moves::default(),
            grid,
            weights,
            base,
            outlines,
        };
        fine.place_fronts(mesh, face_slots);
        Ok(fine)
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
        if tore {
            self.chip(mesh, face_slots);
            self.write_indices(mesh, face_slots);
        }
        let moved = (changes.moved || tore) && self.moves.follow(mesh, tore);
        if moved {
            self.frames.follow(mesh, forces, &self.moves);
            self.bend(mesh, face_slots);
        }
        if tore || stained {
            self.stain_fronts(mesh, stains, face_slots);
        }
        let Self { grid, base, first, outlines, frames, thickness, fronts, backs, metal, .. } = self;
        if tore || exposed {
            backs.renew(mesh, forces, face_slots, grid, first, fronts);
        }
        if moved || tore || exposed {
            backs.follow(mesh, face_slots, grid, outlines, frames, fronts, *thickness);
        }
        if tore || exposed || stained {
            backs.stain(fronts);
        }
        if exposed {
            // Below the backs, as the coarse metal is.
            let depth = thickness.max(mesh.geometry.mean_edge * METAL_DEPTH * 0.5) * 2.0;
            metal.renew(mesh, forces, face_slots, grid, base, depth);
        }
        if exposed || stained {
            metal.stain(mesh, stains, grid);
        }
    }

    /// Gives every face its vertices in the front part of its slot, at rest.
    fn place_fronts(&mut self, mesh: &FilmMesh, face_slots: &FaceSlots) {
        let Self { base, first, fronts, .. } = self;
        let CornerAttributes { normals, uvs, uvs_1, tangents, colors } = &base.attributes;
        for f in mesh.topology.all_faces() {
            let part = &mut fronts[face_slots.slot(f)];
            first.push(part.positions.len() as u32);
            let range = base.index(f, 0)..base.index(f, base.points);
            copy(&mut part.positions, &base.positions, range.clone());
            copy(&mut part.normals, normals, range.clone());
            copy(&mut part.uvs, uvs, range.clone());
            copy(&mut part.uvs_1, uvs_1, range.clone());
            copy(&mut part.tangents, tangents, range.clone());
            copy(&mut part.colors, colors, range.clone());
            part.keys.extend(range.map(|i| i as u32));
        }
        for part in fronts {
            part.rest.clone_from(&part.positions);
            part.rest_normals.clone_from(&part.normals);
        }
    }

    /// Shapes the outlines of faces at edges that have torn.
    fn chip(&mut self, mesh: &FilmMesh, face_slots: &FaceSlots) {
        let Self { grid, base, first, outlines, fronts, .. } = self;
        for f in mesh.topology.all_faces() {
            if !outlines.has_torn(mesh, f) || !mesh.topology.is_live(f) {
                continue;
            }
            let (part, first) = (&mut fronts[face_slots.slot(f)], first[f.index()] as usize);
            outlines.shape(mesh, base, grid, f, |i, place| put(part, first + i, place));
        }
    }

    /// Writes the triangles of the faces that are left.
    fn write_indices(&mut self, mesh: &FilmMesh, face_slots: &FaceSlots) {
        self.fronts.iter_mut().for_each(|part| part.indices.clear());
        for f in mesh.topology.live_faces().filter(|&f| !face_slots.is_hidden(f)) {
            let indices = &mut self.fronts[face_slots.slot(f)].indices;
            let (first, flipped) = (self.first[f.index()], face_slots.is_flipped(f));
            for &[a, b, c] in self.grid.triangles() {
                indices.extend(if flipped {
                    [first + a, first + c, first + b]
                } else {
                    [first + a, first + b, first + c]
                });
            }
        }
    }

    /// Writes positions, normals and tangents of the faces with a corner that moved or turned.
    fn bend(&mut self, mesh: &FilmMesh, face_slots: &FaceSlots) {
        let Self { weights, base, first, outlines, frames, moves, fronts, grid, .. } = self;
        for f in mesh.topology.live_faces() {
            if !mesh.topology.corners(f).iter().any(|&v| moves.is_turned(v)) {
                continue;
            }
            let shape = shape(mesh, frames, f);
            let (part, first) = (&mut fronts[face_slots.slot(f)], first[f.index()] as usize);
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
            let chipped = outlines.chipped(f, base.points);
            let [p, q, r] = shape.corners.map(|v| frames.rotations[v]);
            let rest_normals = shape.corners.map(|v| Vec3A::from(mesh.geometry.rest_normals[v]));
            for i in 0..base.points {
                let (weights, b) =
                    chipped.map_or((&weights[i], grid.points()[i]), |points| (&points[i].0, points[i].1));
                let to = first + i;
                let rotation = p * b.x + q * b.y + r * b.z;
                let rest = Vec3A::from(Vec3::from_array(part.rest[to]));
                let bent = shape.patch.at(weights) + rotation * outlines.offsets[base.index(f, i)];
                let up = rest_normals[0] * b.x + rest_normals[1] * b.y + rest_normals[2] * b.z;
                let position = lifted(bent, rest, up);
                part.positions[to] = position.to_array();
                let rest_normal = Vec3A::from(Vec3::from_array(part.rest_normals[to]));
                let normal = unit(rotation * rest_normal, rest_normal);
                part.normals[to] = normal.to_array();
                if let Some(tangent) = part.tangents.get_mut(to) {
                    // Tangents at rest are those of the base: chips shift them too little to be seen.
                    let [x, y, z, w] = base.attributes.tangents[base.index(f, i)].to_array();
                    let turned = rotation * Vec3A::new(x, y, z);
                    let flat = unit(turned - normal * turned.dot(normal), Vec3A::new(x, y, z));
                    *tangent = [flat.x, flat.y, flat.z, w];
                }
            }
        }
    }

    /// Writes the stains of every front vertex.
    fn stain_fronts(&mut self, mesh: &FilmMesh, stains: &StainFields, face_slots: &FaceSlots) {
        let Self { grid, base, first, outlines, fronts, .. } = self;
        for part in fronts.iter_mut() {
            part.stains.resize(part.positions.len(), [0.0; 4]);
        }
        for f in mesh.topology.live_faces() {
            let corners = mesh.topology.corners(f).map(|v| {
                let (film, metal) = (v.index(), mesh.topology.original(v).index());
                let layer = &stains.film;
                vertex_stains(layer.rust(film), layer.dust[film], layer.moisture[film], stains.corrosion[metal])
            });
            let chipped = outlines.chipped(f, base.points);
            let to = &mut fronts[face_slots.slot(f)].stains[first[f.index()] as usize..][..base.points];
            for (i, (to, &b)) in to.iter_mut().zip(grid.points()).enumerate() {
                *to = mean_stains(&corners, chipped.map_or(b, |points| points[i].1));
            }
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

/// Returns `position`, lifted along `up` to the height of `rest` if it lies below: patches between film that has moved
/// and film that has not may dip through the metal.
fn lifted(position: Vec3A, rest: Vec3A, up: Vec3A) -> Vec3A {
    // Around a thin pole the normals that `up` is a mean of may nearly cancel out, so only its direction counts.
    let up = unit(up, Vec3A::ZERO);
    position - up * (position - rest).dot(up).min(0.0)
}

/// Returns the stains at `b` between those at the corners of a face.
fn mean_stains(corners: &[[f32; 4]; 3], b: Vec3) -> [f32; 4] {
    let b = b.max(Vec3::ZERO);
    let b = b / (b.x + b.y + b.z);
    std::array::from_fn(|i| corners[0][i] * b.x + corners[1][i] * b.y + corners[2][i] * b.z)
}

/// Returns `v` scaled to unit length, or `or` if it has none.
fn unit(v: Vec3A, or: Vec3A) -> Vec3A {
    // See `turn::unit` for the square root.
    let length = v.length_squared().sqrt();
    if length > 0.0 { v * (1.0 / length) } else { or }
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
