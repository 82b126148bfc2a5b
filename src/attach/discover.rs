//! Finds the meshes to be coated, and the films that no longer fit their coatings.

use bevy::{
    ecs::{
        entity::Entity,
        hierarchy::ChildOf,
        lifecycle::RemovedComponents,
        query::{Added, Changed, Has, With, Without},
        system::{Commands, Local, Query},
    },
    mesh::Mesh3d,
    transform::components::Transform,
};

use super::{
    build::FilmBuild,
    detach::{detach_film, release_slot},
    hierarchy::Coatings,
};
use crate::api::{
    coating::Coating,
    exclude::CoatingExclude,
    links::{
        AwaitingFilm, CoatedBy, CoatedMesh, CoatingPart, FilmOutdated, FilmRefused, FilmSlot, FilmSource, LeftAlone,
        RefusedKey,
    },
};

/// Query of the meshes that are not the plugin's own, and where they stand.
type Meshes<'w, 's> = Query<
    'w,
    's,
    (
        &'static Mesh3d,
        Option<&'static FilmSlot>,
        Option<&'static AwaitingFilm>,
        Option<&'static FilmRefused>,
        Option<&'static LeftAlone>,
    ),
    Without<CoatingPart>,
>;

/// Gives props that come from a saved scene their own meshes back: there they have the meshes that showed their films.
pub(super) fn find_saved(
    mut commands: Commands,
    saved: Query<(Entity, &CoatedMesh), (Added<CoatedMesh>, Without<FilmSlot>)>,
) {
    for (entity, own) in &saved {
        commands.entity(entity).try_remove::<CoatedMesh>().try_insert(Mesh3d(own.0.clone()));
    }
}

/// Checks every mesh whose handle, place in the hierarchy or coating changed: marks it as awaiting a film, or takes it
/// out of its film.
pub(super) fn find_meshes(
    mut commands: Commands,
    coatings: Coatings,
    changed: Query<Entity, Changed<Coating>>,
    changed_meshes: Query<Entity, (Changed<Mesh3d>, Without<CoatingPart>)>,
    moved: Query<Entity, Changed<ChildOf>>,
    shifted: Query<(Entity, &FilmSlot), (Changed<Transform>, With<ChildOf>)>,
    excluded: Query<Entity, Added<CoatingExclude>>,
    mut included: RemovedComponents<CoatingExclude>,
    mut orphans: RemovedComponents<ChildOf>,
    mut meshless: RemovedComponents<Mesh3d>,
    meshes: Meshes,
    films: Query<&CoatedBy>,
    slots: Query<(), With<FilmSlot>>,
    mut candidates: Local<Vec<Entity>>,
) {
    candidates.clear();
    candidates.extend(&changed_meshes);
    candidates.extend(shifted.iter().filter(|(entity, slot)| slot.film != *entity).map(|(entity, _)| entity));
    for entity in moved.iter().chain(orphans.read()).chain(&changed).chain(&excluded).chain(included.read()) {
        coatings.below(entity, &mut candidates);
    }
    for entity in meshless.read() {
        if slots.contains(entity) {
            release_slot(&mut commands, entity);
        }
        commands.entity(entity).try_remove::<(AwaitingFilm, FilmRefused, LeftAlone)>();
    }
    candidates.sort_unstable();
    candidates.dedup();
    for &entity in candidates.iter() {
        let Ok((mesh, slot, awaiting, refused, left_alone)) = meshes.get(entity) else { continue };
        let root = coatings.root_of(entity);
        if let Some(slot) = slot {
            // A film that is ready is also lost when the game puts the prop's own mesh back.
            let swapped = mesh.0 != *slot.display_mesh.as_ref().unwrap_or(&slot.original);
            let elsewhere = !coatings.is_in_place(entity, slot.film);
            let other_root = films.get(slot.film).map_or(true, |coated_by| root != Some(coated_by.0));
            if swapped || elsewhere || other_root {
                release_slot(&mut commands, entity);
            }
            continue;
        }
        let mut commands = commands.entity(entity);
        let Some(root) = root else {
            if awaiting.is_some() || refused.is_some() || left_alone.is_some() {
                commands.try_remove::<(AwaitingFilm, FilmRefused, LeftAlone)>();
            }
            continue;
        };
        // What was refused or left alone is looked at again only when something changed that this may lie in.
        let settled = refused.map(|r| (r.root, r.seen.mesh)).or(left_alone.map(|l| (l.root, l.seen.mesh)));
        if settled == Some((root, mesh.id())) || awaiting.is_some_and(|awaiting| awaiting.root == root) {
            continue;
        }
        commands.try_remove::<(FilmRefused, LeftAlone)>().try_insert(AwaitingFilm { root });
    }
}

/// Marks the films whose coating asks for another film, and calls off builds that nobody wants any more.
pub(super) fn find_outdated(
    mut commands: Commands,
    changed: Query<&Coating, Changed<Coating>>,
    films: Query<(Entity, &CoatedBy, Option<&FilmSource>, Option<&FilmBuild>, Has<FilmOutdated>)>,
) {
    if changed.is_empty() {
        return;
    }
    for (film, coated_by, source, build, outdated) in &films {
        let Ok(coating) = changed.get(coated_by.0) else { continue };
        let wanted = coating.key();
        let asked = RefusedKey { key: wanted, valid: coating.validate().is_ok() };
        let Some(source) = source else {
            // Its meshes await another build, from the beginning.
            if build.is_some_and(|build| build.key != wanted) {
                detach_film(&mut commands, film);
            }
            continue;
        };
        let mut commands = commands.entity(film);
        if build.is_some_and(|build| build.key != wanted) {
            commands.try_remove::<FilmBuild>();
        }
        let outdates = !source.key.serves(&wanted) && source.refused != Some(asked);
        if outdates && !outdated {
            commands.try_insert(FilmOutdated);
        } else if outdated && !outdates {
            commands.try_remove::<FilmOutdated>();
        }
    }
}
