//! A frame that has no time for all: near props first, none forgotten, and the same state in the end.

use std::time::Duration;

use bevy::prelude::*;
use bevy_coating::{CoatingBudget, CoatingClock, CoatingStatus, sim::FilmClock};

use crate::common::*;

/// So many steps a frame, if there is time.
const STEPS: u64 = 2;

/// Plates at these distances from a camera, with time for one of them a frame.
fn crowd(distances: &[f32]) -> (App, Vec<Entity>) {
    let mut app = app();
    let plates: Vec<Entity> = distances
        .iter()
        .map(|&z| {
            let plate = spawn_plate(&mut app, 4, quick_coating());
            app.world_mut().entity_mut(plate).insert(Transform::from_xyz(0.0, 0.0, -z));
            plate
        })
        .collect();
    app.world_mut().spawn((Camera::default(), Transform::default()));
    wait_for_films(&mut app, distances.len());
    take_steps(&mut app, 1);
    app.insert_resource(CoatingBudget {
        max_time: Duration::from_millis(1),
        max_steps: 100,
        fixed_cost: Some(Duration::from_secs(1)),
    });
    (app, plates)
}

fn steps(app: &App, film: Entity) -> u64 {
    app.world().get::<FilmClock>(film).expect("a film").steps
}

fn age(app: &mut App, frames: u32) {
    for _ in 0..frames {
        // 50 ms a frame.
        let mut clock = app.world_mut().resource_mut::<CoatingClock>();
        clock.paused = false;
        clock.age_per_second = STEPS as f64 / 0.05 / 100.0;
        app.update();
    }
}

#[test]
fn near_props_come_first_and_none_waits_for_ever() {
    let (mut app, plates) = crowd(&[40.0, 1.0, 4.0]);
    age(&mut app, 1);
    let taken: Vec<u64> = plates.iter().map(|&plate| steps(&app, plate)).collect();
    assert_eq!(taken, [1, 1 + STEPS, 1], "the nearest goes first");
    assert_eq!(app.world().resource::<CoatingStatus>().postponed, 2);
    age(&mut app, 120);
    let taken: Vec<u64> = plates.iter().map(|&plate| steps(&app, plate)).collect();
    assert!(taken[1] > taken[2] && taken[2] > taken[0], "near ones get more of the time: {taken:?}");
    assert!(taken[0] > 8, "but the far one gets its turns: {taken:?}");
}

#[test]
fn who_waited_takes_what_it_owes_together_and_is_the_same() {
    let (mut app, plates) = crowd(&[30.0, 1.0]);
    let far = plates[0];
    let mut most = 0;
    for _ in 0..60 {
        let before = steps(&app, far);
        age(&mut app, 1);
        most = most.max(steps(&app, far) - before);
    }
    assert!(most > STEPS, "several frames' worth at once");
    let (mut alone, plate) = crowd(&[30.0]);
    alone.insert_resource(CoatingBudget::UNLIMITED);
    let wanted = steps(&app, far) - steps(&alone, plate[0]);
    take_steps(&mut alone, wanted);
    assert_eq!(steps(&alone, plate[0]), steps(&app, far));
    assert_eq!(film_state(&alone, plate[0]).digest(), film_state(&app, far).digest());
}

#[test]
fn requests_wait_for_their_turn_and_are_all_met() {
    let (mut app, plates) = crowd(&[1.0, 2.0, 30.0]);
    app.world_mut().resource_mut::<CoatingClock>().paused = true;
    app.world_mut().resource_mut::<CoatingClock>().request_steps(7);
    app.update();
    let taken: u64 = plates.iter().map(|&plate| steps(&app, plate) - 1).sum();
    assert!(taken < 21, "there was time for one film");
    for _ in 0..80 {
        app.update();
    }
    assert!(plates.iter().all(|&plate| steps(&app, plate) == 8));
}

#[test]
fn with_time_for_all_nobody_waits() {
    let (mut app, plates) = crowd(&[1.0, 30.0]);
    app.insert_resource(CoatingBudget::UNLIMITED);
    age(&mut app, 10);
    assert!(plates.iter().all(|&plate| steps(&app, plate) == 1 + 10 * STEPS));
    assert_eq!(app.world().resource::<CoatingStatus>().postponed, 0);
}
