//! Pieces of paint that come off become objects of the world.
//!
//! ```text
//! a step: pieces that fell --shed--> entities with meshes --flutter--> the ground
//! ```

mod flutter;
mod shed;

use bevy::{
    app::{App, PostUpdate, Update},
    ecs::{
        entity::Entity,
        query::Without,
        schedule::IntoScheduleConfigs,
        system::{Commands, Query},
    },
    transform::TransformSystems,
};

use crate::api::{
    debris::{CoatingDebris, FallenPieces},
    links::{CoatedBy, FilmSource},
    system_sets::{CoatingAdvance, CoatingAttach},
};

/// Adds the systems of debris.
pub(crate) fn add_debris(app: &mut App) {
    app.add_systems(Update, (follow_coatings, flutter::flutter).before(CoatingAdvance));
    // Flakes of this frame are placed with all else.
    app.add_systems(PostUpdate, shed::shed.before(CoatingAttach).before(TransformSystems::Propagate));
}

/// Films whose coatings want debris note which pieces come off.
fn follow_coatings(
    mut commands: Commands,
    wanted: Query<&CoatingDebris>,
    films: Query<(Entity, &CoatedBy), (bevy::ecs::query::With<FilmSource>, Without<FallenPieces>)>,
    noting: Query<(Entity, &CoatedBy, &FallenPieces)>,
) {
    if !wanted.is_empty() {
        for (film, _) in films.iter().filter(|(_, coated_by)| wanted.contains(coated_by.0)) {
            commands.entity(film).try_insert(FallenPieces::default());
        }
    }
    for (film, ..) in noting.iter().filter(|(_, coated_by, _)| !wanted.contains(coated_by.0)) {
        commands.entity(film).try_remove::<FallenPieces>();
    }
}
