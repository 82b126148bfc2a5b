//! Collects the inputs of a build, and refuses meshes that cannot be coated.

use std::sync::Arc;

use bevy::{
    ecs::{
        entity::Entity,
        reflect::AppTypeRegistry,
        world::{EntityRef, World},
    },
    math::Vec3,
    mesh::{Mesh, Mesh3d, skinning::SkinnedMesh},
    transform::components::GlobalTransform,
};

use super::masks::{MaskOrder, SharedImages, masks_of};
#[cfg(feature = "render")]
use crate::{api::stain_display::StainDisplay, display::CoatedMaterial};
use crate::{
    api::{
        assets::{Waited, loaded},
        calendar::CoatingCalendar,
        clock::{CoatingClock, CoatingGravity},
        coating::{Coating, FilmKey},
        error::CoatingFault,
        history::CoatingHistory,
        links::{FilmSlot, place_of},
        paint::SettingsSource,
        shelter::Shelter,
        unit::CoatingUnit,
        weather::{CoatingWeather, PropWeather},
    },
    deform::SolverQuality,
    settings::CoatingSettings,
    shelter::{CastOrder, ShelterScene},
    snapshot::Snapshot,
    stain::Environment,
};

/// Inputs of a build but for its seed and its resolution, as copies that are not shared with the main thread.
pub(super) struct FilmInputs {
    pub meshes: Vec<Mesh>,
    pub key: FilmKey,
    pub settings: Arc<CoatingSettings>,
    pub quality: SolverQuality,
    pub masks: MaskOrder,
    /// Scale from the meshes to the film, which is in metres.
    pub scale: Vec3,
    /// Metres that a unit of the world is long.
    pub metres_per_unit: f32,
    /// Environments that the film has lived in, with the age that it gained in each.
    pub past: Vec<(f64, Environment)>,
    /// Age beyond which no film goes; it may begin there.
    pub target: Option<f64>,
    /// Date for which the past is told.
    pub date: f64,
    /// Saved state in which the film is to begin, and what it has lived in since.
    pub saved: Option<(Snapshot, Vec<(f64, Environment)>)>,
    /// Memory for keyframes, in bytes, if the film's past is to be kept.
    pub history: Option<usize>,
    /// Meshes that may shelter the film; `None` without rain and sun, or if the coating does not ask for shelters.
    pub shelter: Option<CastOrder>,
}

/// Collects the inputs of a build; `None` while assets are loading or shelters are not known. `saved` is the state in
/// which the film is to begin, with the date at which it was saved; `images` are copies that films of the coating
/// share.
///
/// # Errors
/// [`CoatingFault`] if the meshes cannot be coated.
pub(super) fn inputs_of(
    world: &World,
    film: Entity,
    root: Entity,
    slots: &[Entity],
    coating: &Coating,
    saved: Option<(Snapshot, f64)>,
    images: &mut SharedImages,
) -> Waited<FilmInputs> {
    coating.validate()?;
    let Some(settings) = settings_of(world, &coating.settings)? else { return Ok(None) };
    let mut meshes = Vec::with_capacity(slots.len());
    for &slot in slots {
        let Ok(entity) = world.get_entity(slot) else { return Ok(None) };
        check_components(world, entity, coating)?;
        // A mesh that has a film already shows that film, but is built from its own shape.
        let own = entity.get::<FilmSlot>().map(|claim| &claim.original).or(entity.get::<Mesh3d>().map(|mesh| &mesh.0));
        let Some(handle) = own else { return Ok(None) };
        match loaded(world, handle, CoatingFault::MeshNotLoaded)? {
            Some(mesh) => meshes.push(mesh),
            None => return Ok(None),
        }
    }
    let transform = world.get::<GlobalTransform>(film).copied().unwrap_or_default();
    let (scale, ..) = transform.to_scale_rotation_translation();
    if !scale.is_finite() || scale.min_element() == 0.0 || scale.x * scale.y * scale.z == 0.0 {
        return Err(CoatingFault::Scale(scale.x, scale.y, scale.z));
    }
    let metres_per_unit = world.get_resource::<CoatingUnit>().copied().unwrap_or_default().checked()?;
    let gravity = world.get_resource::<CoatingGravity>().copied().unwrap_or_default();
    let own = world.get::<PropWeather>(root).map(|own| own.0);
    let today = own.or(world.get_resource::<CoatingWeather>().copied()).unwrap_or_default();
    let past = coating.key().past_weather.unwrap_or_default();
    // Rays are cast for the past if it needs them, else for today, so that the film need not wait for them later.
    let cast_for = if past.reaches_anything() { past } else { today };
    let fresh = CoatingCalendar::default();
    let calendar = world.get_resource::<CoatingCalendar>().unwrap_or(&fresh);
    // Today's rate is taken for all of the past.
    let since = |date: f64| {
        let lived = match own {
            Some(own) => calendar.since_in(date, own, gravity, &transform),
            None => calendar.since(date, past, gravity, &transform),
        };
        lived.into_iter().map(|(age, environment)| (age * coating.rate, environment))
    };
    let mut lived = vec![(coating.start_age, past.environment(gravity, &transform))];
    lived.extend(coating.painted.into_iter().flat_map(since));
    let saved = saved.map(|(state, date)| (state, coating.painted.map(|_| since(date).collect()).unwrap_or_default()));
    let mut shelter = None;
    if coating.shelter == Shelter::Scene
        && cast_for.reaches_anything()
        && let Some(scene) = world.get_resource::<ShelterScene>()
    {
        let place = place_of(&transform, metres_per_unit);
        shelter = scene.order(&cast_for.environment(gravity, &transform), place, root, slots);
        if shelter.is_none() {
            return Ok(None);
        }
    }
    // Last, as it copies images.
    let film_gravity = past.environment(gravity, &transform).gravity;
    let Some(masks) = masks_of(world, coating, film_gravity, images)? else { return Ok(None) };
    Ok(Some(FilmInputs {
        meshes: meshes.into_iter().cloned().collect(),
        key: coating.key(),
        settings,
        quality: coating.quality,
        masks,
        scale: scale * metres_per_unit,
        metres_per_unit,
        past: lived,
        date: calendar.date(),
        target: world.get_resource::<CoatingClock>().and_then(CoatingClock::checked_target),
        saved,
        history: world.get::<CoatingHistory>(root).map(|history| history.keyframe_bytes),
        shelter,
    }))
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
