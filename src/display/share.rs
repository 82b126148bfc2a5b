//! Shares the time that a frame has for showing films between those that have changed.
//!
//! Films that are large in view come first, but none waits for ever: with each frame in which a film waits it gains
//! credit, the more the larger it is in view. What waits adds up and is shown together later. Ageing does not wait for
//! it.

use bevy::{
    camera::Camera,
    ecs::{
        change_detection::{DetectChanges, DetectChangesMut},
        entity::Entity,
        system::{Local, Query, Res, ResMut},
    },
    math::Vec3,
    transform::components::GlobalTransform,
};

use super::film_display::FilmDisplay;
use crate::{
    api::{budget::CoatingBudget, display_cost::DisplayCost, film_pace::FilmPace},
    appearance::DisplayChanges,
};

/// Film that has something to show.
pub(super) struct Candidate {
    entity: Entity,
    credit: f32,
    work: u64,
}

/// Decides which of the films that changed are shown in this frame: at least one, those that must be, and as many
/// others as fit.
pub(super) fn choose_films(
    mut films: Query<(Entity, &DisplayChanges, &mut FilmDisplay, &FilmPace, &GlobalTransform)>,
    cameras: Query<(&Camera, &GlobalTransform)>,
    budget: Res<CoatingBudget>,
    mut cost: ResMut<DisplayCost>,
    mut candidates: Local<Vec<Candidate>>,
) {
    cost.begin_frame();
    candidates.clear();
    let (mut whole, mut urgent) = (0, 0);
    for (entity, changes, mut display, ..) in &mut films {
        let must = display.is_added();
        let display = display.bypass_change_detection();
        let must = std::mem::take(&mut display.urgent) || must;
        display.due = must || !changes.is_empty();
        if !display.due {
            display.credit = 0.0;
            continue;
        }
        let work = display.work(*changes);
        whole += work;
        urgent += if must { work } else { 0 };
        if !must {
            candidates.push(Candidate { entity, credit: 0.0, work });
        }
    }
    let time = DisplayCost::share_of(*budget).as_secs_f64();
    if cost.seconds(whole) <= time {
        cost.count(whole);
        return;
    }
    let eyes: Vec<Vec3> =
        cameras.iter().filter(|(camera, _)| camera.is_active).map(|(_, at)| at.translation()).collect();
    for candidate in candidates.iter_mut() {
        let Ok((_, _, mut display, pace, transform)) = films.get_mut(candidate.entity) else { continue };
        let display = display.bypass_change_detection();
        display.credit += pace.share_of_view(transform, &eyes);
        candidate.credit = display.credit;
    }
    // Ties are decided by entity, so that the order is always the same.
    candidates.sort_unstable_by(|a, b| b.credit.total_cmp(&a.credit).then(a.entity.cmp(&b.entity)));
    let mut shown = urgent;
    for (i, candidate) in candidates.iter().enumerate() {
        let Ok((_, _, mut display, ..)) = films.get_mut(candidate.entity) else { continue };
        let display = display.bypass_change_detection();
        display.due = (i == 0 && urgent == 0) || cost.seconds(shown + candidate.work) <= time;
        if display.due {
            display.credit = 0.0;
            shown += candidate.work;
        }
    }
    cost.count(shown);
}
