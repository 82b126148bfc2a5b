//! Defines [`HeatOverlay`], the mesh that shows a heat map of one film.

use bevy::{asset::Handle, ecs::entity::Entity, mesh::Mesh};

use crate::{api::heat_map_view::HeatMapView, heat::HeatValues};

/// Mesh that shows a heat map of one film.
#[derive(Debug)]
pub(super) struct HeatOverlay {
    /// Entity that draws it.
    pub part: Entity,
    /// Mesh entity of the film that it is a child of.
    pub parent: Entity,
    pub mesh: Handle<Mesh>,
    /// View that the mesh shows.
    pub shown: HeatMapView,
    pub values: HeatValues,
    /// Rain that the mesh shows, where it shows any.
    pub rain: Vec<f32>,
}
