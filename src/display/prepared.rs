//! Prepares the fronts of films as meshes that are not assets yet, for a new film or for another level.

use bevy::{mesh::Mesh, tasks::Task};

use super::{
    canvas::{StainCanvas, StainCarrier, StainWriter},
    film_paint::FilmPaint,
    mesh::{PartSpace, new_mesh, write_part},
};
use crate::{
    api::stain_display::StainDisplay,
    appearance::{FilmAppearance, shading::StainPart},
    film::FaceGrid,
    mesh_reader::SlotAttributes,
    rest::Rest,
};

/// Returns the mean distance between the vertices that show a film with edges of `film_edge` at `level`.
pub(super) fn edge_at(film_edge: f32, level: u32) -> f32 {
    film_edge / (1u32 << level.min(FaceGrid::MOST)) as f32
}

/// Front of one primitive as a mesh that is not an asset yet.
pub(super) struct FrontMesh {
    pub mesh: Mesh,
    pub canvas: StainCanvas,
    /// Whether the mesh shows the part, and not a stand-in for one without triangles.
    pub shown: bool,
}

/// Writes the front of a slot to a new mesh. `None` for a primitive of which nothing was left after cleaning: it keeps
/// its mesh.
pub(super) fn write_front(
    appearance: &FilmAppearance,
    slot: usize,
    attributes: SlotAttributes,
    paint: &FilmPaint,
    edge: f32,
    space: PartSpace,
) -> Option<FrontMesh> {
    let part = appearance.front(slot)?;
    let (mut mesh, canvas) = (new_mesh(), StainCanvas::new(part, front_writer(paint, edge)));
    let shown = write_part(&mut mesh, part, attributes, space, &canvas);
    Some(FrontMesh { mesh, canvas, shown })
}

/// Film as it was prepared at another level.
pub(super) struct PreparedLevel {
    pub appearance: FilmAppearance,
    pub fronts: Vec<Option<FrontMesh>>,
    pub paint: FilmPaint,
}

impl PreparedLevel {
    /// Writes the meshes of `appearance`, for a film with edges of `film_edge`, and rests before each.
    pub async fn new(
        appearance: FilmAppearance,
        attributes: &[SlotAttributes],
        paint: FilmPaint,
        film_edge: f32,
        space: PartSpace,
        rest: &mut impl Rest,
    ) -> Self {
        let edge = edge_at(film_edge, appearance.level());
        let mut fronts = Vec::with_capacity(attributes.len());
        for (slot, &attributes) in attributes.iter().enumerate() {
            rest.rest().await;
            fronts.push(write_front(&appearance, slot, attributes, &paint, edge, space));
        }
        Self { appearance, fronts, paint }
    }
}

/// Returns the settings with which the stains of fronts are written to their meshes.
pub(super) fn front_writer(paint: &FilmPaint, edge: f32) -> StainWriter<'_> {
    let carrier = match paint.display {
        StainDisplay::Material => StainCarrier::Attributes,
        StainDisplay::VertexColor => StainCarrier::Colors,
        StainDisplay::None => StainCarrier::Nothing,
    };
    StainWriter { part: StainPart::Film, paint, carrier, edge }
}

/// Change of level under way. Dropping it cancels it.
pub(super) struct LevelChange {
    pub level: u32,
    pub task: Task<PreparedLevel>,
}
