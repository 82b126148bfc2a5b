//! Whose turn it is, where a frame has no time for the steps of all films.
//!
//! Near and large films come first, but none waits for ever: whoever waits gains credit, the more the larger it is on
//! screen, and the frame's time goes to those with most credit. A film that waits keeps the steps it owes and takes them
//! together later. Its state depends on the steps alone, so it is the same as if it had never waited (but for weather
//! that changed meanwhile).

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
/// Share of a film that fills the view, of one so far away that it can hardly be seen: none waits more than this many
/// times longer than another.
const LEAST_SHARE: f32 = 1.0 / 16.0;
/// What a step costs even if nothing moves, in vertices that move.
const FIXED_COST: usize = 200;
/// Share of the last frame in what a vertex is taken to cost.
const NEWEST: f64 = 0.2;

/// Steps that a film may owe because it waited: so many frames' worth.
pub(super) const BACKLOG_FRAMES: u32 = 4;

/// What steps have cost lately.
#[derive(Resource, Debug, Default)]
pub(crate) struct StepCost {
    /// Seconds a moving vertex and step; 0 before there is any.
    per_vertex: f64,
    /// Vertices times steps of this frame.
    work: u64,
    /// Turns of this frame, kept for its room.
    order: Vec<Turn>,
}

/// A film that has steps to take.
#[derive(Debug)]
struct Turn {
    entity: Entity,
    credit: f32,
    seconds: f64,
}

/// Middle and radius of a film at rest.
pub(crate) fn bounds(geometry: &Geometry) -> (Vec3, f32) {
    let points = &geometry.rest_positions;
    let (min, max) =
        points.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(min, max), &p| (min.min(p), max.max(p)));
    if points.is_empty() { (Vec3::ZERO, 0.0) } else { ((min + max) * 0.5, (max - min).length() * 0.5) }
}

/// The films that have a turn, and the cameras that look at them.
pub(super) type Waiting =
    QueryState<(Entity, &'static mut FilmPace, &'static FilmConstraints, &'static GlobalTransform)>;
/// The cameras.
pub(super) type Cameras = QueryState<(&'static Camera, &'static GlobalTransform), With<Camera>>;

/// Lets films wait whose steps do not fit into the frame; one always goes. Gives the largest number of steps that
/// one of the others has planned.
pub(super) fn choose(world: &mut World, films: &mut Waiting, cameras: &mut Cameras, budget: CoatingBudget) -> u64 {
    let mut cost = std::mem::take(&mut *world.resource_mut::<StepCost>());
    let most = u64::from(budget.max_steps.max(1));
    let per_vertex = budget.fixed_cost.map_or(cost.per_vertex, |cost| cost.as_secs_f64() / 1000.0);
    let (mut rounds, mut whole) = (0, 0.0);
    cost.order.clear();
    for (entity, mut pace, constraints, _) in films.iter_mut(world) {
        let pace = pace.bypass_change_detection();
        pace.waits = false;
        pace.cost = 0;
        if pace.planned == 0 {
            pace.credit = 0.0;
            continue;
        }
        rounds = rounds.max(pace.planned);
        pace.cost = (FIXED_COST + constraints.awake_count()) as u64;
        let seconds = (pace.cost * pace.planned.min(most)) as f64 * per_vertex;
        whole += seconds;
        cost.order.push(Turn { entity, credit: 0.0, seconds });
    }
    if whole > budget.max_time.as_secs_f64() {
        rounds = take_turns(world, films, cameras, budget.max_time, &mut cost.order);
    }
    *world.resource_mut::<StepCost>() = cost;
    rounds
}

/// Sorts films by credit, and lets those wait that no longer fit.
fn take_turns(
    world: &mut World,
    films: &mut Waiting,
    cameras: &mut Cameras,
    time: Duration,
    order: &mut [Turn],
) -> u64 {
    let eyes: Vec<Vec3> =
        cameras.iter(world).filter(|(camera, _)| camera.is_active).map(|(_, at)| at.translation()).collect();
    for turn in order.iter_mut() {
        let Ok((_, mut pace, _, transform)) = films.get_mut(world, turn.entity) else { continue };
        let pace = pace.bypass_change_detection();
        pace.credit += share_of_view(pace, transform, &eyes);
        turn.credit = pace.credit;
    }
    // Entities last, so that the order is one of the scene and not of chance.
    order.sort_unstable_by(|a, b| b.credit.total_cmp(&a.credit).then(a.entity.cmp(&b.entity)));
    let (mut left, mut rounds) = (time.as_secs_f64(), 0);
    for (i, turn) in order.iter().enumerate() {
        let Ok((_, mut pace, ..)) = films.get_mut(world, turn.entity) else { continue };
        let pace = pace.bypass_change_detection();
        if i > 0 && turn.seconds > left {
            pace.waits = true;
            continue;
        }
        left -= turn.seconds;
        pace.credit = 0.0;
        rounds = rounds.max(pace.planned);
    }
    rounds
}

/// How large a film is to the nearest camera: its radius over its distance, from [`LEAST_SHARE`] to 1. Without
/// cameras all are alike.
fn share_of_view(pace: &FilmPace, transform: &GlobalTransform, eyes: &[Vec3]) -> f32 {
    let (_, rotation, translation) = transform.to_scale_rotation_translation();
    let middle = translation + rotation * pace.bounds.0;
    let nearest = eyes.iter().map(|eye| eye.distance(middle)).reduce(f32::min);
    let share = nearest.map_or(1.0, |distance| pace.bounds.1 / distance);
    // NaN, of a film without extent at a camera, is the least.
    if share > LEAST_SHARE { share.min(1.0) } else { LEAST_SHARE }
}

impl StepCost {
    /// Counts steps that are taken: their vertices.
    pub fn count(&mut self, vertices: u64) {
        self.work += vertices;
    }

    /// Learns from a frame whose steps took `elapsed`.
    pub fn learn(&mut self, elapsed: Duration) {
        if self.work > 0 {
            let now = elapsed.as_secs_f64() / self.work as f64;
            let known = self.per_vertex;
            self.per_vertex = if known > 0.0 { known + NEWEST * (now - known) } else { now };
        }
        self.work = 0;
    }
}
