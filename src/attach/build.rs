//! Builds a film in the background: from the prop's meshes to a film of its start age.

use std::sync::Arc;

use bevy::{
    ecs::{component::Component, entity::Entity},
    math::Vec3,
    tasks::Task,
};

use super::order::FilmInputs;
use crate::{
    api::{coating::FilmKey, error::CoatingFault, limits::MAX_START_AGE, turn::Turn},
    display::{FilmDisplay, FilmPaint},
    history::{Event, History},
    mesh_reader::surface_of,
    remesh::{FilmTarget, build_film_in_pieces as remesh},
    rest::Rest,
    settings::CoatingSettings,
    shelter::{CastOrder, FilmShelter},
    sim::{FilmState, coarser_than_grain},
    snapshot::SnapshotError,
    stain::{Environment, exposure::ExposedSurface},
    surface::{BuildError, BuildWarning},
    timeline::FilmHistory,
};

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
    /// Date for which the film is built.
    pub date: f64,
    /// Whether a mesh asset has changed since the build began, so that a fault may be mended already.
    pub stale: bool,
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
    /// Past of the film, if it is kept.
    pub history: Option<FilmHistory>,
    /// Reason why a saved state was not put back.
    pub refused: Option<Arc<SnapshotError>>,
    pub settings: Arc<CoatingSettings>,
    pub warnings: Vec<BuildWarning>,
    pub display: FilmDisplay,
    pub shelter: FilmShelter,
    /// Point of the scaled mesh that is zero in the film's space.
    pub origin: Vec3,
}

/// Builds a film, ages it to its start age or puts its saved state back, and writes its display meshes. Whatever takes
/// long [rests](Rest) in between, so that one heavy build does not hold up all others, and ends where nobody wants it
/// any more.
///
/// # Errors
/// [`CoatingFault`] if the meshes cannot be read or no film can be built of them.
pub(super) async fn build_film(order: FilmOrder) -> Result<Box<FilmReadiness>, CoatingFault> {
    let FilmOrder { inputs, target, seed, paint } = order;
    let FilmInputs { target: most, shelter, saved, history, .. } = inputs;
    let FilmInputs { meshes, key, settings, quality, masks, scale, past, .. } = inputs;
    let mut turn = Turn::begin().await;
    let (mut surface, attributes) = surface_of(&meshes, scale, &mut turn).await?;
    drop(meshes);
    let origin = surface.recentre();
    turn.rest().await;
    let mut built = remesh(&surface, target, seed, &mut turn).await?;
    turn.rest().await;
    let film = FilmState::new_in_pieces(&built, &settings, seed, key.steps_per_age, &mut turn).await;
    let mut film = film.ok_or(BuildError::AllDegenerate { triangles: surface.triangles.len() })?;
    film.quality = quality;
    masks.apply(&mut film, &surface, &built)?;
    built.warnings.extend(coarser_than_grain(&film.mesh, key.resolution, target, &settings.scale));
    turn.rest().await;
    let detail = key.detail;
    let mut display =
        FilmDisplay::new(&film, &surface, &built, attributes, scale, origin, paint, detail, &mut turn).await?;
    turn.rest().await;
    let shelter = match shelter {
        Some(order) => cast(order.shifted(origin), &mut film, &mut turn).await,
        None => FilmShelter::default(),
    };
    turn.rest().await;
    let (state, since) = saved.unzip();
    let restored = state.map(|state| film.restore(&state).map_err(Arc::new));
    let since = since.filter(|_| matches!(restored, Some(Ok(()))));
    // The target holds nobody back from an age that was asked for, or saved.
    let first = if since.is_none() { past.first().map_or(0.0, |(age, _)| *age) } else { 0.0 };
    let most = most.unwrap_or(f64::INFINITY).max(film.clock.age() + first);
    let lived = since.unwrap_or(past);
    let mut life = Life::begin(film, settings.clone(), history);
    let begin = life.film().clock.age();
    let mut end = begin;
    for (age, environment) in lived {
        life.change(environment);
        end = (end + age).min(most).min(begin + MAX_START_AGE);
        while life.film().clock.steps < life.film().clock.step_at(end) {
            life.step();
            turn.rest().await;
        }
    }
    display.prepare(life.film(), &mut turn).await;
    let (film, history) = life.end();
    let warnings = built.warnings;
    let refused = restored.and_then(Result::err);
    Ok(Box::new(FilmReadiness { film, history, refused, settings, warnings, display, shelter, origin }))
}

