//! Begins to build films: groups meshes, waits for their assets, and refuses meshes that cannot be coated.

use std::sync::Arc;

use bevy::{
    ecs::{
        entity::Entity,
        hierarchy::{ChildOf, Children},
        reflect::AppTypeRegistry,
        system::{Commands, Query},
        world::{EntityRef, World},
    },
    math::Vec3,
    mesh::{Mesh3d, skinning::SkinnedMesh},
    tasks::AsyncComputeTaskPool,
    transform::components::{GlobalTransform, Transform},
};

use super::{
    build::{FilmBuild, FilmOrder, build_film},
    finish::refuse,
};
#[cfg(feature = "render")]
use crate::{api::stain_display::StainDisplay, display::CoatedMaterial};
use crate::{
    api::{
        assets::{Waited, loaded},
        clock::CoatingGravity,
        coating::{Coating, SettingsSource},
        error::CoatingFault,
        links::{AwaitingFilm, CoatedBy, FilmSlot},
        shelter::Shelter,
        weather::CoatingWeather,
    },
    display::FilmPaint,
    settings::CoatingSettings,
    shelter::ShelterScene,
};

/// Begins to build the films of all awaiting meshes whose assets are loaded.
pub(super) fn begin_builds(world: &World, mut commands: Commands, awaiting: Query<(Entity, &AwaitingFilm)>) {
    let mut done: Vec<Entity> = Vec::new();
    for (entity, &AwaitingFilm { root }) in &awaiting {
        if done.contains(&entity) {
            continue;
        }
        let Some(coating) = world.get::<Coating>(root) else { continue };
        let (film, slots) = group_of(world, entity, root);
        done.extend(&slots);
        let order = match order_film(world, film, root, &slots, coating) {
            Ok(None) => continue,
            Ok(Some(order)) => order,
            Err(fault) => {
                refuse(&mut commands, film, root, &slots, fault);
                continue;
            }
        };
        for &slot in &slots {
            let Some(mesh) = world.get::<Mesh3d>(slot) else { continue };
            let claim = FilmSlot { film, original: mesh.0.clone(), display_mesh: None };
            commands.entity(slot).try_remove::<AwaitingFilm>().try_insert(claim);
        }
        let (key, scale) = (order.key, order.scale);
        let task = AsyncComputeTaskPool::get().spawn(async move { build_film(&order) });
        commands.entity(film).try_insert((CoatedBy(root), FilmBuild { task, root, slots, key, scale }));
    }
}

/// Returns the entity of the film for the mesh of `entity`, and the entities of all meshes that share it: its siblings
/// with an identity transform, unless the parent has a mesh itself.
fn group_of(world: &World, entity: Entity, root: Entity) -> (Entity, Vec<Entity>) {
    let alone = (entity, vec![entity]);
    let in_place = |e: Entity| world.get::<Transform>(e).is_some_and(|t| *t == Transform::IDENTITY);
    let Some(&ChildOf(parent)) = world.get::<ChildOf>(entity) else { return alone };
    if entity == root || !in_place(entity) || world.get::<Mesh3d>(parent).is_some() {
        return alone;
    }
    let belongs = |e: Entity| in_place(e) && world.get::<AwaitingFilm>(e).is_some_and(|a| a.root == root);
    let siblings = world.get::<Children>(parent).into_iter().flatten();
    let group: Vec<Entity> = siblings.copied().filter(|&e| e != root && belongs(e)).collect();
    // A parent that carries a film already cannot carry another.
    if group.len() < 2 || world.get::<CoatedBy>(parent).is_some() { alone } else { (parent, group) }
}

/// Collects the inputs of a build; `None` while assets are loading or shelters are not known.
///
/// # Errors
/// [`CoatingFault`] if the meshes cannot be coated.
fn order_film(world: &World, film: Entity, root: Entity, slots: &[Entity], coating: &Coating) -> Waited<FilmOrder> {
    coating.validate()?;
    let Some(settings) = settings_of(world, &coating.settings)? else { return Ok(None) };
    let mut meshes = Vec::with_capacity(slots.len());
    for &slot in slots {
        let Ok(entity) = world.get_entity(slot) else { return Ok(None) };
        check_components(world, entity, coating)?;
        #[cfg(feature = "render")]
        if !crate::display::is_material_ready(world, entity)? {
            return Ok(None);
        }
        let Some(Mesh3d(handle)) = entity.get::<Mesh3d>() else { return Ok(None) };
        match loaded(world, handle, CoatingFault::MeshNotLoaded)? {
            Some(mesh) => meshes.push(mesh.clone()),
            None => return Ok(None),
        }
    }
    let transform = world.get::<GlobalTransform>(film).copied().unwrap_or_default();
    let (scale, ..) = transform.to_scale_rotation_translation();
    if !scale.is_finite() || scale.min_element() == 0.0 || scale.x * scale.y * scale.z == 0.0 {
        return Err(CoatingFault::Scale(scale.x, scale.y, scale.z));
    }
    let gravity = world.get_resource::<CoatingGravity>().copied().unwrap_or_default();
    let weather = world.get_resource::<CoatingWeather>().copied().unwrap_or_default();
    let environment = weather.environment(gravity, &transform);
    let mut shelter = None;
    if coating.shelter == Shelter::Scene
        && weather.reaches_anything()
        && let Some(scene) = world.get_resource::<ShelterScene>()
    {
        shelter = scene.order(&environment, &transform, root, slots);
        if shelter.is_none() {
            return Ok(None);
        }
    }
    let paint = FilmPaint::new(coating, Vec3::ZERO);
    let (key, quality) = (coating.key(), coating.quality);
    Ok(Some(FilmOrder { meshes, key, settings, quality, scale, environment, shelter, paint }))
}

/// Returns the settings of a coating once they are loaded, and checks them.
fn settings_of(world: &World, source: &SettingsSource) -> Waited<Arc<CoatingSettings>> {
    let settings = match source {
        SettingsSource::Inline(settings) => Some(settings),
        SettingsSource::Asset(handle) => loaded(world, handle, CoatingFault::SettingsNotLoaded)?,
    };
    settings.map(|settings| Ok(settings.validate().map(|()| Arc::new(settings.clone()))?)).transpose()
}

/// Refuses skinned and morphed meshes, and custom materials where they would have to be replaced. Types that are not
/// part of every build of Bevy are recognised by their type paths.
fn check_components(
    world: &World,
    entity: EntityRef,
    #[cfg_attr(not(feature = "render"), expect(unused_variables, reason = "there are no materials"))] coating: &Coating,
) -> Result<(), CoatingFault> {
    if entity.contains::<SkinnedMesh>() {
        return Err(CoatingFault::Skinned);
    }
    let Some(registry) = world.get_resource::<AppTypeRegistry>() else { return Ok(()) };
    let registry = registry.read();
    let infos = entity.archetype().components().iter().filter_map(|&id| world.components().get_info(id));
    for path in infos.filter_map(|info| registry.get_type_info(info.type_id()?)).map(|info| info.type_path()) {
        if path == "bevy_mesh::morph::MeshMorphWeights" {
            return Err(CoatingFault::Morphed);
        }
        #[cfg(feature = "render")]
        if coating.stain_display == StainDisplay::Material
            && let Some(material) = path.strip_prefix("bevy_pbr::mesh_material::MeshMaterial3d<")
            && !entity.contains::<CoatedMaterial>()
            && material != "bevy_pbr::pbr_material::StandardMaterial>"
        {
            return Err(CoatingFault::CustomMaterial { material: material.trim_end_matches('>').into() });
        }
    }
    Ok(())
}
