//! Begins to build films: waits for the assets of a prop's meshes, leaves glass alone, and refuses meshes that cannot
//! be coated.

use bevy::{
    asset::AssetServer,
    ecs::{
        entity::Entity,
        query::{With, Without},
        system::{Commands, Query},
        world::World,
    },
    log::warn,
    math::Vec3,
    mesh::Mesh3d,
    tasks::AsyncComputeTaskPool,
    transform::components::GlobalTransform,
};

use super::{
    build::{FilmBuild, FilmOrder, build_film},
    finish::{keep_old, refuse},
    group::group_of,
    masks::SharedImages,
    order::{FilmInputs, inputs_of},
    share::{area_of_film, area_of_slots, targets_of},
    suspects::suspects_of,
};
use crate::{
    api::{
        assets::Waited,
        coating::Coating,
        error::CoatingFault,
        links::{AwaitingFilm, CoatedBy, FilmOutdated, FilmRefused, FilmSlot, FilmSource, LeftAlone},
        seed::CoatingSeed,
        snapshot::CoatingSnapshot,
    },
    display::FilmPaint,
    sim::{film_seed, place_seed},
    timeline::{path_to, written_path},
};

/// Query of the films that are ready or being built.
type Films<'w, 's> =
    Query<'w, 's, (Entity, &'static CoatedBy, Option<&'static FilmSource>, Option<&'static FilmBuild>)>;

/// Film to be built.
struct Candidate {
    film: Entity,
    /// Entities whose meshes make up the film, by slot.
    slots: Vec<Entity>,
    /// Whether the film replaces an older one.
    renews: bool,
}

/// Begins to build the films of all awaiting meshes whose assets are loaded, and of all films that are outdated.
pub(super) fn begin_builds(
    world: &World,
    mut commands: Commands,
    awaiting: Query<(Entity, &AwaitingFilm)>,
    outdated: Query<(Entity, &CoatedBy, &FilmSource), (With<FilmOutdated>, Without<FilmBuild>)>,
    films: Films,
    refused: Query<&FilmRefused>,
) {
    // Coating by coating, as the films of one share its triangles.
    let mut members: Vec<(Entity, Option<Entity>)> =
        awaiting.iter().map(|(entity, awaiting)| (awaiting.root, Some(entity))).collect();
    members.extend(outdated.iter().map(|(_, coated_by, _)| (coated_by.0, None)));
    members.sort_unstable();
    for group in members.chunk_by(|(a, _), (b, _)| a == b) {
        let Some(&(root, _)) = group.first() else { continue };
        let Some(coating) = world.get::<Coating>(root) else { continue };
        let meshes: Vec<Entity> = group.iter().filter_map(|&(_, mesh)| mesh).collect();
        let meshes = leave_glass_alone(world, &mut commands, root, meshes);
        if coating.resolution.is_shared() && meshes.iter().any(|&mesh| is_loading(world, mesh)) {
            // The shares are known when all meshes are.
            continue;
        }
        let mut candidates = group_meshes(world, root, &meshes);
        candidates.extend(
            outdated.iter().filter(|(_, coated_by, _)| coated_by.0 == root).map(|(film, _, source)| Candidate {
                film,
                slots: source.live_slots().collect(),
                renews: true,
            }),
        );
        begin_films(world, &mut commands, root, coating, candidates, &films, &refused);
    }
}

/// Returns whether the mesh asset of `entity` is being loaded.
fn is_loading(world: &World, entity: Entity) -> bool {
    let server = world.get_resource::<AssetServer>();
    world.get::<Mesh3d>(entity).zip(server).is_some_and(|(mesh, server)| server.load_state(mesh.id()).is_loading())
}

/// Takes meshes with materials like glass out of those that await a film, and returns the others. A mesh that has the
/// coating itself is refused later.
fn leave_glass_alone(world: &World, commands: &mut Commands, root: Entity, mut meshes: Vec<Entity>) -> Vec<Entity> {
    let mut left = 0;
    meshes.retain(|&mesh| {
        let glass = mesh != root && matches!(transparency(world, mesh), Ok(Some(Some(_))));
        if glass && let Some(seen) = suspects_of(world, mesh, root) {
            left += 1;
            commands.entity(mesh).try_remove::<(AwaitingFilm, FilmRefused)>().try_insert(LeftAlone { root, seen });
        }
        !glass
    });
    if left > 0 {
        warn!(
            "coating {root} leaves {left} of its meshes as they are: their materials are alpha-blended or \
             transmissive; `CoatingExclude` on them says that this is meant, another `AlphaMode` coats them"
        );
    }
    meshes
}

/// Returns why one looks through the mesh of `entity`; see [`transparency_of`](crate::display::transparency_of).
#[cfg(feature = "render")]
fn transparency(world: &World, entity: Entity) -> Waited<Option<CoatingFault>> {
    world.get_entity(entity).map_or(Ok(None), |entity| crate::display::transparency_of(world, entity))
}

/// Returns that every mesh is opaque, as there are no materials.
#[cfg(not(feature = "render"))]
fn transparency(_: &World, _: Entity) -> Waited<Option<CoatingFault>> {
    Ok(Some(None))
}

/// Groups the awaiting meshes of a coating by the films that they share.
fn group_meshes(world: &World, root: Entity, meshes: &[Entity]) -> Vec<Candidate> {
    let mut candidates: Vec<Candidate> = Vec::new();
    let mut done: Vec<Entity> = Vec::new();
    for &mesh in meshes {
        if done.binary_search(&mesh).is_ok() {
            continue;
        }
        let (film, slots) = group_of(world, mesh, root, |mesh| meshes.binary_search(&mesh).is_ok());
        if slots.len() > 1 {
            done.extend(&slots);
            done.sort_unstable();
        }
        candidates.push(Candidate { film, slots, renews: false });
    }
    candidates
}

/// Begins the builds of those films of a coating whose inputs are complete.
fn begin_films(
    world: &World,
    commands: &mut Commands,
    root: Entity,
    coating: &Coating,
    candidates: Vec<Candidate>,
    films: &Films,
    refused: &Query<&FilmRefused>,
) {
    let mut found = Vec::with_capacity(candidates.len());
    let mut images = SharedImages::new();
    for candidate in candidates {
        match check_candidate(world, root, coating, &candidate, &mut images) {
            Ok(inputs) => found.push((candidate, inputs)),
            Err(fault) if candidate.renews => keep_old(commands, candidate.film, root, coating.key(), fault),
            Err(fault) => {
                refuse(commands, candidate.film, root, candidate.slots, refused, fault);
            }
        }
    }
    // The settings of all films of a coating are the same.
    let settings = found.iter().find_map(|(_, inputs)| inputs.as_ref()).map(|inputs| inputs.settings.clone());
    let Some(settings) = settings else { return };
    // Meshes that still wait for something count, so that shares do not depend on the order in which assets arrive.
    let areas: Vec<f64> = found.iter().map(|(candidate, _)| area_of_slots(world, &candidate.slots)).collect();
    let others = films.iter().filter(|(film, coated_by, ..)| {
        coated_by.0 == root && !found.iter().any(|(candidate, _)| candidate.film == *film)
    });
    let others: Vec<f64> = others.filter_map(|(.., source, build)| area_of_film(source, build)).collect();
    let targets = targets_of(coating.resolution, settings.scale.grain, &areas, &others);
    let base = coating.seed.unwrap_or_else(|| seed_of_place(world, commands, root));
    for (((candidate, inputs), target), area) in found.into_iter().zip(targets).zip(areas) {
        let Some(inputs) = inputs else { continue };
        let seed = film_seed(base, &path_to(world, root, candidate.film));
        let paint = FilmPaint::new(coating, seed, Vec3::ZERO);
        let order = FilmOrder { inputs, target, seed, paint };
        begin(world, commands, root, candidate, order, area);
    }
}

/// Collects the inputs of a film; `None` while something is being loaded.
///
/// # Errors
/// [`CoatingFault`] if the meshes cannot be coated.
fn check_candidate(
    world: &World,
    root: Entity,
    coating: &Coating,
    candidate: &Candidate,
    images: &mut SharedImages,
) -> Waited<FilmInputs> {
    // The meshes of a film that is shown have been found opaque, and wear stained materials now.
    let unseen: &[Entity] = if candidate.renews { &[] } else { &candidate.slots };
    for &slot in unseen {
        match transparency(world, slot)? {
            Some(None) => (),
            Some(Some(fault)) => return Err(fault),
            None => return Ok(None),
        }
    }
    // A film that is built again is not what was saved.
    let snapshot = world.get::<CoatingSnapshot>(root).filter(|_| !candidate.renews);
    let state = snapshot.and_then(|saved| saved.film_at(&written_path(world, root, candidate.film)));
    let saved = snapshot.zip(state).map(|(saved, state)| (state.clone(), saved.date));
    inputs_of(world, candidate.film, root, &candidate.slots, coating, saved, images)
}

/// Returns the seed that was drawn for the coating on `root`, also before it was saved, or draws it from its place.
fn seed_of_place(world: &World, commands: &mut Commands, root: Entity) -> u64 {
    world.get::<CoatingSeed>(root).map_or_else(
        || {
            let place = world.get::<GlobalTransform>(root).copied().unwrap_or_default().translation();
            let saved = world.get::<CoatingSnapshot>(root).map(|snapshot| snapshot.seed);
            let seed = CoatingSeed(saved.unwrap_or_else(|| place_seed(place)));
            commands.entity(root).try_insert(seed);
            seed.0
        },
        |seed| seed.0,
    )
}

/// Begins the build of one film.
fn begin(world: &World, commands: &mut Commands, root: Entity, candidate: Candidate, order: FilmOrder, area: f64) {
    let Candidate { film, slots, renews, .. } = candidate;
    if !renews {
        for &slot in &slots {
            let Some(mesh) = world.get::<Mesh3d>(slot) else { continue };
            let claim = FilmSlot { film, original: mesh.0.clone(), display_mesh: None };
            commands.entity(slot).try_remove::<AwaitingFilm>().try_insert(claim);
        }
    }
    let FilmInputs { key, scale, metres_per_unit, date, .. } = order.inputs;
    let seed = order.seed;
    let task = AsyncComputeTaskPool::get().spawn(build_film(order));
    let build = FilmBuild { task, root, slots, key, seed, scale, metres_per_unit, area, date, stale: false };
    commands.entity(film).try_insert((CoatedBy(root), build));
}
