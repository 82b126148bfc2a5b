//! Builds a film in the background: from the prop's meshes to a film of its start age.

use std::sync::Arc;

use bevy::{
    ecs::{component::Component, entity::Entity},
    math::Vec3,
    mesh::Mesh,
    tasks::Task,
};

use crate::{
    api::{coating::FilmKey, error::CoatingFault},
    deform::SolverQuality,
    display::{FilmDisplay, FilmPaint},
    mesh_reader::surface_of,
    settings::CoatingSettings,
    shelter::{CastOrder, FilmShelter},
    sim::FilmState,
    stain::{Environment, exposure::ExposedSurface},
    surface::{BuildError, BuildWarning},
};

/// Film that is being built, on the film's entity. Dropping it cancels the build.
#[derive(Component)]
pub(crate) struct FilmBuild {
    /// Build under way.
    pub task: Task<Result<Box<FilmReadiness>, CoatingFault>>,
    /// Entity with the coating.
    pub root: Entity,
    /// Entities whose meshes make up the film, by slot.
    pub slots: Vec<Entity>,
    /// Fields of the coating with which the film is built.
    pub key: FilmKey,
    /// World scale of the film's entity.
    pub scale: Vec3,
}

/// Inputs of a build, as copies that are not shared with the main thread.
pub(super) struct FilmOrder {
    pub meshes: Vec<Mesh>,
    pub key: FilmKey,
    pub settings: Arc<CoatingSettings>,
    pub quality: SolverQuality,
    pub scale: Vec3,
    pub environment: Environment,
    /// Meshes that may shelter the film; `None` without rain and sun, or if the coating does not ask for shelters.
    pub shelter: Option<CastOrder>,
    pub paint: FilmPaint,
}

/// Film that is ready to be put on its prop.
pub(crate) struct FilmReadiness {
    pub film: FilmState,
    pub settings: Arc<CoatingSettings>,
    pub warnings: Vec<BuildWarning>,
    pub display: FilmDisplay,
    pub shelter: FilmShelter,
}

/// Builds a film, ages it to its start age and writes its display meshes.
///
/// # Errors
/// [`CoatingFault`] if the meshes cannot be read or no film can be built of them.
pub(super) fn build_film(order: &FilmOrder) -> Result<Box<FilmReadiness>, CoatingFault> {
    let FilmOrder { meshes, key, settings, quality, scale, environment, shelter, paint } = order;
    let (surface, attributes) = surface_of(meshes, *scale)?;
    let built = crate::remesh::build_film(&surface, key.resolution, key.seed)?;
    let mut film = FilmState::new(&built, settings, key.seed, key.steps_per_age)
        .ok_or(BuildError::AllDegenerate { triangles: surface.triangles.len() })?;
    film.quality = *quality;
    let mut display = FilmDisplay::new(&film, &surface, &built, attributes, *scale, paint.clone());
    let shelter = shelter.clone().map(|order| cast(order, &mut film)).unwrap_or_default();
    film.age_to(key.start_age, settings, environment);
    display.prepare(&film);
    Ok(Box::new(FilmReadiness { film, settings: settings.clone(), warnings: built.warnings, display, shelter }))
}

/// Casts rays for a fresh film and stores its exposure to rain and sun.
fn cast(mut order: CastOrder, film: &mut FilmState) -> FilmShelter {
    let surface = Arc::new(ExposedSurface::new(&film.mesh));
    order.cull(&surface);
    film.stains.exposure = order.cast(&surface);
    FilmShelter::of_built(surface, order.key)
}
