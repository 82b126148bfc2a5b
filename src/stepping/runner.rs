//! Turns elapsed time into steps of the films and runs the step schedule within the budget.

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

use super::budget::{BACKLOG_FRAMES, BudgetFilms, Cameras, StepCost, plan_budget};
use crate::{
    api::{
        budget::CoatingBudget,
        clock::{CoatingClock, CoatingGravity},
        display_cost::DisplayCost,
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

/// Query of everything that decides how many steps a film takes.
type Films = QueryState<(
    &'static mut FilmPace,
    &'static FilmClock,
    &'static GlobalTransform,
    &'static mut FilmShelter,
    &'static mut StainFields,
)>;

/// Plans the steps of this frame for every film and takes them.
///
/// Films for which the frame has no time are [postponed](super::budget). The steps of slower films are spread evenly
/// between the steps of the fastest, so that the speeds of films keep their ratio wherever the budget ends the frame.
pub(crate) fn advance(
    world: &mut World,
    films: &mut Films,
    waiting: &mut QueryState<(), With<AwaitingFilm>>,
    refused: &mut QueryState<(), With<FilmRefused>>,
    building: &mut QueryState<&FilmSlot>,
    budget_films: &mut BudgetFilms,
    cameras: &mut Cameras,
) {
    let begin = Instant::now();
    let budget = world.resource::<DisplayCost>().leaves(*world.resource::<CoatingBudget>());
    plan(world, films);
    let rounds = plan_budget(world, budget_films, cameras, budget);
    let mut taken = 0;
    while taken < rounds && taken < u64::from(budget.max_steps.max(1)) {
        if taken > 0 && budget.fixed_cost.is_none() && begin.elapsed() >= budget.max_time {
            break;
        }
        let mut work = 0;
        for (mut pace, ..) in films.iter_mut(world) {
            let pace = pace.bypass_change_detection();
            pace.due = !pace.postponed && is_due(taken, pace.planned, rounds);
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
    status.waiting =
        waiting.iter(world).count() + building.iter(world).filter(|slot| slot.display_mesh.is_none()).count();
    status.refused = refused.iter(world).count();
    let mut current = world.resource_mut::<CoatingStatus>();
    current.set_if_neq(status);
}

/// Returns whether a film that has planned `planned` steps in `rounds` rounds takes one in round `round` (0 is the
/// first). The steps are spread as evenly as whole numbers allow.
fn is_due(round: u64, planned: u64, rounds: u64) -> bool {
    let until = |round: u64| u128::from(round) * u128::from(planned) / u128::from(rounds);
    until(round + 1) > until(round)
}

/// Plans the steps of each film in this frame from the clock and the requested steps.
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
        // A new exposure changes no stain yet, so display need not notice it.
        shelter.bypass_change_detection().finish(stains.bypass_change_detection());
        pace.held = shelter.holds_back(&pace.environment);
        pace.requested = pace.requested.saturating_add(requested);
        let owed = age * pace.rate * f64::from(clock.steps_per_age);
        if !pace.paused && owed > 0.0 {
            pace.owed += owed;
        }
        // The conversion saturates for infinite speeds.
        let mut planned = (pace.owed as u64).saturating_add(pace.requested);
        if let Some(target) = target {
            let left = clock.step_at(target).saturating_sub(clock.steps);
            if planned >= left {
                // Steps beyond the target are not owed, so that ageing does not leap when the target is raised later.
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

/// Subtracts the steps that were taken from the requested and the owed ones, drops the owed steps that did not fit, and
/// returns the counts for [`CoatingStatus`].
fn settle(world: &mut World, films: &mut Films, budget: CoatingBudget) -> CoatingStatus {
    let backlog = f64::from(budget.max_steps.max(1).saturating_mul(BACKLOG_FRAMES));
    let mut status = CoatingStatus { youngest: f64::INFINITY, ..CoatingStatus::default() };
    for (mut pace, clock, ..) in films.iter_mut(world) {
        let pace = pace.bypass_change_detection();
        pace.due = false;
        let requested = pace.taken.min(pace.requested);
        pace.requested -= requested;
        pace.owed -= (pace.taken - requested) as f64;
        if pace.postponed {
            // A postponed film takes the steps that it owes together later, but no more than a few frames' worth.
            pace.owed = if pace.owed > backlog { backlog } else { pace.owed };
        } else if !pace.held {
            // Steps that were planned but not taken are dropped; an infinite speed leaves no fraction to carry over.
            pace.owed = if pace.owed.is_finite() { pace.owed.fract() } else { 0.0 };
        }
        status.films += 1;
        status.casting += usize::from(pace.held);
        status.stepped += usize::from(pace.taken > 0);
        status.postponed += usize::from(pace.postponed);
        status.youngest = status.youngest.min(clock.age());
        status.oldest = status.oldest.max(clock.age());
    }
    if status.films == 0 {
        status.youngest = 0.0;
    }
    status
}
