//! The film shown finer than it is simulated (VC 8, fig. 18): every face is a grid of small triangles on the prop's own
//! surface, bent with the film.
//!
//! Each face has its own vertices for good, so a tear renumbers nothing. At rest every vertex lies on the prop's
//! surface. A face that has moved is a [curved patch](patch) over its corners, and the height of the prop's surface
//! over the patch at rest is turned with it. Vertices on an edge depend on that edge alone, so bound neighbours meet.

mod backs;
mod base;
mod chips;
mod fronts;
mod lanes;
mod metal;
mod outline;
mod patch;
mod rims;
#[cfg(test)]
mod tests;
mod vertex_frames;

use std::sync::Arc;

use bevy_math::{Vec3, Vec3A};

use super::{METAL_DEPTH, face_slots::FaceSlots, seen::Seen};
use crate::{film::FilmMesh, fracture::FilmForces};
use backs::FineBacks;
pub(super) use base::Base;
use fronts::FineFronts;
use metal::FineMetal;
use vertex_frames::VertexFrames;

/// Fine fronts, backs and metal of one film, and the lookups that bring them up to date.
#[derive(Clone, Debug, Default)]
pub(super) struct FineSurface {
    base: Arc<Base>,
    frames: VertexFrames,
    /// Thickness of the paint, in metres.
    thickness: f32,
    pub fronts: FineFronts,
    pub backs: FineBacks,
    pub metal: FineMetal,
}

impl FineSurface {
    /// Builds the parts of a film at rest, without triangles until the first [`update`](Self::update). Chips have an
    /// amplitude of `chips` metres.
    pub fn new(mesh: &FilmMesh, base: Arc<Base>, face_slots: &FaceSlots, chips: f32, thickness: f32) -> Self {
        let slots = face_slots.slot_count();
        Self {
            frames: VertexFrames::default(),
            thickness,
            fronts: FineFronts::new(mesh, face_slots, &base, chips),
            backs: FineBacks::new(slots, &base.grid),
            metal: FineMetal::new(slots, &base.grid),
            base,
        }
    }

    /// Brings the parts up to date with what `seen` finds different about the film.
    pub fn update(&mut self, mesh: &FilmMesh, forces: &FilmForces, face_slots: &FaceSlots, seen: &Seen) {
        let Self { base, frames, thickness, fronts, backs, metal } = self;
        if seen.moved {
            frames.follow(mesh, forces, seen);
        }
        fronts.update(mesh, face_slots, base, frames, seen);
        backs.update(mesh, forces, face_slots, base, frames, seen, fronts, *thickness);
        // Below the backs, as the coarse metal is.
        let depth = thickness.max(mesh.geometry.mean_edge * METAL_DEPTH * 0.5) * 2.0;
        metal.update(mesh, forces, face_slots, base, seen, depth);
    }
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