/// Film that is aged to what it is when it appears.
struct Life {
    course: Course,
    settings: Arc<CoatingSettings>,
    environment: Environment,
}

/// Course of a life, which is kept or not.
enum Course {
    Forgotten(Box<FilmState>),
    Kept(Box<History>),
}

impl Life {
    /// Begins with `film`. With `history`, its past is kept in so many bytes of keyframes.
    fn begin(film: FilmState, settings: Arc<CoatingSettings>, history: Option<usize>) -> Self {
        let environment = Environment::default();
        let kept = history.and_then(|bytes| {
            // No film that was just built is refused; if it were, it would go on without a past.
            let mut history = History::new(film.clone(), CoatingSettings::clone(&settings), environment).ok()?;
            history.set_keyframe_bytes(bytes);
            Some(Course::Kept(Box::new(history)))
        });
        Self { course: kept.unwrap_or(Course::Forgotten(Box::new(film))), settings, environment }
    }

    fn film(&self) -> &FilmState {
        match &self.course {
            Course::Forgotten(film) => film,
            Course::Kept(history) => history.film(),
        }
    }

    fn change(&mut self, environment: Environment) {
        self.environment = environment;
        if let Course::Kept(history) = &mut self.course {
            history.record(Event::Environment(environment));
        }
    }

    fn step(&mut self) {
        match &mut self.course {
            Course::Forgotten(film) => film.step(&self.settings, &self.environment),
            // The step is taken whether or not it can be kept.
            Course::Kept(history) => history.step().unwrap_or_default(),
        }
    }

    /// Returns the film and its past.
    fn end(self) -> (FilmState, Option<FilmHistory>) {
        match self.course {
            Course::Forgotten(film) => (*film, None),
            Course::Kept(history) => {
                let (history, film) = FilmHistory::of(*history);
                (film, Some(history))
            }
        }
    }
}

/// Casts rays for a fresh film and stores its exposure to rain and sun.
async fn cast(mut order: CastOrder, film: &mut FilmState, turn: &mut Turn) -> FilmShelter {
    let surface = Arc::new(ExposedSurface::new_in_pieces(&film.mesh, turn).await);
    order.cull(surface.sphere());
    film.stains.exposure = order.cast(&surface, turn).await;
    FilmShelter::of_built(surface, order.key)
}

#[cfg(test)]
mod tests {
    use std::time::{Duration, Instant};

    use bevy::{
        math::primitives::Cuboid,
        mesh::Mesh,
        tasks::{AsyncComputeTaskPool, TaskPool, futures::check_ready},
    };

    use super::*;
    use crate::{api::coating::Coating, attach::masks::MaskOrder, deform::SolverQuality};

    /// Order for a cuboid of `start_age` in a hundred thousand steps an age.
    fn order(start_age: f64, settings: &Arc<CoatingSettings>) -> FilmOrder {
        let coating = Coating::default().with_start_age(start_age).with_steps_per_age(100_000);
        let inputs = FilmInputs {
            meshes: vec![Mesh::from(Cuboid::default())],
            key: coating.key(),
            settings: settings.clone(),
            quality: SolverQuality::Default,
            masks: MaskOrder::default(),
            scale: Vec3::ONE,
            metres_per_unit: 1.0,
            past: vec![(start_age, Environment::default())],
            target: None,
            date: 0.0,
            shelter: None,
            saved: None,
            history: None,
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
