//! Looks again at meshes that were refused or left alone, once the cause may have been mended.

use bevy::{
    asset::{AssetEvent, AssetId},
    ecs::{
        entity::Entity,
        message::MessageReader,
        query::Without,
        system::{Commands, Local, Query},
        world::World,
    },
    mesh::Mesh,
};

use super::{build::FilmBuild, suspects::suspects_of};
use crate::{
    api::{
        coating::Coating,
        links::{AwaitingFilm, FilmRefused, FilmSlot, LeftAlone, Suspects},
        paint::SettingsSource,
    },
    settings::CoatingSettings,
};

/// Marks refused meshes, unless they are being built again, as awaiting when their mesh, material, settings,
/// components, scale or coating changed. All meshes that would have shared a film are looked at together. Builds whose
/// meshes changed learn of it.
pub(super) fn recheck_refused(
    world: &World,
    mut commands: Commands,
    refused: Query<(Entity, &FilmRefused), (Without<AwaitingFilm>, Without<FilmSlot>)>,
    marks: Query<&FilmRefused>,
    left_alone: Query<(Entity, &LeftAlone), Without<AwaitingFilm>>,
    builds: Query<(Entity, &FilmBuild)>,
    slots: Query<&FilmSlot>,
    mut meshes: MessageReader<AssetEvent<Mesh>>,
    mut settings: MessageReader<AssetEvent<CoatingSettings>>,
    #[cfg(feature = "render")] mut materials: Option<MessageReader<AssetEvent<bevy::pbr::StandardMaterial>>>,
    mut again: Local<Vec<Entity>>,
) {
    let meshes: Vec<AssetId<Mesh>> = meshes.read().filter_map(edited).collect();
    if !meshes.is_empty() {
        // A build that ends with a fault has not seen them.
        let is_edited = |&slot: &Entity| slots.get(slot).is_ok_and(|slot| meshes.contains(&slot.original.id()));
        for (film, _) in builds.iter().filter(|(_, build)| build.slots.iter().any(is_edited)) {
            commands.queue(move |world: &mut World| {
                if let Some(mut build) = world.get_mut::<FilmBuild>(film) {
                    build.stale = true;
                }
            });
        }
    }
    if refused.is_empty() && left_alone.is_empty() {
        settings.clear();
        #[cfg(feature = "render")]
        materials.iter_mut().for_each(MessageReader::clear);
        return;
    }
    let settings: Vec<AssetId<CoatingSettings>> = settings.read().filter_map(edited).collect();
    #[cfg(feature = "render")]
    let materials: Vec<_> = materials.iter_mut().flat_map(MessageReader::read).filter_map(edited).collect();
    let changed = |entity: Entity, root: Entity, seen: &Suspects| {
        let reloaded = match world.get::<Coating>(root).map(|coating| &coating.settings) {
            Some(SettingsSource::Asset(handle)) => settings.contains(&handle.id()),
            _ => false,
        };
        #[cfg(feature = "render")]
        let reloaded = reloaded || seen.material.is_some_and(|material| materials.contains(&material));
        reloaded || meshes.contains(&seen.mesh) || suspects_of(world, entity, root).as_ref() != Some(seen)
    };
    again.clear();
    // A mate that was swapped, moved away or despawned may have been the cause, too.
    let parted = |r: &FilmRefused| r.mates.iter().any(|&mate| marks.get(mate).map_or(true, |m| m.film != r.film));
    let retried = refused.iter().filter(|(entity, r)| changed(*entity, r.root, &r.seen) || parted(r));
    again.extend(retried.map(|(_, r)| r.film));
    for (entity, FilmRefused { root, film, .. }) in &refused {
        if again.contains(film) {
            commands.entity(entity).try_insert(AwaitingFilm { root: *root });
        }
    }
    for (entity, LeftAlone { root, seen }) in &left_alone {
        if changed(entity, *root, seen) {
            commands.entity(entity).try_remove::<LeftAlone>().try_insert(AwaitingFilm { root: *root });
        }
    }
}

/// Returns the asset that was added or changed.
fn edited<A: bevy::asset::Asset>(event: &AssetEvent<A>) -> Option<AssetId<A>> {
    match event {
        AssetEvent::Added { id } | AssetEvent::Modified { id } => Some(*id),
        _ => None,
    }
}
