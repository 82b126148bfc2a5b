//! Building a film in the background: from the prop's meshes to a film aged to its start.

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
/// A film that is being built. Dropping it calls the work off.
#[derive(Component)]
pub(crate) struct FilmBuild {
    pub task: Task<Result<Box<FilmReadiness>, CoatingFault>>,
    pub root: Entity,
    pub slots: Vec<Entity>,
    pub key: FilmKey,
    pub scale: Vec3,
}

/// What a build needs; nothing of it is shared with the main thread.
pub(super) struct FilmOrder {
    pub meshes: Vec<Mesh>,
    pub key: FilmKey,
    pub settings: Arc<CoatingSettings>,
    pub quality: SolverQuality,
    pub scale: Vec3,
    pub environment: Environment,
    /// What may shelter it, if rain or sun reach the film.
    pub shelter: Option<CastOrder>,
    pub paint: FilmPaint,
}

/// A film that is ready to be put on its prop.
pub(crate) struct FilmReadiness {
    pub film: FilmState,
    pub settings: Arc<CoatingSettings>,
    pub warnings: Vec<BuildWarning>,
    pub display: FilmDisplay,
    pub shelter: FilmShelter,
}

/// Builds, dresses and ages a film.
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

/// Finds out what reaches a fresh film.
fn cast(mut order: CastOrder, film: &mut FilmState) -> FilmShelter {
    let surface = Arc::new(ExposedSurface::new(&film.mesh));
    order.cull(&surface);
    film.stains.exposure = order.cast(&surface);
    FilmShelter::of_built(surface, order.key)
}
