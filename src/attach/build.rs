//! Builds a film in the background: from the prop's meshes to a film of its start age.

use std::{sync::Arc, time::Duration};

use bevy::{
    ecs::{component::Component, entity::Entity},
    math::Vec3,
    tasks::{Task, futures_lite::future::yield_now},
};
use web_time::Instant;

use super::order::FilmInputs;
use crate::{
    api::{coating::FilmKey, error::CoatingFault},
    display::{FilmDisplay, FilmPaint},
    mesh_reader::surface_of,
    remesh::{FilmTarget, build_film as remesh},
    settings::CoatingSettings,
    shelter::{CastOrder, FilmShelter},
    sim::{FilmState, coarser_than_grain},
    stain::exposure::ExposedSurface,
    surface::{BuildError, BuildWarning},
};

/// Time after which a build lets others go on. Most builds are done before.
const TURN: Duration = Duration::from_millis(50);

/// Film that is being built, on the film's entity. Dropping it cancels the build at its next rest.
#[derive(Component)]
#[component(clone_behavior = Ignore)]
pub(crate) struct FilmBuild {
    /// Build under way.
    pub task: Task<Result<Box<FilmReadiness>, CoatingFault>>,
    /// Entity with the coating.
    pub root: Entity,
    /// Entities whose meshes make up the film, by slot.
    pub slots: Vec<Entity>,
    /// Fields of the coating with which the film is built.
    pub key: FilmKey,
    /// Seed of the film.
    pub seed: u64,
    /// Scale from the meshes to the film, which is in metres.
    pub scale: Vec3,
    /// Metres that a unit of the world is long.
    pub metres_per_unit: f32,
    /// Area of the meshes, in square metres.
    pub area: f64,
}

/// Inputs of a build.
pub(super) struct FilmOrder {
    pub inputs: FilmInputs,
    /// Target of remeshing, from the coating's resolution.
    pub target: FilmTarget,
    pub seed: u64,
    pub paint: FilmPaint,
}

/// Film that is ready to be put on its prop.
pub(crate) struct FilmReadiness {
    pub film: FilmState,
    pub settings: Arc<CoatingSettings>,
    pub warnings: Vec<BuildWarning>,
    pub display: FilmDisplay,
    pub shelter: FilmShelter,
    /// Point of the scaled mesh that is zero in the film's space.
    pub origin: Vec3,
}

/// Builds a film, ages it to its start age and writes its display meshes. Whatever takes longer than a [`TURN`] rests
/// in between, so that one heavy build does not hold up all others, and ends where nobody wants it any more.
///
/// # Errors
/// [`CoatingFault`] if the meshes cannot be read or no film can be built of them.
pub(super) async fn build_film(order: FilmOrder) -> Result<Box<FilmReadiness>, CoatingFault> {
    let FilmOrder { inputs, target, seed, paint } = order;
    let FilmInputs { meshes, key, settings, quality, scale, past, shelter, .. } = inputs;
    let mut turn = Turn::begin();
    let (mut surface, attributes) = surface_of(&meshes, scale)?;
    drop(meshes);
    let origin = surface.recentre();
    turn.rest().await;
    let mut built = remesh(&surface, target, seed)?;
    turn.rest().await;
    let mut film = FilmState::new(&built, &settings, seed, key.steps_per_age)
        .ok_or(BuildError::AllDegenerate { triangles: surface.triangles.len() })?;
    film.quality = quality;
    built.warnings.extend(coarser_than_grain(&film.mesh, key.resolution, target, &settings.scale));
    turn.rest().await;
    let mut display = FilmDisplay::new(&film, &surface, &built, attributes, scale, origin, paint, key.detail)?;
    turn.rest().await;
    let shelter = shelter.map(|order| cast(order.shifted(origin), &mut film)).unwrap_or_default();
    turn.rest().await;
    let steps = film.clock.step_at(key.start_age);
    while film.clock.steps < steps {
        film.step(&settings, &past);
        turn.rest().await;
    }
    display.prepare(&film);
    Ok(Box::new(FilmReadiness { film, settings, warnings: built.warnings, display, shelter, origin }))
}

/// Casts rays for a fresh film and stores its exposure to rain and sun.
fn cast(mut order: CastOrder, film: &mut FilmState) -> FilmShelter {
    let surface = Arc::new(ExposedSurface::new(&film.mesh));
    order.cull(surface.sphere());
    film.stains.exposure = order.cast(&surface);
    FilmShelter::of_built(surface, order.key)
}

/// Turn of a build on its thread.
struct Turn {
    began: Instant,
}

impl Turn {
    fn begin() -> Self {
        Self { began: Instant::now() }
    }

    /// Lets other tasks go on if the turn is over. A task that nobody wants any more ends here.
    async fn rest(&mut self) {
        if self.began.elapsed() >= TURN {
            yield_now().await;
            self.began = Instant::now();
        }
    }
}

#[cfg(test)]
mod tests {
    use bevy::{
        math::primitives::Cuboid,
        mesh::Mesh,
        tasks::{AsyncComputeTaskPool, TaskPool, futures::check_ready},
    };

    use super::*;
    use crate::{api::coating::Coating, deform::SolverQuality, stain::Environment};

    /// Order for a cuboid of `start_age` in a hundred thousand steps an age.
    fn order(start_age: f64, settings: &Arc<CoatingSettings>) -> FilmOrder {
        let coating = Coating::default().with_start_age(start_age).with_steps_per_age(100_000);
        let inputs = FilmInputs {
            meshes: vec![Mesh::from(Cuboid::default())],
            key: coating.key(),
            settings: settings.clone(),
            quality: SolverQuality::Default,
            scale: Vec3::ONE,
            metres_per_unit: 1.0,
            past: Environment::default(),
            shelter: None,
        };
        let paint = FilmPaint::new(&coating, 0, Vec3::ZERO);
        FilmOrder { inputs, target: FilmTarget::Triangles(500), seed: 0, paint }
    }

    #[test]
    fn heavy_builds_let_light_ones_pass_and_end_when_nobody_wants_them() {
        let pool = AsyncComputeTaskPool::get_or_init(TaskPool::new);
        let settings = Arc::new(CoatingSettings::default());
        // Minutes of work for every thread.
        let mut heavy: Vec<_> =
            (0..4 * pool.thread_num()).map(|_| pool.spawn(build_film(order(10.0, &settings)))).collect();
        let mut light = pool.spawn(build_film(order(0.0, &settings)));
        let begin = Instant::now();
        let built = loop {
            if let Some(built) = check_ready(&mut light) {
                break built;
            }
            assert!(begin.elapsed() < Duration::from_secs(120), "a light build waits for heavy ones");
            std::thread::sleep(Duration::from_millis(1));
        };
        assert!(built.is_ok());
        drop(built);
        assert!(heavy.iter_mut().all(|task| check_ready(task).is_none()), "the heavy builds were none");
        drop((heavy, light));
        // Each build holds the settings as long as it holds anything.
        while Arc::strong_count(&settings) > 1 {
            assert!(begin.elapsed() < Duration::from_secs(120), "builds that nobody wants go on");
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}
