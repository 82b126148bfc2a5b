//! Shares the budget of a frame between the films and postpones the films whose steps do not fit.
//!
//! Near and large films come first, but no film is postponed for ever: in each frame a film gains credit, the more the
//! larger it is in view, and the frame's time goes to the films with the most credit. A postponed film keeps the steps
//! that it owes and takes them together later. Its state depends on the steps alone, so it ends up as if it had not
//! been postponed (except for weather that changed meanwhile).

use std::time::Duration;

use bevy::{
    camera::Camera,
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        query::{QueryState, With},
        resource::Resource,
        world::World,
    },
    math::Vec3,
    transform::components::GlobalTransform,
};

use crate::{
    api::{budget::CoatingBudget, film_pace::FilmPace},
    deform::FilmConstraints,
    film::Geometry,
};

/// Cost of a step in which nothing moves, in moving vertices.
const FIXED_COST: usize = 200;
/// Weight of the last frame in the running mean of the cost of a vertex.
const NEWEST: f64 = 0.2;

/// Measured cost of steps, and the buffer of [`plan_budget`].
#[derive(Resource, Debug, Default)]
pub(crate) struct StepCost {
    /// Running mean of the seconds for one moving vertex in one step; 0 before the first measurement.
    per_vertex: f64,
    /// Moving vertices of all steps in this frame.
    work: u64,
    /// Films with steps to take in this frame; kept as a buffer.
    candidates: Vec<Candidate>,
}

/// Film with steps to take in this frame.
#[derive(Debug)]
struct Candidate {
    entity: Entity,
    /// Priority: the film with the most credit steps first.
    credit: f32,
    /// Expected time of its steps.
    seconds: f64,
}

/// Returns the centre and radius of a sphere around a film at rest, in the space of the scaled mesh, in which the film
/// has its zero at `origin`, but in units of the world, which are `metres_per_unit` long.
pub(crate) fn bounds(geometry: &Geometry, origin: Vec3, metres_per_unit: f32) -> (Vec3, f32) {
    let points = &geometry.rest_positions;
    let (min, max) =
        points.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), &p| (min.min(p), max.max(p)));
    if points.is_empty() {
        return (Vec3::ZERO, 0.0);
    }
    (((min + max) * 0.5 + origin) / metres_per_unit, (max - min).length() * 0.5 / metres_per_unit)
}

/// Query of the films that share the budget.
pub(super) type BudgetFilms =
    QueryState<(Entity, &'static mut FilmPace, &'static FilmConstraints, &'static GlobalTransform)>;
/// Query of the cameras that look at the films.
pub(super) type Cameras = QueryState<(&'static Camera, &'static GlobalTransform), With<Camera>>;

/// Postpones the films whose steps do not fit into the frame, but never all of them.
pub(super) fn plan_budget(world: &mut World, films: &mut BudgetFilms, cameras: &mut Cameras, budget: CoatingBudget) {
    let mut cost = std::mem::take(&mut *world.resource_mut::<StepCost>());
    let per_vertex = budget.fixed_cost.map_or(cost.per_vertex, |cost| cost.as_secs_f64() / 1000.0);
    let mut whole = 0.0;
    cost.candidates.clear();
    for (entity, mut pace, constraints, _) in films.iter_mut(world) {
        let pace = pace.bypass_change_detection();
        pace.postponed = false;
        pace.cost = 0;
        if pace.planned == 0 || pace.held {
            pace.credit = 0.0;
            continue;
        }
        pace.cost = (FIXED_COST + constraints.awake_count()) as u64;
        let seconds = pace.cost as f64 * pace.planned as f64 * per_vertex;
        whole += seconds;
        cost.candidates.push(Candidate { entity, credit: 0.0, seconds });
    }
    if whole > budget.max_time.as_secs_f64() {
        share_budget(world, films, cameras, budget.max_time, &mut cost.candidates);
    }
    *world.resource_mut::<StepCost>() = cost;
}

/// Sorts the films by credit and postpones the films that no longer fit into `time`.
fn share_budget(
    world: &mut World,
    films: &mut BudgetFilms,
    cameras: &mut Cameras,
    time: Duration,
    candidates: &mut [Candidate],
) {
    let eyes: Vec<Vec3> =
        cameras.iter(world).filter(|(camera, _)| camera.is_active).map(|(_, at)| at.translation()).collect();
    for candidate in candidates.iter_mut() {
        let Ok((_, mut pace, _, transform)) = films.get_mut(world, candidate.entity) else { continue };
        let pace = pace.bypass_change_detection();
        pace.credit += pace.share_of_view(transform, &eyes);
        candidate.credit = pace.credit;
    }
    // Ties are decided by entity, so that the order is always the same.
    candidates.sort_unstable_by(|a, b| b.credit.total_cmp(&a.credit).then(a.entity.cmp(&b.entity)));
    let mut left = time.as_secs_f64();
    for (i, candidate) in candidates.iter().enumerate() {
        let Ok((_, mut pace, ..)) = films.get_mut(world, candidate.entity) else { continue };
        let pace = pace.bypass_change_detection();
        if i > 0 && candidate.seconds > left {
            pace.postponed = true;
            continue;
        }
        left -= candidate.seconds;
        pace.credit = 0.0;
    }
}

impl StepCost {
    /// Adds the moving vertices of steps that are taken.
    pub fn count(&mut self, vertices: u64) {
        self.work += vertices;
    }

    /// Updates the running mean with a frame whose steps took `elapsed`.
    pub fn learn(&mut self, elapsed: Duration) {
        if self.work > 0 {
            let now = elapsed.as_secs_f64() / self.work as f64;
            let known = self.per_vertex;
            self.per_vertex = if known > 0.0 { known + NEWEST * (now - known) } else { now };
        }
        self.work = 0;
    }
}
