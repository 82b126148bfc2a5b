//! Turns elapsed time into steps of the films and runs the step schedule within the budget.
//!
//! A frame's age is the same for all films. The budget shortens it as a whole, where it must: then paint ages more
//! slowly everywhere, and speeds keep their ratio. No step that a film is owed is dropped.

use web_time::Instant;

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        query::{QueryState, With, Without},
        world::World,
    },
    time::Time,
    transform::components::GlobalTransform,
};

use super::{
    budget::{BudgetFilms, Cameras, StepCost, plan_budget},
    frame_time::{FrameTime, shorten_age},
    reached::ReachedPace,
};
use crate::{
    api::{
        budget::CoatingBudget,
        calendar::CoatingCalendar,
        clock::{CoatingClock, CoatingGravity},
        display_cost::DisplayCost,
        film_pace::FilmPace,
        links::{AwaitingFilm, FilmOutdated, FilmRefused, FilmSlot},
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
    refused: &mut QueryState<(), (With<FilmRefused>, Without<AwaitingFilm>, Without<FilmSlot>)>,
    outdated: &mut QueryState<(), With<FilmOutdated>>,
    building: &mut QueryState<&FilmSlot>,
    budget_films: &mut BudgetFilms,
    cameras: &mut Cameras,
) {
    let begin = Instant::now();
    let budget = world.resource::<DisplayCost>().leaves(*world.resource::<CoatingBudget>());
    let max_steps = u64::from(budget.max_steps.max(1));
    let seconds = world.get_resource::<Time>().map_or(0.0, Time::delta_secs_f64);
    let (age, passes) = plan(world, films, max_steps, seconds);
    plan_budget(world, budget_films, cameras, budget);
    let mut time = FrameTime::new(films.iter(world).map(|(pace, ..)| pace), max_steps);
    while time.begin_round() {
        let mut work = 0;
        for (mut pace, ..) in films.iter_mut(world) {
            let pace = pace.bypass_change_detection();
            pace.due = !pace.held && !pace.postponed && pace.account.take(time.now());
            work += if pace.due { pace.cost } else { 0 };
        }
        world.resource_mut::<StepCost>().count(work);
        world.run_schedule(CoatingStep);
        if budget.fixed_cost.is_none() && begin.elapsed() >= budget.max_time {
            break;
        }
    }
    if time.has_run() {
        world.resource_mut::<StepCost>().learn(begin.elapsed());
    }
    let mut status = settle(world, films, time.now());
    status.waiting =
        waiting.iter(world).count() + building.iter(world).filter(|slot| slot.display_mesh.is_none()).count();
    status.refused = refused.iter(world).count();
    status.renewing = outdated.iter(world).count();
    status.age_per_second = world.resource_mut::<ReachedPace>().add(age * time.now(), seconds);
    let (weather, gravity) = (*world.resource::<CoatingWeather>(), *world.resource::<CoatingGravity>());
    // Where nothing ages, time passes all the same.
    world.resource_mut::<CoatingCalendar>().pass(if age > 0.0 { age * time.now() } else { passes }, weather, gravity);
    let mut current = world.resource_mut::<CoatingStatus>();
    current.set_if_neq(status);
}

/// Plans the steps of each film in this frame from the clock and the requested steps. Returns the age that the frame is
/// worth, 0 if no film ages, and the age that the clock asked for.
fn plan(world: &mut World, films: &mut Films, max_steps: u64, seconds: f64) -> (f64, f64) {
    let gravity = *world.resource::<CoatingGravity>();
    let weather = *world.resource::<CoatingWeather>();
    let (clock, requested) = {
        let mut clock = world.resource_mut::<CoatingClock>();
        let clock = clock.bypass_change_detection();
        let requested = std::mem::take(&mut clock.requested_steps);
        (clock.clone(), requested)
    };
    // An infinite speed gives NaN in a frame without time.
    let wanted = if seconds > 0.0 && !clock.paused { clock.checked_speed() * seconds } else { 0.0 };
    let target = clock.checked_target();
    for (mut pace, clock_of_film, transform, mut shelter, mut stains) in films.iter_mut(world) {
        let pace = pace.bypass_change_detection();
        pace.environment = pace.weather.unwrap_or(weather).environment(gravity, transform);
        // A new exposure changes no stain yet, so display need not notice it.
        shelter.bypass_change_detection().finish(stains.bypass_change_detection());
        pace.held = shelter.holds_back(&pace.environment);
        let steps_per_age = pace.rate * f64::from(clock_of_film.steps_per_age);
        let left = target.map_or(u64::MAX, |age| clock_of_film.step_at(age).saturating_sub(clock_of_film.steps));
        pace.account.begin(steps_per_age, left, wanted > 0.0, !pace.paused && !pace.travels);
        let of_film = std::mem::take(&mut pace.requested_steps);
        pace.account.request(requested.saturating_add(of_film));
    }
    let age = shorten_age(wanted, max_steps, films.iter(world).map(|(pace, ..)| pace));
    let mut any = false;
    for (mut pace, ..) in films.iter_mut(world) {
        let pace = pace.bypass_change_detection();
        pace.account.give(age);
        any |= pace.account.is_ageing();
        pace.planned = pace.account.due(1.0).min(max_steps);
        pace.held &= pace.planned > 0;
    }
    (if any { age } else { 0.0 }, wanted)
}

/// Ends the frame at `time` for all films, and returns the counts for [`CoatingStatus`].
fn settle(world: &mut World, films: &mut Films, time: f64) -> CoatingStatus {
    let mut status = CoatingStatus { youngest: f64::INFINITY, ..CoatingStatus::default() };
    for (mut pace, clock, ..) in films.iter_mut(world) {
        let pace = pace.bypass_change_detection();
        pace.due = false;
        status.films += 1;
        status.casting += usize::from(pace.held);
        status.seeking += usize::from(pace.travels);
        status.stepped += usize::from(pace.account.taken() > 0);
        status.postponed += usize::from(pace.postponed);
        status.youngest = status.youngest.min(clock.age());
        status.oldest = status.oldest.max(clock.age());
        pace.account.end(time);
    }
    if status.films == 0 {
        status.youngest = 0.0;
    }
    status
}
