//! Sends films on their way to other ages, and puts them on their props when they arrive.

use std::sync::Arc;

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        lifecycle::RemovedComponents,
        message::MessageWriter,
        query::QueryData,
        system::{Commands, Query, Res, ResMut},
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
        calendar::CoatingCalendar,
        clock::{CoatingClock, CoatingGravity},
        history::CoatingHistory,
        links::CoatedBy,
        messages::{AgeReached, RestoreFailed},
        weather::CoatingWeather,
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
#[derive(QueryData)]
#[query_data(mutable)]
pub(crate) struct Traveller {
    entity: Entity,
    coated_by: &'static CoatedBy,
    film: WholeFilm,
    history: Option<&'static mut FilmHistory>,
    journey: Option<&'static mut FilmJourney>,
    wish: Option<&'static FilmWish>,
    display: &'static mut DisplayChanges,
    shelter: &'static mut FilmShelter,
}

/// Puts films on their props that have come to their goals, and sends others on their way.
pub(crate) fn travel(
    mut commands: Commands,
    mut films: Query<Traveller>,
    wanted: Query<&CoatingHistory>,
    mut clock: ResMut<CoatingClock>,
    mut calendar: ResMut<CoatingCalendar>,
    weather: Res<CoatingWeather>,
    gravity: Res<CoatingGravity>,
    mut reached: MessageWriter<AgeReached>,
    mut failed: MessageWriter<RestoreFailed>,
) {
    let target = clock.checked_target();
    let skipped = clock.bypass_change_detection().take_skip();
    calendar.pass(skipped, *weather, *gravity);
    for mut film in &mut films {
        film.skip(skipped, target);
        let (entity, root) = (film.entity, film.coated_by.0);
        if let Some(way) = &mut film.journey {
            let Some(result) = check_ready(&mut way.task) else { continue };
            commands.entity(entity).try_remove::<FilmJourney>();
            let goal = way.goal;
            match result {
                Ok(arrival) => {
                    if let Some(history) = film.arrive(*arrival, goal) {
                        commands.entity(entity).try_insert(history);
                    }
                    if goal != Goal::History {
                        reached.write(AgeReached { entity, root, age: film.film.clock.age() });
                    }
                }
                Err(error) => {
                    // The same way would fail again.
                    film.film.clock.bypass_change_detection().goal = None;
                    warn!("film {entity} stays as it is: {error}");
                    failed.write(RestoreFailed { entity, root, error: Arc::new(error) });
                }
            }
            // Another goal may have been set meanwhile.
            film.film.pace.bypass_change_detection().travels = film.film.clock.goal.is_some();
            continue;
        }
        let keeps = wanted.get(root).ok().map(|wanted| wanted.keyframe_bytes);
        if keeps.is_some() {
            film.turn_back_at(target);
        }
        if film.film.clock.goal == Some(film.film.clock.steps) {
            film.film.clock.bypass_change_detection().goal = None;
            reached.write(AgeReached { entity, root, age: film.film.clock.age() });
        }
        if film.wish.is_some() {
            commands.entity(entity).try_remove::<FilmWish>();
        }
        let way = film.set_out(keeps);
        film.film.pace.bypass_change_detection().travels = way.is_some();
        if let Some(way) = way {
            commands.entity(entity).try_insert(way);
        }
    }
}

impl TravellerItem<'_, '_> {
    /// Sends the film on by `age` of the calendar, at most to the `target` of all films.
    fn skip(&mut self, age: f64, target: Option<f64>) {
        let WholeFilmItem { clock, pace, .. } = &mut self.film;
        let clock = clock.bypass_change_detection();
        let steps = age * pace.rate * f64::from(clock.steps_per_age);
        if pace.paused || steps < 1.0 {
            return;
        }
        let from = clock.goal.unwrap_or(clock.steps);
        // The conversion saturates.
        let goal = from.saturating_add(steps as u64).min(target.map_or(u64::MAX, |age| clock.step_at(age).max(from)));
        clock.goal = Some(goal).filter(|&goal| goal != clock.steps);
    }

    /// Sends a film that is older than the `target` of all films back to it.
    fn turn_back_at(&mut self, target: Option<f64>) {
        let clock = self.film.clock.bypass_change_detection();
        let step = target.map(|age| clock.step_at(age)).filter(|&step| step < clock.steps);
        clock.goal = clock.goal.or(step);
    }

    /// Begins the way to what is wanted of the film, if anything is. With `keeps`, its past is to be kept in so many
    /// bytes of keyframes.
    fn set_out(&mut self, keeps: Option<usize>) -> Option<FilmJourney> {
        let Self { entity, film, history, wish, .. } = self;
        let conditions =
            || Conditions { settings: CoatingSettings::clone(&film.pace.settings), environment: film.pace.environment };
        if let Some(FilmWish(saved)) = wish {
            let way = journey::go_to_saved(saved.clone(), film.state(), conditions(), keeps);
            film.clock.bypass_change_detection().goal = None;
            return Some(way);
        }
        if let Some(bytes) = keeps
            && history.is_none()
        {
            return Some(journey::stay(film.state(), conditions(), bytes));
        }
        let step = film.clock.steps;
        if let Some(history) = history.as_ref().filter(|history| history.is_rewritten()) {
            let goal = film.clock.goal.unwrap_or(step);
            // As from the end of time, so that it begins at a keyframe whatever the goal.
            return Some(journey::go_through(&history.past, &history.now, u64::MAX, || film.state(), goal));
        }
        let goal = film.clock.goal?;
        match history {
            Some(history) => {
                // What acts on the film now is what acts on it on the way to where it has not been.
                if goal > step && history.is_new(step) {
                    history.bypass_change_detection().note(step, &film.pace, &film.stains.exposure);
                }
                Some(journey::go_through(&history.past, &history.now, step, || film.state(), goal))
            }
            None if goal > step => {
                let (settings, environment) = (film.pace.settings.clone(), film.pace.environment);
                Some(journey::go_on(film.state(), settings, environment, goal))
            }
            None => {
                film.clock.bypass_change_detection().goal = None;
                warn!(
                    "film {entity} cannot go back in time, as it keeps no history: insert `CoatingHistory` beside its \
                     `Coating`"
                );
                None
            }
        }
    }

    /// Puts a film that has arrived at `goal` in the place of the one that set out. Returns its history, if that is new
    /// to it.
    fn arrive(&mut self, arrival: Arrival, goal: Goal) -> Option<FilmHistory> {
        let Self { film, history, display, shelter, .. } = self;
        let Arrival { film: state, history: mut new } = arrival;
        if goal != Goal::History {
            if state.stains.exposure != film.stains.exposure {
                // What was known of rain and sun then is not what is known now.
                **shelter = FilmShelter { choice: shelter.choice, ..FilmShelter::default() };
            }
            film.replace(state);
            display.bypass_change_detection().restart();
        }
        if let Goal::Step(step) = goal {
            // A film that came as near to its goal as its history reaches has come to it.
            film.clock.goal = film.clock.goal.filter(|&goal| goal != step);
            if let (Some(old), Some(new)) = (history.as_mut(), &mut new) {
                new.has_been_at(old);
            }
        }
        match (history, new) {
            (Some(old), Some(new)) => {
                **old = new;
                None
            }
            (_, new) => new,
        }
    }
}
