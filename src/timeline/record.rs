//! Records what acts on films, step by step, and keeps their states on the way.

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        system::{Query, ResMut},
    },
    tasks::AsyncComputeTaskPool,
};

use super::{film_history::FilmHistory, whole_film::WholeFilm};
use crate::{
    api::{diagnostics::CoatingTimings, film_pace::FilmPace, turn::Turn},
    appearance::DisplayChanges,
    history::{Conditions, Event},
    settings::CoatingSettings,
    sim::{FilmClock, Stage},
    stain::StainFields,
    touch::{Effect, Touch},
};

/// Notes the conditions of the step that is about to be taken. It runs before the step is counted.
pub(crate) fn note_conditions(
    mut films: Query<(&FilmPace, &FilmClock, &StainFields, &mut FilmHistory)>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Other, || {
        for (pace, clock, stains, mut history) in &mut films {
            if pace.due {
                history.note(clock.steps, pace, &stains.exposure);
            }
        }
    });
}

/// Keeps the states of films that have come far enough, and lets happen again what had been logged at this step.
pub(crate) fn keep_past(
    mut films: Query<(WholeFilm, &mut FilmHistory, &mut DisplayChanges)>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Other, || {
        for (mut film, mut history, mut display) in &mut films {
            if !film.pace.due {
                continue;
            }
            let step = film.clock.steps;
            // Before the edits: they follow when a keyframe is restored.
            if history.is_due(step) {
                let (mut past, mut state) = (history.past.clone(), film.state());
                history.write(AsyncComputeTaskPool::get().spawn(async move {
                    let _turn = Turn::begin().await;
                    past.keyframe_of(&mut state)
                }));
            }
            let edits = history.arrive(step);
            if edits.is_empty() {
                continue;
            }
            let settings = CoatingSettings::clone(&film.pace.settings);
            let mut conditions = Conditions { settings, environment: film.pace.environment };
            film.lend(|state| {
                for edit in &edits {
                    conditions.apply(state, edit);
                }
            });
            // New paint gives vertices other numbers.
            let renews = |edit: &Event| matches!(edit, Event::Touch(Touch { effect: Effect::Repaint, .. }, _));
            if edits.iter().any(renews) {
                display.bypass_change_detection().restart();
            } else {
                display.bypass_change_detection().mark_everything();
            }
        }
    });
}
