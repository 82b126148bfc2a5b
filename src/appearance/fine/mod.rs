//! The film shown finer than it is simulated (VC 8, fig. 18): every face is a grid of small triangles on the prop's own
//! surface, bent with the film.
//!
//! Faces share the vertices along bound edges and at corners; a tear gives one side its own and renumbers nothing else.
//! At rest every vertex lies on the prop's surface. A face that has moved is a [curved patch](patch) over its corners,
//! and the height of the prop's surface over the patch at rest is turned with it. Vertices on an edge depend on that
//! edge alone, so bound neighbours meet.

mod backs;
mod base;
mod bend;
mod chips;
mod fronts;
mod layout;
mod metal;
mod outline;
mod patch;
mod rims;
mod runs;
mod skin;
mod stains;
#[cfg(test)]
mod tests;
mod vertex_frames;
mod view;

use std::sync::Arc;

use super::{METAL_DEPTH, face_slots::FaceSlots, part::MeshPart, part_changes::PartChanges, seen::Seen};
use crate::{
    film::FilmMesh,
    fracture::FilmForces,
    rest::{PIECE, Rest},
};
use backs::FineBacks;
pub(super) use base::Base;
use fronts::FineFronts;
use metal::FineMetal;
use vertex_frames::VertexFrames;
use view::View;

/// Number of faces or edges that make a piece of the work: each has several points.
const FINE_PIECE: usize = 2 * PIECE;

/// Fine fronts, backs and metal of one film, and the lookups that bring them up to date.
#[derive(Clone, Debug, Default)]
pub(super) struct FineSurface {
    base: Arc<Base>,
    frames: VertexFrames,
    /// Depth of the metal under the prop's surface, in metres.
    depth: f32,
    pub fronts: FineFronts,
    pub backs: FineBacks,
    pub metal: FineMetal,
}

impl FineSurface {
    /// Returns the parts of a film with `slots` slots, without triangles until the first [`update`](Self::update).
    /// Chips have an amplitude of up to `chips` metres, and the paint is `thickness` metres thick.
    pub fn new(mesh: &FilmMesh, base: Arc<Base>, slots: usize, chips: f32, thickness: f32) -> Self {
        Self {
            frames: VertexFrames::default(),
            // Below the backs, as the coarse metal is.
            depth: thickness.max(mesh.geometry.mean_edge * METAL_DEPTH * 0.5) * 2.0,
            fronts: FineFronts::new(slots, &base, chips),
            backs: FineBacks::new(slots, &base, thickness),
            metal: FineMetal::new(slots, &base),
            base,
        }
    }

    /// Brings the parts up to date with what `seen` finds different about the film.
    pub async fn update(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        face_slots: &FaceSlots,
        seen: &Seen,
        rest: &mut impl Rest,
    ) {
        let Self { base, frames, depth, fronts, backs, metal } = self;
        if seen.moved {
            frames.follow(mesh, forces, seen);
        }
        let view = View { mesh, face_slots, base, positions: seen.moves.positions(), frames };
        rest.rest().await;
        fronts.renew(&view, seen, rest).await;
        backs.renew(&view, forces, seen, fronts, rest).await;
        stains::stain(&view, seen, fronts, backs, rest).await;
        if seen.moved {
            bend::bend(&view, seen, fronts, backs, rest).await;
        }
        backs.finish(&view, seen, fronts, rest).await;
        metal.update(&view, forces, seen, *depth, rest).await;
        if seen.differences.whole {
            fronts.forget();
            backs.forget();
            // How many vertices these have was not known before.
            backs.parts.iter_mut().chain(&mut metal.parts).for_each(MeshPart::shrink);
        }
        let changes = fronts.changes.iter_mut().chain(&mut backs.changes).chain(&mut metal.changes);
        changes.for_each(PartChanges::finish);
    }
}
