//! Sends films on their way to other ages, and puts them on their props when they arrive.

use std::sync::Arc;

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        lifecycle::RemovedComponents,
        message::MessageWriter,
        query::With,
        system::{Commands, Local, Query, Res},
    },
    log::warn,
    tasks::futures::check_ready,
};

use super::{
    film_history::FilmHistory,
    journey::{self, Arrival, FilmJourney, FilmWish, Goal},
    whole_film::{WholeFilm, WholeFilmItem},
};
use crate::{
    api::{
        clock::CoatingClock,
        history::CoatingHistory,
        links::CoatedBy,
        messages::{AgeReached, RestoreFailed},
    },
    appearance::DisplayChanges,
    history::Conditions,
    settings::CoatingSettings,
    shelter::FilmShelter,
};

/// Ends the histories of coatings that ask for none any more, and follows the memory that they allow.
pub(crate) fn follow_histories(
    mut commands: Commands,
    mut ended: RemovedComponents<CoatingHistory>,
    mut films: Query<(Entity, &CoatedBy, &mut FilmHistory)>,
    wanted: Query<&CoatingHistory>,
) {
    let ended = ended.read().count() > 0;
    for (film, coated_by, mut history) in &mut films {
        match wanted.get(coated_by.0) {
            Ok(wanted) => history.bypass_change_detection().set_keyframe_bytes(wanted.keyframe_bytes),
            Err(_) if ended => {
                commands.entity(film).try_remove::<FilmHistory>();
            }
            Err(_) => {}
        }
    }
}

/// Everything of a film that travels.
type Traveller = (
    Entity,
    &'static CoatedBy,
    WholeFilm,
    Option<&'static mut FilmHistory>,
    Option<&'static mut FilmJourney>,
    Option<&'static FilmWish>,
    &'static mut DisplayChanges,
    &'static mut FilmShelter,
);

/// Puts films on their props that have come to their goals, and sends others on their way.
pub(crate) fn travel(
    mut commands: Commands,
    mut films: Query<Traveller>,
    wanted: Query<&CoatingHistory>,
    histories: Query<(), With<FilmHistory>>,
    clock: Res<CoatingClock>,
    mut reached: MessageWriter<AgeReached>,
    mut failed: MessageWriter<RestoreFailed>,
    mut told: Local<Vec<Entity>>,
) {
    let target = clock.checked_target();
    for (entity, &CoatedBy(root), mut film, mut history, mut under_way, wish, mut display, mut shelter) in &mut films {
        if let Some(way) = &mut under_way {
            let Some(result) = check_ready(&mut way.task) else { continue };
            commands.entity(entity).try_remove::<FilmJourney>();
            let goal = way.goal;
            match result {
                Ok(arrival) => {
                    let arrived = arrive(&mut film, *arrival, goal, &mut history, &mut shelter);
                    if let Some(new) = arrived {
                        commands.entity(entity).try_insert(new);
                    }
                    if goal != Goal::History {
                        display.bypass_change_detection().restart();
                        reached.write(AgeReached { entity, root, age: film.clock.age() });
                    }
                }
                Err(error) => {
                    // The same way would fail again.
                    film.clock.bypass_change_detection().goal = None;
                    warn!("film {entity} stays as it is: {error}");
                    failed.write(RestoreFailed { entity, root, error: Arc::new(error) });
                }
            }
            // Another goal may have been set meanwhile; the history is there in the next frame.
            film.pace.bypass_change_detection().travels = film.clock.goal.is_some();
            continue;
        }
        let keeps = wanted.get(root).ok().map(|wanted| wanted.keyframe_bytes);
        let step = film.clock.steps;
        if keeps.is_some()
            && let Some(age) = target
            && film.clock.step_at(age) < step
            && film.clock.goal.is_none()
        {
            film.clock.bypass_change_detection().goal = Some(film.clock.step_at(age));
        }
        let way = if let Some(FilmWish(saved)) = wish {
            commands.entity(entity).try_remove::<FilmWish>();
            film.clock.bypass_change_detection().goal = None;
            Some(journey::go_to_saved(saved.clone(), film.state(), conditions_of(&film), keeps))
        } else if let Some(bytes) = keeps
            && history.is_none()
        {
            Some(journey::stay(film.state(), conditions_of(&film), bytes))
        } else {
            match film.clock.goal {
                None => None,
                Some(goal) if goal == step => {
                    film.clock.bypass_change_detection().goal = None;
                    reached.write(AgeReached { entity, root, age: film.clock.age() });
                    None
                }
                Some(goal) => match &mut history {
                    Some(history) => {
                        let (pace, exposure) = (&*film.pace, &film.stains.exposure);
                        // What acts on the film now is what acts on it on the way to where it has not been.
                        if goal > step && history.is_new(step) {
                            history.bypass_change_detection().note(step, pace, exposure);
                        }
                        let state = || film.state();
                        Some(journey::go_through(&history.past, &history.now, step, state, goal))
                    }
                    None if goal > step => {
                        let (settings, environment) = (film.pace.settings.clone(), film.pace.environment);
                        Some(journey::go_on(film.state(), settings, environment, goal))
                    }
                    None => {
                        film.clock.bypass_change_detection().goal = None;
                        if !told.contains(&entity) {
                            told.push(entity);
                            warn!(
                                "film {entity} cannot go back in time, as it keeps no history: insert \
                                 `CoatingHistory` beside its `Coating`"
                            );
                        }
                        None
                    }
                },
            }
        };
        film.pace.bypass_change_detection().travels = way.is_some();
        if let Some(way) = way {
            commands.entity(entity).try_insert(way);
        }
    }
    told.retain(|&film| !histories.contains(film) && films.contains(film));
}

/// Returns the conditions under which `film` takes its next step.
fn conditions_of(film: &WholeFilmItem) -> Conditions {
    Conditions { settings: CoatingSettings::clone(&film.pace.settings), environment: film.pace.environment }
}

/// Puts a film that has arrived in the place of the one that set out. Returns its history, if that is new to it.
fn arrive(
    film: &mut WholeFilmItem,
    arrival: Arrival,
    goal: Goal,
    history: &mut Option<bevy::ecs::change_detection::Mut<FilmHistory>>,
    shelter: &mut FilmShelter,
) -> Option<FilmHistory> {
    let Arrival { film: state, history: new } = arrival;
    if goal != Goal::History {
        if state.stains.exposure != film.stains.exposure {
            // What was known of rain and sun then is not what is known now.
            *shelter = FilmShelter { choice: shelter.choice, ..FilmShelter::default() };
        }
        film.replace(state);
    }
    // A film that came as near to its goal as its history reaches has come to it.
    if matches!(goal, Goal::Step(step) if film.clock.goal == Some(step)) {
        film.clock.goal = None;
    }
    match (history, new) {
        (Some(old), Some(new)) => {
            **old = new;
            None
        }
        (_, new) => new,
    }
}
