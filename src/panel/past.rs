//! Lets films keep their past, so that the bar of ages can go back.

use bevy::ecs::{
    entity::Entity,
    query::{With, Without},
    system::{Commands, Query, Res},
};

use super::state::CoatingPanel;
use crate::api::{coating::Coating, history::CoatingHistory};

/// Gives every coating without a history one.
pub(super) fn keep_past(
    mut commands: Commands,
    panel: Res<CoatingPanel>,
    coatings: Query<Entity, (With<Coating>, Without<CoatingHistory>)>,
) {
    if panel.keyframe_bytes > 0 {
        for coating in &coatings {
            commands.entity(coating).try_insert(CoatingHistory { keyframe_bytes: panel.keyframe_bytes });
        }
    }
}
