//! Puts finished films on their props, and refuses meshes that could not be coated.

use std::sync::Arc;

use bevy::{
    asset::Assets,
    ecs::{
        entity::Entity,
        system::{Commands, Query, Res, ResMut},
        world::World,
    },
    log::{error, warn},
    mesh::{Mesh, Mesh3d},
    tasks::futures::check_ready,
};

use super::{
    build::{FilmBuild, FilmReadiness},
    detach::{detach_film, take_film},
    suspects::suspects_of,
};
use crate::{
    api::{
        calendar::CoatingCalendar,
        clock::CoatingClock,
        coating::{Coating, FilmKey},
        error::{CoatingError, CoatingFault},
        film_pace::FilmPace,
        links::{
            AwaitingFilm, CoatedBy, CoatedMesh, FilmOutdated, FilmRefused, FilmSlot, FilmSource, LeftAlone, RefusedKey,
        },
        messages::{FilmFailed, FilmReady, RestoreFailed},
        summary::{FilmSummary, FilmSurveyed},
    },
    appearance::DisplayChanges,
    sim::{FilmClock, FilmState},
};

/// Puts finished films on their props.
pub(super) fn finish_builds(
    mut commands: Commands,
    mut builds: Query<(Entity, &mut FilmBuild, Option<&FilmSource>)>,
    slots: Query<(&Mesh3d, &FilmSlot)>,
    coatings: Query<&Coating>,
    refused: Query<&FilmRefused>,
    calendar: Res<CoatingCalendar>,
    clock: Res<CoatingClock>,
    mut assets: ResMut<Assets<Mesh>>,
) {
    for (film, mut build, old) in &mut builds {
        // A build that is not wanted any more is called off by `find_outdated` in this frame.
        if coatings.get(build.root).is_ok_and(|coating| coating.key() != build.key) {
            continue;
        }
        let Some(result) = check_ready(&mut build.task) else { continue };
        // If a mesh was swapped or despawned meanwhile, the build is discarded and the meshes are checked again.
        let current = |&slot: &Entity| {
            let own = |(mesh, slot): (&Mesh3d, &FilmSlot)| {
                slot.film == film && (mesh.0 == slot.original || Some(&mesh.0) == slot.display_mesh.as_ref())
            };
            slots.get(slot).is_ok_and(own)
        };
        let Ok(coating) = coatings.get(build.root) else {
            detach_film(&mut commands, film);
            continue;
        };
        if !build.slots.iter().all(current) {
            detach_film(&mut commands, film);
            continue;
        }
        match result {
            // What is wrong may have been mended meanwhile: it is begun again, by itself or as a mesh that changed.
            Err(_) if build.stale && old.is_some() => {
                commands.entity(film).try_remove::<FilmBuild>();
            }
            Err(_) if build.stale => detach_film(&mut commands, film),
            Err(fault) if old.is_some() => keep_old(&mut commands, film, build.root, build.key, fault),
            Err(fault) => {
                let (root, meshes) = (build.root, std::mem::take(&mut build.slots));
                take_film(&mut commands, film);
                refuse(&mut commands, film, root, meshes, &refused, fault);
            }
            Ok(mut ready) => {
                if coating.painted.is_some() {
                    catch_up(&mut ready.film.clock, (calendar.date() - build.date) * coating.rate, &clock);
                }
                if old.is_some() {
                    take_film(&mut commands, film);
                }
                put_on(&mut commands, film, &mut build, *ready, coating, &slots, &mut assets);
            }
        }
    }
}

/// Sends a film on by the `age` that has passed while it was built.
fn catch_up(film: &mut FilmClock, age: f64, clock: &CoatingClock) {
    let most = clock.checked_target().map_or(u64::MAX, |age| film.step_at(age));
    let goal = film.step_at(film.age() + age).min(most);
    film.goal = Some(goal).filter(|&goal| goal > film.steps);
}

