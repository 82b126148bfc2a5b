//! The film shown as it is simulated: its own triangles.

mod backs;
mod fronts;
mod metal;

use std::sync::Arc;

use super::{
    FILM_THICKNESS, METAL_DEPTH,
    corners::CornerAttributes,
    face_slots::FaceSlots,
    part_changes::PartChanges,
    seen::Seen,
    wedges::{RestWedges, Wedges},
};
use crate::{film::FilmMesh, fracture::FilmForces, rest::Rest};
use backs::Backs;
use fronts::Fronts;
use metal::Metal;

/// Fronts, backs and metal of one film, and the lookups that bring them up to date.
#[derive(Clone, Debug)]
pub(super) struct CoarseSurface {
    attributes: Arc<CornerAttributes>,
    wedges: Wedges,
    pub fronts: Fronts,
    pub backs: Backs,
    pub metal: Metal,
}

impl CoarseSurface {
    /// Returns the parts of a film with `slots` slots, without faces until the first [`update`](Self::update).
    pub fn new(attributes: Arc<CornerAttributes>, wedges: Arc<RestWedges>, slots: usize) -> Self {
        Self {
            wedges: Wedges::new(wedges),
            fronts: Fronts::new(slots),
            backs: Backs::new(slots),
            metal: Metal::new(slots),
            attributes,
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
        let Self { attributes, wedges, fronts, backs, metal } = self;
        let edge = mesh.geometry.mean_edge;
        wedges.follow(&mesh.topology, face_slots, &seen.differences);
        rest.rest().await;
        fronts.update(mesh, face_slots, attributes, wedges, seen);
        rest.rest().await;
        backs.update(mesh, forces, face_slots, wedges, seen, fronts, edge * FILM_THICKNESS);
        rest.rest().await;
        metal.update(mesh, forces, face_slots, wedges.at_rest(), attributes, seen, edge * METAL_DEPTH);
        let changes = fronts.changes.iter_mut().chain(&mut backs.changes).chain(&mut metal.changes);
        changes.for_each(PartChanges::finish);
    }
}
