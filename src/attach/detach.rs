//! Takes a film off its prop, which gets its own mesh back.

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        hierarchy::Children,
        lifecycle::Remove,
        observer::On,
        query::Or,
        query::With,
        system::{Commands, Query},
        world::World,
    },
    mesh::Mesh3d,
};

use super::build::FilmBuild;
use crate::{
    api::{
        coating::Coating,
        film_pace::FilmPace,
        links::{AwaitingFilm, CoatedBy, CoatingPart, FilmRefused, FilmSlot, FilmSource},
    },
    appearance::DisplayChanges,
    deform::FilmConstraints,
    display::FilmDisplay,
    film::{FilmChanges, FilmMesh},
    fracture::FilmForces,
    shelter::FilmShelter,
    sim::{FilmClock, StepScratch},
    stain::StainFields,
};

/// Components that the plugin puts on the entity of a film.
pub(super) type FilmComponents = (
    (FilmMesh, FilmForces, FilmConstraints, StainFields, FilmClock, FilmChanges, StepScratch),
    (CoatedBy, FilmPace, FilmShelter, DisplayChanges, FilmSource, FilmBuild, FilmDisplay),
);

/// Takes off the film on entity `film`, whether it is ready or being built. Its meshes are marked as changed, so that
/// `find_meshes` checks them in the next frame. Despawned entities are skipped.
pub(super) fn detach_film(commands: &mut Commands, film: Entity) {
    commands.queue(move |world: &mut World| detach_now(world, film));
}

/// Takes off the film on `film` at once.
fn detach_now(world: &mut World, film: Entity) {
    let Ok(mut entity) = world.get_entity_mut(film) else { return };
    let source = entity.get::<FilmSource>().map(|source| source.slots.clone());
    let slots = source.or(entity.get::<FilmBuild>().map(|build| build.slots.clone())).unwrap_or_default();
    entity.remove::<FilmComponents>();
    despawn_parts(world, film);
    for slot in slots {
        let Ok(mut leaf) = world.get_entity_mut(slot) else { continue };
        // A slot may have a new film by now.
        if leaf.get::<FilmSlot>().is_none_or(|slot| slot.film != film) {
            continue;
        }
        let Some(FilmSlot { original, display_mesh, .. }) = leaf.take::<FilmSlot>() else { continue };
        if let Some(mut mesh) = leaf.get_mut::<Mesh3d>() {
            // A mesh that the game has put there meanwhile stays.
            if display_mesh.is_some_and(|display_mesh| mesh.0 == display_mesh) {
                mesh.0 = original;
            }
            mesh.set_changed();
        }
    }
}

/// Despawns the children that draw backs and bare metal.
fn despawn_parts(world: &mut World, film: Entity) {
    let children: Vec<Entity> = world.get::<Children>(film).map(|children| children.to_vec()).unwrap_or_default();
    for child in children {
        if world.get::<CoatingPart>(child).is_some() {
            world.despawn(child);
        }
    }
}

/// Takes off all films of a coating that was removed, and unmarks the meshes that waited for it.
pub(super) fn on_coating_removed(
    removed: On<Remove, Coating>,
    mut commands: Commands,
    films: Query<(Entity, &CoatedBy)>,
    marked: Query<(Entity, Option<&AwaitingFilm>, Option<&FilmRefused>), Or<(With<AwaitingFilm>, With<FilmRefused>)>>,
) {
    let root = removed.entity;
    for (film, coated_by) in &films {
        if coated_by.0 == root {
            detach_film(&mut commands, film);
        }
    }
    for (entity, awaiting, refused) in &marked {
        if awaiting.is_some_and(|a| a.root == root) || refused.is_some_and(|r| r.root == root) {
            commands.entity(entity).try_remove::<(AwaitingFilm, FilmRefused)>();
            // Another coating further up may claim it now.
            commands.queue(move |world: &mut World| {
                if let Some(mut mesh) = world.get_mut::<Mesh3d>(entity) {
                    mesh.set_changed();
                }
            });
        }
    }
}
