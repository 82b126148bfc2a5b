//! Gives clones of coated meshes films of their own, in the state of the original's.

use bevy::{
    asset::Assets,
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        hierarchy::ChildOf,
        query::Added,
        system::{Query, SystemState},
        world::World,
    },
    mesh::{Mesh, Mesh3d},
};

use super::{build::FilmBuild, detach::hide_slot, hierarchy::Coatings};
use crate::{
    api::{
        film_pace::FilmPace,
        links::{CoatedBy, CoatedMesh, CoatingPart, FilmSlot, FilmSource},
        messages::FilmReady,
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
    timeline::FilmHistory,
};

/// Clone of a mesh that has a film.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Copied {
    /// Film of the original.
    of: Entity,
    /// Entity with the clone's coating.
    root: Entity,
    /// Entity on which the clone's film will be.
    film: Entity,
    /// Slot of the film.
    number: usize,
    /// The clone.
    mesh: Entity,
}

/// Gives each clone of a coated mesh a film of its own: a copy of the original's where the clone has the same coating,
/// and otherwise none, as if it had been spawned with its own mesh.
///
/// A clone is told by its [`FilmSlot`], which names a film that does not know it.
pub(super) fn copy_clones(
    world: &mut World,
    state: &mut SystemState<(
        Query<(Entity, &FilmSlot), Added<FilmSlot>>,
        Query<(Option<&FilmSource>, Option<&FilmBuild>)>,
        Query<(Entity, &ChildOf), Added<CoatingPart>>,
        Coatings,
    )>,
) {
    let mut clones: Vec<Entity> = Vec::new();
    let mut copies: Vec<Copied> = Vec::new();
    let mut strays: Vec<Entity> = Vec::new();
    {
        let Ok((added, films, parts, coatings)) = state.get(world) else { return };
        for (mesh, slot) in &added {
            let (source, build) = films.get(slot.film).unwrap_or_default();
            let knows = source.is_some_and(|source| source.slots.contains(&mesh))
                || build.is_some_and(|build| build.slots.contains(&mesh));
            if !knows {
                clones.push(mesh);
                copies.extend(place_of(world, &coatings, mesh, slot, source));
            }
        }
        strays.extend(parts.iter().filter(|(part, parent)| !is_own_part(world, *part, parent.0)).map(|(part, _)| part));
    }
    for part in strays {
        world.despawn(part);
    }
    for &mesh in &clones {
        restore_clone(world, mesh);
    }
    copies.sort_unstable();
    for group in copies.chunk_by(|a, b| (a.of, a.film) == (b.of, b.film)) {
        copy_film(world, group);
    }
}

/// Returns whether the film of the mesh on `parent` draws its backs or metal with `part`.
fn is_own_part(world: &World, part: Entity, parent: Entity) -> bool {
    let film = world.get::<FilmSlot>(parent).map(|slot| slot.film);
    film.and_then(|film| world.get::<FilmDisplay>(film)).is_some_and(|display| display.has_part(part))
}

/// Returns where the film of a clone will be; `None` if it cannot be a copy of the original's.
fn place_of(
    world: &World,
    coatings: &Coatings,
    mesh: Entity,
    slot: &FilmSlot,
    source: Option<&FilmSource>,
) -> Option<Copied> {
    let source = source?;
    let root = coatings.root_of(mesh)?;
    if !source.key.serves(&coatings.coatings.get(root).ok()?.key()) {
        return None;
    }
    // The clone has no link to its original but the mesh, which only one slot shows.
    let shown = |&own: &Entity| {
        own != Entity::PLACEHOLDER
            && world.get::<FilmSlot>(own).is_some_and(|own| own.display_mesh == slot.display_mesh)
    };
    let number = source.slots.iter().position(shown)?;
    let original = *source.slots.get(number)?;
    let parent = world.get::<ChildOf>(mesh).map(|parent| parent.0);
    // Below a clone of the film's entity, the film is there again. A clone beside its original has a film of its own.
    let shared = original != slot.film;
    let above = parent
        .filter(|&parent| shared && world.get::<FilmSource>(parent).is_none() && coatings.is_in_place(mesh, parent));
    Some(Copied { of: slot.film, root, film: above.unwrap_or(mesh), number, mesh })
}

/// Gives a clone the mesh and the material of the prop itself and unlinks it from the original's film.
fn restore_clone(world: &mut World, mesh: Entity) {
    let Ok(mut clone) = world.get_entity_mut(mesh) else { return };
    let Some(slot) = clone.take::<FilmSlot>() else { return };
    clone.remove::<CoatedMesh>();
    if let Some(mut shown) = clone.get_mut::<Mesh3d>() {
        if slot.display_mesh.as_ref() == Some(&shown.0) {
            shown.0 = slot.original;
        }
        shown.set_changed();
    }
    #[cfg(feature = "render")]
    crate::display::undress(&mut clone);
}

/// Puts a copy of a film on the clones in `group`, which are of one film and will share one.
fn copy_film(world: &mut World, group: &[Copied]) {
    let Some(&Copied { of, root, film, .. }) = group.first() else { return };
    let Ok(original) = world.get_entity(of) else { return };
    let parts = original.get_components::<(
        &FilmMesh,
        &FilmForces,
        &FilmConstraints,
        &StainFields,
        &FilmClock,
        &FilmChanges,
        (&StepScratch, &FilmPace, &DisplayChanges, &FilmSource, &FilmDisplay, &FilmShelter),
    )>();
    let Ok((mesh, forces, constraints, stains, clock, changes, rest)) = parts else { return };
    let (scratch, pace, shown, source, display, shelter) = rest;
    let triangles = mesh.topology.face_count();
    let mut source = source.clone();
    let whole = source.slots.len();
    source.slots = vec![Entity::PLACEHOLDER; whole];
    for copied in group {
        if let Some(slot) = source.slots.get_mut(copied.number) {
            *slot = copied.mesh;
        }
    }
    let slots = source.slots.clone();
    let film_parts = (mesh.clone(), forces.clone(), constraints.clone(), stains.clone(), *clock, changes.clone());
    let history = original.get::<FilmHistory>().map(FilmHistory::copy);
    let scratch = scratch.clone();
    let pace = pace.clone();
    let (shown, shelter) = (*shown, FilmShelter { choice: shelter.choice, ..FilmShelter::default() });
    let Some(assets) = world.get_resource::<Assets<Mesh>>() else { return };
    let mut display = display.copy(assets);
    let Some(mut assets) = world.get_resource_mut::<Assets<Mesh>>() else { return };
    let handles = display.put_on(&mut assets);
    for (&slot, handle) in slots.iter().zip(&handles) {
        let Ok(mut entity) = world.get_entity_mut(slot) else { continue };
        let Some(mut mesh) = entity.get_mut::<Mesh3d>() else { continue };
        let original = mesh.0.clone();
        let handle = handle.clone().unwrap_or_else(|| original.clone());
        mesh.0 = handle.clone();
        let own = CoatedMesh(original.clone());
        entity.insert((own, FilmSlot { film, original, display_mesh: Some(handle) }));
    }
    let Ok(mut entity) = world.get_entity_mut(film) else { return };
    entity.insert(film_parts).insert((scratch, pace, shown, shelter, source, display, CoatedBy(root)));
    entity.insert((FilmSurveyed::default(), FilmSummary::default()));
    if let Some(history) = history {
        entity.insert(history);
    }
    for (number, &slot) in slots.iter().enumerate() {
        if slot == Entity::PLACEHOLDER {
            hide_slot(world, film, number);
        }
    }
    world.write_message(FilmReady { entity: film, root, triangles, warnings: Vec::new() });
}
