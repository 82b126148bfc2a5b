//! Puts finished films on their props, and refuses meshes that could not be coated.

use bevy::{
    asset::Assets,
    ecs::{
        entity::Entity,
        system::{Commands, Query, ResMut},
    },
    log::error,
    mesh::{Mesh, Mesh3d},
    tasks::futures::check_ready,
};

use super::{
    build::{FilmBuild, FilmReadiness},
    detach::detach_film,
};
use crate::{
    api::{
        coating::Coating,
        error::{CoatingError, CoatingFault},
        film_pace::FilmPace,
        links::{AwaitingFilm, CoatedBy, FilmRefused, FilmSlot, FilmSource},
        messages::{FilmFailed, FilmReady},
    },
    appearance::DisplayChanges,
    sim::FilmState,
};

/// Puts finished films on their props.
pub(super) fn finish_builds(
    mut commands: Commands,
    mut builds: Query<(Entity, &mut FilmBuild)>,
    slots: Query<(&Mesh3d, &FilmSlot)>,
    coatings: Query<&Coating>,
    mut assets: ResMut<Assets<Mesh>>,
) {
    for (film, mut build) in &mut builds {
        let Some(result) = check_ready(&mut build.task) else { continue };
        // If a mesh was swapped or despawned meanwhile, the build is discarded and the meshes are checked again.
        let current =
            |&slot: &Entity| slots.get(slot).is_ok_and(|(mesh, slot)| slot.film == film && mesh.0 == slot.original);
        let Ok(coating) = coatings.get(build.root) else {
            detach_film(&mut commands, film);
            continue;
        };
        if !build.slots.iter().all(current) {
            detach_film(&mut commands, film);
            continue;
        }
        match result {
            Err(fault) => {
                commands.entity(film).try_remove::<(FilmBuild, CoatedBy)>();
                refuse(&mut commands, film, build.root, &build.slots, fault);
            }
            Ok(ready) => {
                let FilmReadiness { film: state, settings, warnings, mut display, mut shelter } = *ready;
                let FilmState { mesh, forces, constraints, stains, clock, changes, scratch, .. } = state;
                let triangles = mesh.topology.face_count();
                let mut pace = FilmPace::new(settings, forces.torn_edges > 0);
                // A rate that has gone out of range meanwhile is told before the first step.
                let _ = pace.follow(coating);
                pace.bounds = crate::stepping::bounds(&mesh.geometry);
                shelter.choice = coating.shelter;
                let handles = display.put_on(&mut assets);
                for (&slot, handle) in build.slots.iter().zip(handles) {
                    let Ok((_, claim)) = slots.get(slot) else { continue };
                    // A primitive of which no face was left keeps its own mesh.
                    let handle = handle.unwrap_or_else(|| claim.original.clone());
                    let claim = FilmSlot { display_mesh: Some(handle.clone()), ..claim.clone() };
                    commands.entity(slot).try_insert((Mesh3d(handle), claim));
                }
                let source = FilmSource { key: build.key, slots: std::mem::take(&mut build.slots), scale: build.scale };
                commands
                    .entity(film)
                    .try_remove::<FilmBuild>()
                    .try_insert((mesh, forces, constraints, stains, clock, changes, scratch))
                    .try_insert((pace, shelter, DisplayChanges::default(), source, display));
                commands.write_message(FilmReady { entity: film, root: build.root, triangles, warnings });
            }
        }
    }
}

/// Marks meshes as refused, logs the reason and sends [`FilmFailed`].
pub(super) fn refuse(commands: &mut Commands, film: Entity, root: Entity, slots: &[Entity], cause: CoatingFault) {
    let error = CoatingError { entity: film, cause };
    error!("{error}");
    for &slot in slots {
        commands.entity(slot).try_remove::<(AwaitingFilm, FilmSlot)>().try_insert(FilmRefused { root });
    }
    commands.write_message(FilmFailed { entity: film, root, error });
}
