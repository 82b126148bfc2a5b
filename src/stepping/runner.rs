//! The driver: turns time into steps of the films and runs the step schedule within the budget.

use web_time::Instant;

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        query::{QueryState, With},
        world::World,
    },
    time::Time,
    transform::components::GlobalTransform,
};

use super::budget::{BACKLOG_FRAMES, Cameras, StepCost, Waiting, choose};
use crate::{
    api::{
        budget::CoatingBudget,
        clock::{CoatingClock, CoatingGravity},
        film_pace::FilmPace,
        links::{AwaitingFilm, FilmRefused, FilmSlot},
        status::CoatingStatus,
        system_sets::CoatingStep,
        weather::CoatingWeather,
    },
    shelter::FilmShelter,
    sim::FilmClock,
    stain::StainFields,
};
/// What decides the steps of a film.
type Films = QueryState<(
    &'static mut FilmPace,
    &'static FilmClock,
    &'static GlobalTransform,
    &'static mut FilmShelter,
    &'static mut StainFields,
)>;

/// Plans the steps of this frame for every film and takes them.
///
/// Films for which the frame has no time [wait](super::budget) for theirs. Steps of slower films are spread evenly between those of the fastest, so that their pace keeps its ratio
/// wherever the budget cuts the frame short.
pub(crate) fn advance(
    world: &mut World,
    films: &mut Films,
    waiting: &mut QueryState<(), With<AwaitingFilm>>,
    refused: &mut QueryState<(), With<FilmRefused>>,
    building: &mut QueryState<&FilmSlot>,
    waiting_films: &mut Waiting,
    cameras: &mut Cameras,
) {
    let begin = Instant::now();
    let budget = *world.resource::<CoatingBudget>();
    plan(world, films);
    let rounds = choose(world, waiting_films, cameras, budget);
    let mut taken = 0;
    while taken < rounds && taken < u64::from(budget.max_steps.max(1)) {
        if taken > 0 && budget.fixed_cost.is_none() && begin.elapsed() >= budget.max_time {
            break;
        }
        let mut work = 0;
        for (mut pace, ..) in films.iter_mut(world) {
            let pace = pace.bypass_change_detection();
            pace.due = !pace.waits && is_due(taken, pace.planned, rounds);
            pace.taken += u64::from(pace.due);
            work += if pace.due { pace.cost } else { 0 };
        }
        world.resource_mut::<StepCost>().count(work);
        world.run_schedule(CoatingStep);
        taken += 1;
    }
    if taken > 0 {
        world.resource_mut::<StepCost>().learn(begin.elapsed());
    }
    let mut status = settle(world, films, budget);
    status.waiting = waiting.iter(world).count() + building.iter(world).filter(|slot| slot.shown.is_none()).count();
    status.refused = refused.iter(world).count();
    let mut current = world.resource_mut::<CoatingStatus>();
    current.set_if_neq(status);
}

/// Whether a film with `planned` of `rounds` steps takes one in round `round`: as evenly as whole steps can be.
fn is_due(round: u64, planned: u64, rounds: u64) -> bool {
    let until = |round: u64| u128::from(round) * u128::from(planned) / u128::from(rounds);
    until(round + 1) > until(round)
}

/// Plans each film's steps.
fn plan(world: &mut World, films: &mut Films) {
    let seconds = world.get_resource::<Time>().map_or(0.0, Time::delta_secs_f64);
    let gravity = *world.resource::<CoatingGravity>();
    let weather = *world.resource::<CoatingWeather>();
    let (age, target, requested) = {
        let mut clock = world.resource_mut::<CoatingClock>();
        let clock = clock.bypass_change_detection();
        let age = if clock.paused { 0.0 } else { clock.age_per_second * seconds };
        (age, clock.target_age, std::mem::take(&mut clock.requested_steps))
    };
    for (mut pace, clock, transform, mut shelter, mut stains) in films.iter_mut(world) {
        let pace = pace.bypass_change_detection();
        pace.environment = weather.environment(gravity, transform);
        // What reaches a film is no stain, so nothing is to be shown anew.
        shelter.bypass_change_detection().finish(stains.bypass_change_detection());
        pace.held = shelter.holds_back(&pace.environment);
        pace.requested = pace.requested.saturating_add(requested);
        let owed = age * pace.rate * f64::from(clock.steps_per_age);
        if !pace.paused && owed > 0.0 {
            pace.owed += owed;
        }
        // Saturates for infinite speeds.
        let mut planned = (pace.owed as u64).saturating_add(pace.requested);
        if let Some(target) = target {
            let left = clock.step_at(target).saturating_sub(clock.steps);
            if planned >= left {
                // Nothing is owed beyond the target, so that a later one does not begin with a leap.
                planned = left;
                pace.owed = pace.owed.min(left as f64);
                pace.requested = pace.requested.min(left);
            }
        }
        pace.held &= planned > 0;
        pace.planned = if pace.held { 0 } else { planned };
        pace.taken = 0;
    }
}

/// Books the steps that were taken, requested ones first, and drops what is owed beyond them.
fn settle(world: &mut World, films: &mut Films, budget: CoatingBudget) -> CoatingStatus {
    let backlog = f64::from(budget.max_steps.max(1).saturating_mul(BACKLOG_FRAMES));
    let mut status = CoatingStatus { youngest: f64::INFINITY, ..CoatingStatus::default() };
    for (mut pace, clock, ..) in films.iter_mut(world) {
        let pace = pace.bypass_change_detection();
        pace.due = false;
        let requested = pace.taken.min(pace.requested);
        pace.requested -= requested;
        pace.owed -= (pace.taken - requested) as f64;
        if pace.waits {
            // Its turn comes; what it owes by then it takes together, but no more than a few frames' worth.
            pace.owed = if pace.owed > backlog { backlog } else { pace.owed };
        } else if !pace.held {
            // What was planned but not taken is dropped; an infinite speed leaves nothing to carry.
            pace.owed = if pace.owed.is_finite() { pace.owed.fract() } else { 0.0 };
        }
        status.films += 1;
        status.casting += usize::from(pace.held);
        status.stepped += usize::from(pace.taken > 0);
        status.postponed += usize::from(pace.waits);
        status.youngest = status.youngest.min(clock.age());
        status.oldest = status.oldest.max(clock.age());
    }
    if status.films == 0 {
        status.youngest = 0.0;
    }
    status
}
