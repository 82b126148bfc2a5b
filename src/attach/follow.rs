//! Hands changes of coatings to their films.

use std::sync::Arc;

use bevy::{
    asset::{AssetEvent, Assets},
    ecs::{
        change_detection::{DetectChanges, Ref},
        entity::Entity,
        message::MessageReader,
        query::Changed,
        system::{Query, Res},
    },
    log::warn,
};

use crate::{
    api::{coating::Coating, film_pace::FilmPace, links::CoatedBy, paint::SettingsSource},
    settings::CoatingSettings,
    shelter::FilmShelter,
};

/// Hands changed settings and shelters to the films. New films take over what changed while they were built. Rates,
/// pauses and qualities are handed over right before the steps of a frame.
pub(super) fn follow_coatings(
    changed: Query<Entity, Changed<Coating>>,
    coatings: Query<&Coating>,
    mut reloaded: MessageReader<AssetEvent<CoatingSettings>>,
    assets: Option<Res<Assets<CoatingSettings>>>,
    mut films: Query<(Ref<CoatedBy>, &mut FilmPace, &mut FilmShelter)>,
) {
    let reloaded: Vec<_> = reloaded
        .read()
        .filter_map(|event| match event {
            AssetEvent::Added { id } | AssetEvent::Modified { id } => Some(*id),
            _ => None,
        })
        .collect();
    for (coated_by, mut pace, mut shelter) in &mut films {
        let Ok(coating) = coatings.get(coated_by.0) else { continue };
        let from_file = matches!(&coating.settings, SettingsSource::Asset(handle) if reloaded.contains(&handle.id()));
        if !changed.contains(coated_by.0) && !from_file && !pace.is_added() && !coated_by.is_changed() {
            continue;
        }
        shelter.choose(coating.shelter);
        let settings = match &coating.settings {
            SettingsSource::Inline(settings) => Some(settings),
            SettingsSource::Asset(handle) => assets.as_ref().and_then(|assets| assets.get(handle)),
        };
        let Some(settings) = settings.filter(|&settings| *settings != *pace.settings) else { continue };
        match settings.validate() {
            Ok(()) => pace.settings = Arc::new(settings.clone()),
            Err(error) => warn!("coating {} keeps its settings: {error}", coated_by.0),
        }
    }
}
