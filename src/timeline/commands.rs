//! Commands for the entity of a coating: all its films go to an age, or are saved and put back.

use std::sync::Arc;

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        component::Component,
        entity::Entity,
        query::Without,
        system::{Commands, EntityCommand, EntityCommands, Query},
        world::{EntityWorldMut, World},
    },
    log::warn,
};

use super::{journey::FilmWish, path::written_path, save::below};
use crate::{
    api::{
        film_pace::FilmPace,
        links::{AwaitingFilm, CoatedBy, CoatingFilms, FilmSource},
        messages::RestoreFailed,
        snapshot::CoatingSnapshot,
    },
    sim::FilmClock,
    snapshot::SnapshotError,
};

/// Commands for an entity with a [`Coating`](crate::Coating), for all its films.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{CoatingCommands, prelude::*};
///
/// /// Ten years pass while the player sleeps.
/// fn sleep(mut commands: Commands, props: Query<Entity, With<Coating>>) {
///     for prop in &props {
///         commands.entity(prop).age_to(0.8);
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, sleep);
/// app.update();
/// ```
pub trait CoatingCommands {
    /// Brings all films of the coating to `age`, back or forward, in the background: see
    /// [`FilmClock::seek`](crate::sim::FilmClock::seek). Films that are still being built follow when they are ready.
    fn age_to(&mut self, age: f64) -> &mut Self;

    /// Requests `steps` further steps from all films of the coating that are ready, also while the clock is paused: see
    /// [`FilmPace::request_steps`](crate::FilmPace::request_steps).
    fn request_steps(&mut self, steps: u64) -> &mut Self;

    /// Saves all films of the coating into a [`CoatingSnapshot`] beside it. If they cannot be saved, a warning says
    /// why, and a snapshot that is there stays.
    fn save_films(&mut self) -> &mut Self;

    /// Puts the films of the coating back into the states of `snapshot`, in the background.
    /// [`AgeReached`](crate::AgeReached) tells of each film that is back, [`RestoreFailed`] of each that cannot be:
    /// it stays as it is. Films that are still being built follow when they are ready.
    fn restore_films(&mut self, snapshot: CoatingSnapshot) -> &mut Self;
}

impl CoatingCommands for EntityCommands<'_> {
    fn age_to(&mut self, age: f64) -> &mut Self {
        self.try_insert(AgeWish(age))
    }

    fn request_steps(&mut self, steps: u64) -> &mut Self {
        self.queue_silenced(RequestSteps(steps))
    }

    fn save_films(&mut self) -> &mut Self {
        self.queue_silenced(SaveFilms)
    }

    fn restore_films(&mut self, snapshot: CoatingSnapshot) -> &mut Self {
        self.queue_silenced(RestoreFilms(snapshot))
    }
}

/// Age that all films of a coating are to have, on the coating's entity until they are ready.
#[derive(Component, Clone, Copy, Debug)]
#[component(clone_behavior = Ignore)]
pub(crate) struct AgeWish(f64);

/// Hands ages that were asked for to the films of their coatings, once all of them are ready.
pub(crate) fn hand_out_ages(
    mut commands: Commands,
    wishes: Query<(Entity, &AgeWish)>,
    awaiting: Query<&AwaitingFilm>,
    building: Query<&CoatedBy, Without<FilmSource>>,
    mut films: Query<(&CoatedBy, &mut FilmClock)>,
) {
    for (root, &AgeWish(age)) in &wishes {
        let waits = awaiting.iter().any(|mesh| mesh.root == root) || building.iter().any(|film| film.0 == root);
        let mut any = false;
        for (_, mut clock) in films.iter_mut().filter(|(coated_by, _)| coated_by.0 == root) {
            any = true;
            if !waits {
                clock.seek(age);
            }
        }
        if any && !waits {
            commands.entity(root).try_remove::<AgeWish>();
        }
    }
}

struct RequestSteps(u64);

impl EntityCommand for RequestSteps {
    type Out = ();

    fn apply(self, mut entity: EntityWorldMut) {
        let films = entity.get::<CoatingFilms>().map(|own| own.films().to_vec()).unwrap_or_default();
        entity.world_scope(|world| {
            for film in films {
                if let Some(mut pace) = world.get_mut::<FilmPace>(film) {
                    pace.bypass_change_detection().request_steps(self.0);
                }
            }
        });
    }
}

struct SaveFilms;

impl EntityCommand for SaveFilms {
    type Out = ();

    fn apply(self, mut entity: EntityWorldMut) {
        let root = entity.id();
        match entity.world_scope(|world| CoatingSnapshot::of(world, root)) {
            Ok(snapshot) => {
                entity.insert(snapshot);
            }
            Err(error) => warn!("{error}"),
        }
    }
}

struct RestoreFilms(CoatingSnapshot);

impl EntityCommand for RestoreFilms {
    type Out = ();

    fn apply(self, mut entity: EntityWorldMut) {
        let root = entity.id();
        let snapshot = self.0;
        entity.world_scope(|world| {
            for film in below(world, root) {
                // Films that are being built go there as soon as they are ready, those that are not yet begin there.
                if world.get::<CoatedBy>(film).is_some_and(|coated_by| coated_by.0 == root) {
                    restore(world, root, film, &snapshot);
                }
            }
        });
        entity.insert(snapshot);
    }
}

/// Asks for the saved state of one film.
fn restore(world: &mut World, root: Entity, film: Entity, snapshot: &CoatingSnapshot) {
    let path = written_path(world, root, film);
    match snapshot.film_at(&path) {
        Some(saved) => {
            world.entity_mut(film).insert(FilmWish(saved.clone()));
        }
        None => {
            let error = SnapshotError::NoFilm { path };
            warn!("film {film} stays as it is: {error}");
            world.write_message(RestoreFailed { entity: film, root, error: Arc::new(error) });
        }
    }
}
