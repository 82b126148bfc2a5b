//! Takes films off their props, which get their own meshes back, and single meshes out of films.

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        hierarchy::Children,
        lifecycle::Remove,
        observer::On,
        query::{Or, With},
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
        links::{
            AwaitingFilm, CoatedBy, CoatedMesh, CoatingPart, FilmOutdated, FilmRefused, FilmSlot, FilmSource, LeftAlone,
        },
        snapshot::CoatingSnapshot,
        summary::{FilmSummary, FilmSurveyed},
    },
    appearance::DisplayChanges,
    deform::FilmConstraints,
    display::FilmDisplay,
    film::{FilmChanges, FilmMesh},
    fracture::FilmForces,
    shelter::FilmShelter,
    sim::{FilmClock, StepScratch},
    stain::StainFields,
    timeline::{AgeWish, FilmHistory, FilmJourney, FilmWish},
};

/// Components that the plugin puts on the entity of a film.
pub(super) type FilmComponents = (
    (FilmMesh, FilmForces, FilmConstraints, StainFields, FilmClock, FilmChanges, StepScratch),
    (CoatedBy, FilmPace, FilmShelter, DisplayChanges, FilmSource, FilmOutdated, FilmBuild, FilmDisplay),
    (FilmHistory, FilmJourney, FilmWish, FilmSurveyed, FilmSummary),
);

/// Takes off the film on entity `film`, whether it is ready or being built. Its meshes are marked as changed, so that
/// `find_meshes` checks them in the next frame. Despawned entities are skipped.
pub(super) fn detach_film(commands: &mut Commands, film: Entity) {
    commands.queue(move |world: &mut World| detach_now(world, film));
}

/// Takes everything of a film off its entity, but leaves its meshes as they are.
pub(super) fn take_film(commands: &mut Commands, film: Entity) {
    commands.queue(move |world: &mut World| {
        if let Ok(mut entity) = world.get_entity_mut(film) {
            entity.remove::<FilmComponents>();
            despawn_parts(world, film);
        }
    });
}

/// Takes the mesh of entity `slot` out of its film. The other meshes of the film go on ageing. The mesh is marked as
/// changed, so that `find_meshes` checks it in the next frame.
pub(super) fn release_slot(commands: &mut Commands, slot: Entity) {
    commands.queue(move |world: &mut World| restore_mesh(world, slot));
}

/// Takes off the film on `film` at once.
fn detach_now(world: &mut World, film: Entity) {
    let Ok(mut entity) = world.get_entity_mut(film) else { return };
    let source = entity.get::<FilmSource>().map(|source| source.slots.clone());
    let slots = source.or(entity.get::<FilmBuild>().map(|build| build.slots.clone())).unwrap_or_default();
    entity.remove::<FilmComponents>();
    despawn_parts(world, film);
    for slot in slots {
        // A slot may have a new film by now.
        if world.get::<FilmSlot>(slot).is_some_and(|slot| slot.film == film) {
            restore_mesh(world, slot);
        }
    }
}

/// Gives the entity of a slot its own mesh back and unlinks it from its film.
fn restore_mesh(world: &mut World, slot: Entity) {
    let Ok(mut leaf) = world.get_entity_mut(slot) else { return };
    let Some(FilmSlot { original, display_mesh, .. }) = leaf.take::<FilmSlot>() else { return };
    leaf.remove::<CoatedMesh>();
    if let Some(mut mesh) = leaf.get_mut::<Mesh3d>() {
        // A mesh that the game has put there meanwhile stays.
        if display_mesh.is_some_and(|display_mesh| mesh.0 == display_mesh) {
            mesh.0 = original;
        }
        mesh.set_changed();
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

/// Takes a mesh that is despawned or unlinked out of its film, so that nothing of it stays behind as a ghost.
pub(super) fn on_slot_removed(removed: On<Remove, FilmSlot>, mut commands: Commands, slots: Query<&FilmSlot>) {
    let slot = removed.entity;
    if let Ok(&FilmSlot { film, .. }) = slots.get(slot) {
        commands.queue(move |world: &mut World| drop_slot(world, film, slot));
    }
}

/// Takes the mesh on `slot` out of the film on `film`. A film without meshes is taken off; a build in which the mesh
/// has a part begins again without it.
fn drop_slot(world: &mut World, film: Entity, slot: Entity) {
    let Ok(mut entity) = world.get_entity_mut(film) else { return };
    let is_built = entity.contains::<FilmSource>();
    if entity.get::<FilmBuild>().is_some_and(|build| build.slots.contains(&slot)) {
        if !is_built {
            detach_now(world, film);
            return;
        }
        // It is still outdated, and built again without the mesh.
        entity.remove::<FilmBuild>();
    }
    let Some(mut source) = entity.get_mut::<FilmSource>() else { return };
    let Some(number) = source.slots.iter().position(|&own| own == slot) else { return };
    source.slots[number] = Entity::PLACEHOLDER;
    if source.live_slots().next().is_none() {
        detach_now(world, film);
        return;
    }
    hide_slot(world, film, number);
}

/// Hides the faces of slot `number` of a film: nothing is drawn or told of them any more.
pub(super) fn hide_slot(world: &mut World, film: Entity, number: usize) {
    let Ok(mut entity) = world.get_entity_mut(film) else { return };
    if let Some(mut display) = entity.get_mut::<FilmDisplay>() {
        display.hide_slot(number);
        let hidden = display.hidden_faces();
        if let Some(mut source) = entity.get_mut::<FilmSource>() {
            source.hidden = hidden;
        }
    }
    if let Some(mut changes) = entity.get_mut::<DisplayChanges>() {
        (changes.topology, changes.exposure) = (true, true);
    }
}

/// Takes off all films of a coating that was removed, and unmarks the meshes that waited for it.
pub(super) fn on_coating_removed(
    removed: On<Remove, Coating>,
    mut commands: Commands,
    films: Query<(Entity, &CoatedBy)>,
    marked: Query<
        (Entity, Option<&AwaitingFilm>, Option<&FilmRefused>, Option<&LeftAlone>),
        Or<(With<AwaitingFilm>, With<FilmRefused>, With<LeftAlone>)>,
    >,
) {
    let root = removed.entity;
    // Whoever paints it afresh does not mean the old paint.
    commands.entity(root).try_remove::<(CoatingSnapshot, AgeWish)>();
    for (film, coated_by) in &films {
        if coated_by.0 == root {
            detach_film(&mut commands, film);
        }
    }
    for (entity, awaiting, refused, left_alone) in &marked {
        let roots = [awaiting.map(|a| a.root), refused.map(|r| r.root), left_alone.map(|l| l.root)];
        if roots.contains(&Some(root)) {
            commands.entity(entity).try_remove::<(AwaitingFilm, FilmRefused, LeftAlone)>();
            // Another coating further up may claim it now.
            commands.queue(move |world: &mut World| {
                if let Some(mut mesh) = world.get_mut::<Mesh3d>(entity) {
                    mesh.set_changed();
                }
            });
        }
    }
}
