//! The clock, the budget and the pace of single props.

use std::time::Duration;

use bevy::{
    diagnostic::{Diagnostic, DiagnosticPath, DiagnosticsStore},
    prelude::*,
};
use bevy_coating::{diagnostics, prelude::*, sim::FilmClock};

use crate::common::*;

fn steps(app: &App, film: Entity) -> u64 {
    app.world().get::<FilmClock>(film).expect("a film").steps
}

fn clock(app: &mut App) -> Mut<'_, CoatingClock> {
    app.world_mut().resource_mut::<CoatingClock>()
}

/// A plate that is ready, with the clock stopped; a frame is 50 ms.
fn ready_plate(app: &mut App, coating: Coating) -> Entity {
    let plate = spawn_plate(app, 6, coating);
    wait_for_films(app, 1);
    plate
}

#[test]
fn age_per_second_becomes_whole_steps() {
    let mut app = app();
    let plate = ready_plate(&mut app, quick_coating());
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 0.07;
    for _ in 0..20 {
        app.update();
    }
    // 0.07 of age a second is 7 steps; a second has gone by.
    assert!((6..=7).contains(&steps(&app, plate)), "{}", steps(&app, plate));
}

#[test]
fn a_paused_clock_stands_still_but_for_requested_steps() {
    let mut app = app();
    let plate = ready_plate(&mut app, quick_coating());
    for _ in 0..10 {
        app.update();
    }
    assert_eq!(steps(&app, plate), 0);
    take_steps(&mut app, 1);
    assert_eq!(steps(&app, plate), 1);
    app.update();
    assert_eq!(steps(&app, plate), 1, "a single step is single");
}

#[test]
fn a_paused_prop_stands_still_while_others_age() {
    let mut app = app();
    let held = Coating { paused: true, ..quick_coating() };
    let plates = [spawn_plate(&mut app, 6, quick_coating()), spawn_plate(&mut app, 6, held)];
    wait_for_films(&mut app, 2);
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 1.0;
    for _ in 0..4 {
        app.update();
    }
    assert_eq!((steps(&app, plates[0]) > 10, steps(&app, plates[1])), (true, 0));
    app.world_mut().get_mut::<Coating>(plates[1]).expect("a coating").paused = false;
    for _ in 0..4 {
        app.update();
    }
    assert!(steps(&app, plates[1]) > 5, "and goes on when it is let go");
}

#[test]
fn the_target_stops_time_and_requests() {
    let mut app = app();
    let plate = ready_plate(&mut app, quick_coating());
    clock(&mut app).target_age = Some(0.25);
    take_steps(&mut app, 1000);
    assert_eq!(steps(&app, plate), 25);
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 3.0;
    for _ in 0..5 {
        app.update();
    }
    assert_eq!(steps(&app, plate), 25);
    clock(&mut app).target_age = Some(0.1);
    app.update();
    assert_eq!(steps(&app, plate), 25, "paint does not grow back");
    clock(&mut app).target_age = None;
    app.update();
    assert_eq!(steps(&app, plate), 40, "no leap: one frame is one frame");
}

#[test]
fn the_budget_bounds_the_steps_of_a_frame_and_drops_the_rest() {
    let mut app = app();
    app.insert_resource(CoatingBudget { max_steps: 4, ..CoatingBudget::UNLIMITED });
    let coatings = [1.0, 0.5, 2.0].map(|rate| quick_coating().with_rate(rate));
    let plates = coatings.map(|coating| spawn_plate(&mut app, 4, coating));
    wait_for_films(&mut app, 3);
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 2.0;
    for _ in 0..10 {
        app.update();
    }
    let taken = plates.map(|plate| steps(&app, plate));
    assert_eq!(taken[2], 40, "the fastest takes all it may");
    assert!((19..=21).contains(&taken[0]) && (9..=11).contains(&taken[1]), "the others keep their ratio: {taken:?}");
    clock(&mut app).paused = true;
    app.update();
    assert_eq!(plates.map(|plate| steps(&app, plate)), taken, "what did not fit is gone");
    clock(&mut app).request_steps(10);
    app.update();
    assert_eq!(steps(&app, plates[0]), taken[0] + 4);
    app.update();
    app.update();
    app.update();
    assert_eq!(plates.map(|plate| steps(&app, plate)), taken.map(|steps| steps + 10), "but requests wait");
}

#[test]
fn a_budget_without_time_still_takes_one_step() {
    let mut app = app();
    app.insert_resource(CoatingBudget { max_time: Duration::ZERO, max_steps: 0, ..CoatingBudget::default() });
    let plate = ready_plate(&mut app, quick_coating());
    clock(&mut app).request_steps(5);
    for frame in 1..=5 {
        app.update();
        assert_eq!(steps(&app, plate), frame);
    }
}

#[test]
fn infinite_speed_is_bounded_by_budget_and_target() {
    let mut app = app();
    app.insert_resource(CoatingBudget { max_steps: 30, ..CoatingBudget::UNLIMITED });
    let plate = ready_plate(&mut app, quick_coating());
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = f64::INFINITY;
    clock(&mut app).target_age = Some(0.5);
    app.update();
    assert_eq!(steps(&app, plate), 30);
    app.update();
    app.update();
    assert_eq!(steps(&app, plate), 50);
    clock(&mut app).age_per_second = f64::NAN;
    clock(&mut app).target_age = None;
    app.update();
    assert_eq!(steps(&app, plate), 50, "NaN is no time");
}

#[test]
fn steps_can_be_taken_in_any_schedule() {
    let mut app = bare_app();
    app.add_plugins(CoatingWeatheringPlugin::new(FixedUpdate)).insert_resource(CoatingBudget::UNLIMITED);
    app.insert_resource(Time::<Fixed>::from_hz(40.0));
    let plate = ready_plate(&mut app, quick_coating());
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 0.4;
    let before = app.world().resource::<Time<Fixed>>().elapsed();
    for _ in 0..20 {
        app.update();
    }
    let elapsed = app.world().resource::<Time<Fixed>>().elapsed() - before;
    assert_eq!(elapsed, Duration::from_secs(1));
    assert_eq!(steps(&app, plate), 40, "one a tick of a fortieth of a second");
}

#[test]
fn stages_report_their_time() {
    let mut app = app();
    app.add_plugins(bevy::diagnostic::DiagnosticsPlugin);
    ready_plate(&mut app, quick_coating());
    take_steps(&mut app, 50);
    let store = app.world().resource::<DiagnosticsStore>();
    let value = |path: DiagnosticPath| store.get(&path).and_then(Diagnostic::value).expect("a measurement");
    let busy = [
        diagnostics::FRACTURE,
        diagnostics::DEFORMATION,
        diagnostics::MESH_GENERATION,
        diagnostics::STAINS,
        diagnostics::OTHER,
    ];
    for path in busy {
        assert!(value(path.clone()) > 0.0, "{path}");
    }
    assert_eq!((value(diagnostics::FILMS), value(diagnostics::STEPPED)), (1.0, 1.0));
}