/// Puts a finished film on its prop.
fn put_on(
    commands: &mut Commands,
    film: Entity,
    build: &mut FilmBuild,
    ready: FilmReadiness,
    coating: &Coating,
    slots: &Query<(&Mesh3d, &FilmSlot)>,
    assets: &mut Assets<Mesh>,
) {
    let FilmReadiness { film: state, history, refused, settings, warnings, mut display, mut shelter, origin } = ready;
    let FilmState { mesh, forces, constraints, stains, clock, changes, scratch, .. } = state;
    let triangles = mesh.topology.face_count();
    let mut pace = FilmPace::new(settings);
    pace.know(&forces);
    // A rate that has gone out of range meanwhile is told before the first step.
    let _ = pace.follow(coating);
    pace.bounds = crate::stepping::bounds(&mesh.geometry, origin, build.metres_per_unit);
    shelter.choice = coating.shelter;
    let handles = display.put_on(assets);
    for (&slot, handle) in build.slots.iter().zip(handles) {
        let Ok((_, claim)) = slots.get(slot) else { continue };
        // A primitive of which no face was left keeps its own mesh.
        let handle = handle.unwrap_or_else(|| claim.original.clone());
        let own = CoatedMesh(claim.original.clone());
        let claim = FilmSlot { display_mesh: Some(handle.clone()), ..claim.clone() };
        commands.entity(slot).try_remove::<FilmRefused>().try_insert((Mesh3d(handle), own, claim));
    }
    let FilmBuild { root, key, seed, scale, metres_per_unit, area, .. } = *build;
    let slots = std::mem::take(&mut build.slots);
    let source =
        FilmSource { key, seed, slots, scale, metres_per_unit, origin, area, hidden: Vec::new(), refused: None };
    commands
        .entity(film)
        .try_remove::<FilmBuild>()
        .try_insert((mesh, forces, constraints, stains, clock, changes, scratch))
        .try_insert((pace, shelter, DisplayChanges::default(), source, display))
        .try_insert((FilmSurveyed::default(), FilmSummary::default()))
        .try_insert(CoatedBy(root));
    if let Some(history) = history {
        commands.entity(film).try_insert(history);
    }
    if let Some(error) = refused {
        warn!("film {film} is not as it was saved, and begins at its start age: {error}");
        commands.write_message(RestoreFailed { entity: film, root, error });
    }
    commands.write_message(FilmReady { entity: film, root, triangles, warnings });
}

/// Keeps the film that a prop has, as no other can be built with the fields `key` of its coating. Logs the reason and
/// sends [`FilmFailed`].
pub(super) fn keep_old(commands: &mut Commands, film: Entity, root: Entity, key: FilmKey, cause: CoatingFault) {
    let error = CoatingError { entity: film, cause };
    error!("{error}; it keeps the film that it has");
    commands.queue(move |world: &mut World| {
        let valid = world.get::<Coating>(root).is_some_and(|coating| coating.validate().is_ok());
        let Ok(mut entity) = world.get_entity_mut(film) else { return };
        entity.remove::<(FilmBuild, FilmOutdated)>();
        if let Some(mut source) = entity.get_mut::<FilmSource>() {
            source.refused = Some(RefusedKey { key, valid });
        }
    });
    commands.write_message(FilmFailed { entity: film, root, error });
}

/// Marks meshes as refused. Logs the reason and sends [`FilmFailed`], unless the meshes were refused for the same
/// reason before.
pub(super) fn refuse(
    commands: &mut Commands,
    film: Entity,
    root: Entity,
    meshes: Vec<Entity>,
    refused: &Query<&FilmRefused>,
    cause: CoatingFault,
) {
    tell(commands, film, root, &meshes, refused, &cause);
    commands.queue(move |world: &mut World| {
        let mates: Arc<[Entity]> = meshes.as_slice().into();
        for mesh in meshes {
            let seen = suspects_of(world, mesh, root);
            let Ok(mut entity) = world.get_entity_mut(mesh) else { continue };
            entity.remove::<(AwaitingFilm, FilmSlot, LeftAlone)>();
            if let Some(seen) = seen {
                entity.insert(FilmRefused { root, film, mates: mates.clone(), cause: cause.clone(), seen });
            }
        }
    });
}

/// Logs why meshes are refused and sends [`FilmFailed`], unless that was told before.
fn tell(
    commands: &mut Commands,
    film: Entity,
    root: Entity,
    meshes: &[Entity],
    refused: &Query<&FilmRefused>,
    cause: &CoatingFault,
) {
    // As text, since a cause that holds NaN is not equal to itself.
    let text = cause.to_string();
    let known = |&mesh: &Entity| {
        refused.get(mesh).is_ok_and(|r| r.root == root && r.film == film && r.cause.to_string() == text)
    };
    if meshes.iter().all(known) {
        return;
    }
    let error = CoatingError { entity: film, cause: cause.clone() };
    error!("{error}");
    commands.write_message(FilmFailed { entity: film, root, error });
}
