//! The way of one film to another age, or to a saved state, in the background.

use std::sync::Arc;

use bevy::{
    ecs::component::Component,
    tasks::{AsyncComputeTaskPool, Task},
};

use super::film_history::FilmHistory;
use crate::{
    api::turn::Turn,
    history::{Conditions, History, Past},
    rest::Rest,
    settings::CoatingSettings,
    sim::FilmState,
    snapshot::{Snapshot, SnapshotError},
    stain::Environment,
};

/// State that a film is to have next, on its entity until the way there begins.
#[derive(Component, Debug)]
#[component(clone_behavior = Ignore)]
pub(crate) struct FilmWish(pub Snapshot);

/// Way under way, on the film's entity. The film stands still meanwhile. Dropping it ends the way.
#[derive(Component, Debug)]
#[component(clone_behavior = Ignore)]
pub(crate) struct FilmJourney {
    pub task: Task<Result<Box<Arrival>, SnapshotError>>,
    pub goal: Goal,
}

/// Goal of a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Goal {
    /// A step.
    Step(u64),
    /// A saved state.
    Saved,
    /// The film as it is, with a history that begins there.
    History,
}

/// Film at the end of its way.
#[derive(Debug)]
pub(crate) struct Arrival {
    pub film: FilmState,
    pub history: Option<FilmHistory>,
}

impl Arrival {
    fn of(history: History) -> Box<Self> {
        let (history, film) = FilmHistory::of(history);
        Box::new(Self { film, history: Some(history) })
    }
}

/// Begins the way of `film` to `step` under conditions that stay.
pub(super) fn go_on(
    mut film: FilmState,
    settings: Arc<CoatingSettings>,
    environment: Environment,
    step: u64,
) -> FilmJourney {
    let task = AsyncComputeTaskPool::get().spawn(async move {
        let mut turn = Turn::begin().await;
        while film.clock.steps < step {
            film.step(&settings, &environment);
            turn.rest().await;
        }
        Ok(Box::new(Arrival { film, history: None }))
    });
    FilmJourney { task, goal: Goal::Step(step) }
}

/// Begins the way to `step` along `past`, of a film that is at `now` under `conditions`. `film` makes a copy of the
/// present film, and is asked for one only if the way leads on from it.
pub(super) fn go_through(
    past: &Past,
    conditions: &Conditions,
    now: u64,
    film: impl FnOnce() -> FilmState,
    step: u64,
) -> FilmJourney {
    let (past, conditions) = (past.clone(), conditions.clone());
    let film = (!past.leads_back(now, step)).then(film);
    let task = AsyncComputeTaskPool::get().spawn(async move {
        let mut turn = Turn::begin().await;
        let mut history = match film {
            Some(film) => History { film, now: conditions, past },
            None => {
                let mut history = History { film: FilmState::default(), now: conditions, past };
                // Past every step, so that it is restored whatever the goal.
                history.film.clock.steps = u64::MAX;
                history.jump(step)?;
                history
            }
        };
        while history.film().clock.steps < step {
            history.step()?;
            turn.rest().await;
        }
        Ok(Arrival::of(history))
    });
    FilmJourney { task, goal: Goal::Step(step) }
}

/// Begins to restore `saved` on the mesh of `film`. With `bytes`, a history of so many bytes of keyframes begins there.
pub(super) fn go_to_saved(
    saved: Snapshot,
    film: FilmState,
    conditions: Conditions,
    bytes: Option<usize>,
) -> FilmJourney {
    let task = AsyncComputeTaskPool::get().spawn(async move {
        let _turn = Turn::begin().await;
        let restored = saved.restore(&film.mesh)?;
        begin_history(restored, conditions, bytes)
    });
    FilmJourney { task, goal: Goal::Saved }
}

/// Begins a history of `film`, with at most `bytes` of keyframes.
pub(super) fn stay(film: FilmState, conditions: Conditions, bytes: usize) -> FilmJourney {
    let task = AsyncComputeTaskPool::get().spawn(async move {
        let _turn = Turn::begin().await;
        begin_history(film, conditions, Some(bytes))
    });
    FilmJourney { task, goal: Goal::History }
}

fn begin_history(film: FilmState, conditions: Conditions, bytes: Option<usize>) -> Result<Box<Arrival>, SnapshotError> {
    let Some(bytes) = bytes else { return Ok(Box::new(Arrival { film, history: None })) };
    let Conditions { settings, environment } = conditions;
    let mut history = History::new(film, settings, environment)?;
    history.set_keyframe_bytes(bytes);
    Ok(Arrival::of(history))
}
