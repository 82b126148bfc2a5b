//! Finds the meshes to be coated, and hands changes of coatings to their films.

use std::sync::Arc;

use bevy::{
    asset::{AssetEvent, Assets},
    ecs::{
        entity::Entity,
        hierarchy::{ChildOf, Children},
        lifecycle::RemovedComponents,
        message::MessageReader,
        query::{Changed, Without},
        system::{Commands, Local, Query, Res, SystemParam},
    },
    log::warn,
    mesh::Mesh3d,
};

use super::{build::FilmBuild, detach::detach_film};
use crate::{
    api::{
        coating::{Coating, SettingsSource},
        film_pace::FilmPace,
        links::{AwaitingFilm, CoatedBy, CoatingPart, FilmRefused, FilmSlot, FilmSource},
    },
    settings::CoatingSettings,
    shelter::FilmShelter,
};

/// Coatings, and the hierarchy of entities.
#[derive(SystemParam)]
pub(super) struct Coatings<'w, 's> {
    pub coatings: Query<'w, 's, &'static Coating>,
    parents: Query<'w, 's, &'static ChildOf>,
    children: Query<'w, 's, &'static Children>,
}

impl Coatings<'_, '_> {
    /// Returns the nearest entity with a coating, from `entity` upwards.
    fn root_of(&self, entity: Entity) -> Option<Entity> {
        std::iter::once(entity).chain(self.parents.iter_ancestors(entity)).find(|&e| self.coatings.contains(e))
    }

    /// Adds `entity` and all its descendants to `found`.
    fn below(&self, entity: Entity, found: &mut Vec<Entity>) {
        found.push(entity);
        found.extend(self.children.iter_descendants(entity));
    }
}

/// Query of the meshes that are not the plugin's own, and where they stand.
type Meshes<'w, 's> = Query<
    'w,
    's,
    (&'static Mesh3d, Option<&'static FilmSlot>, Option<&'static AwaitingFilm>, Option<&'static FilmRefused>),
    Without<CoatingPart>,
>;

/// Checks every mesh whose handle, place in the hierarchy or coating changed: marks it as awaiting a film, or takes its
/// film off.
pub(super) fn find_meshes(
    mut commands: Commands,
    coatings: Coatings,
    changed_coatings: Query<Entity, Changed<Coating>>,
    changed_meshes: Query<Entity, (Changed<Mesh3d>, Without<CoatingPart>)>,
    moved: Query<Entity, Changed<ChildOf>>,
    mut orphans: RemovedComponents<ChildOf>,
    mut meshless: RemovedComponents<Mesh3d>,
    meshes: Meshes,
    films: Query<(&CoatedBy, Option<&FilmSource>, Option<&FilmBuild>)>,
    slots: Query<&FilmSlot>,
    mut candidates: Local<Vec<Entity>>,
) {
    candidates.clear();
    candidates.extend(&changed_meshes);
    for entity in moved.iter().chain(orphans.read()) {
        coatings.below(entity, &mut candidates);
    }
    for entity in meshless.read() {
        if let Ok(slot) = slots.get(entity) {
            detach_film(&mut commands, slot.film);
        }
    }
    for entity in &changed_coatings {
        coatings.below(entity, &mut candidates);
    }
    candidates.sort_unstable();
    candidates.dedup();
    for &entity in candidates.iter() {
        let Ok((mesh, slot, awaiting, refused)) = meshes.get(entity) else { continue };
        let root = coatings.root_of(entity);
        if let Some(slot) = slot {
            let swapped = mesh.0 != slot.original && slot.display_mesh.as_ref() != Some(&mesh.0);
            let outdated = films.get(slot.film).map_or(true, |(coated_by, source, build)| {
                let key = source.map(|source| source.key).or(build.map(|build| build.key));
                let wanted = root.and_then(|root| coatings.coatings.get(root).ok()).map(|coating| coating.key());
                root != Some(coated_by.0) || key != wanted
            });
            if swapped || outdated {
                detach_film(&mut commands, slot.film);
            }
            continue;
        }
        let mut entity = commands.entity(entity);
        let changed = |was: Option<Entity>| was != root;
        if let Some(root) = root
            && awaiting.is_none_or(|awaiting| changed(Some(awaiting.root)))
        {
            entity.try_insert(AwaitingFilm { root });
        } else if root.is_none() && awaiting.is_some() {
            entity.try_remove::<AwaitingFilm>();
        }
        if refused.is_some() {
            entity.try_remove::<FilmRefused>();
        }
    }
}

/// Hands changed settings and shelters to the films. Rate, pause and quality are read before each frame's steps.
pub(super) fn follow_coatings(
    changed: Query<Entity, Changed<Coating>>,
    coatings: Query<&Coating>,
    mut reloaded: MessageReader<AssetEvent<CoatingSettings>>,
    assets: Option<Res<Assets<CoatingSettings>>>,
    mut films: Query<(&CoatedBy, &mut FilmPace, &mut FilmShelter)>,
) {
    let reloaded: Vec<_> = reloaded
        .read()
        .filter_map(|event| match event {
            AssetEvent::Added { id } | AssetEvent::Modified { id } => Some(*id),
            _ => None,
        })
        .collect();
    if changed.is_empty() && reloaded.is_empty() {
        return;
    }
    for (coated_by, mut pace, mut shelter) in &mut films {
        let Ok(coating) = coatings.get(coated_by.0) else { continue };
        let from_file = matches!(&coating.settings, SettingsSource::Asset(handle) if reloaded.contains(&handle.id()));
        if !changed.contains(coated_by.0) && !from_file {
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
