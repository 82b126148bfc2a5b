//! The clock, the budget and the pace of single props.

use std::time::Duration;

use bevy::{
    diagnostic::{Diagnostic, DiagnosticPath, DiagnosticsStore},
    prelude::*,
    time::TimeUpdateStrategy,
};
use bevy_coating::{FilmPace, deform::SolverQuality, diagnostics, prelude::*};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

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
fn the_budget_bounds_the_steps_of_a_frame_and_slows_all_alike() {
    let mut app = app();
    app.insert_resource(CoatingBudget { max_steps: 4, ..CoatingBudget::UNLIMITED });
    // The rates do not divide the steps of a frame evenly, and two films take less than one step a frame.
    let rates = [2.0, 0.61, 0.17, 0.023];
    let plates = rates.map(|rate| spawn_plate(&mut app, 4, quick_coating().with_rate(rate)));
    wait_for_films(&mut app, 4);
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 2.0;
    for frame in 1..=300 {
        app.update();
        let taken = plates.map(|plate| steps(&app, plate));
        assert_eq!(taken[0], 4 * frame, "the fastest takes all it may");
        for (taken, rate) in taken.iter().zip(rates) {
            let due = 4.0 * frame as f64 * rate / 2.0;
            assert!((*taken as f64 - due).abs() <= 1.0, "frame {frame}: {taken} steps of {due} at rate {rate}");
        }
    }
    // 0.1 of age a frame of 50 ms was asked for, but 4 steps of the fastest are 0.02.
    let status = app.world().resource::<CoatingStatus>();
    assert!((status.age_per_second - 0.4).abs() < 1e-9, "{status:?}");
    let taken = plates.map(|plate| steps(&app, plate));
    clock(&mut app).paused = true;
    app.update();
    assert_eq!(plates.map(|plate| steps(&app, plate)), taken, "what did not fit is not owed");
    clock(&mut app).request_steps(10);
    app.update();
    assert_eq!(steps(&app, plates[0]), taken[0] + 4);
    for _ in 0..30 {
        app.update();
    }
    assert_eq!(plates.map(|plate| steps(&app, plate)), taken.map(|steps| steps + 10), "but requests wait");
    assert_eq!(app.world().resource::<CoatingStatus>().age_per_second, 0.0);
}

/// A slow plate beside a fast one, at 60 frames a second with the budget that games have but for the time, so that the
/// machine does not matter.
fn slow_beside_fast() -> (App, [Entity; 2]) {
    let mut app = app();
    app.insert_resource(CoatingBudget { max_time: Duration::MAX, ..CoatingBudget::default() });
    let plates = [1.0, 0.05].map(|rate| {
        let coating = quick_coating().with_steps_per_age(1000).with_rate(rate);
        spawn_plate(&mut app, 2, coating)
    });
    wait_for_films(&mut app, 2);
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs(1) / 60));
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 2.0;
    (app, plates)
}

#[test]
fn a_slow_prop_keeps_its_pace_beside_a_fast_one() {
    let (mut app, plates) = slow_beside_fast();
    for _ in 0..600 {
        app.update();
    }
    // 33 steps a frame are asked for, and 16 taken.
    let [fast, slow] = plates.map(|plate| steps(&app, plate));
    assert!((9584..=9600).contains(&fast) && (479..=480).contains(&slow), "{fast} {slow}");
}

#[test]
fn requested_steps_come_on_top_of_those_that_time_brings() {
    let (mut app, plates) = slow_beside_fast();
    clock(&mut app).request_steps(10_000);
    for _ in 0..2000 {
        app.update();
    }
    let [fast, slow] = plates.map(|plate| steps(&app, plate) as f64 - 10_000.0);
    assert!(fast > 10_000.0 && (slow - 0.05 * fast).abs() <= 2.0, "{fast} {slow}");
}

#[test]
fn paces_keep_their_ratio_at_any_cap_and_frame_rate() {
    for seed in 0..6 {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut app = app();
        let rates: Vec<f64> = (0..5).map(|_| 10f64.powf(rng.random_range(-1.5..1.5))).collect();
        let plates: Vec<Entity> =
            rates.iter().map(|&rate| spawn_plate(&mut app, 2, quick_coating().with_rate(rate))).collect();
        wait_for_films(&mut app, rates.len());
        let max_steps = [1, 2, 5, 16, 100][rng.random_range(0..5)];
        app.insert_resource(CoatingBudget { max_steps, ..CoatingBudget::UNLIMITED });
        clock(&mut app).paused = false;
        clock(&mut app).age_per_second = 10f64.powf(rng.random_range(-1.0..1.0));
        let fastest = (0..rates.len()).max_by(|&a, &b| rates[a].total_cmp(&rates[b])).expect("films");
        for second in 0..10 {
            let before: Vec<u64> = plates.iter().map(|&plate| steps(&app, plate)).collect();
            let mut left = 1.0;
            while left > 0.0 {
                let frame = rng.random_range(0.002..0.2);
                app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_secs_f64(frame)));
                app.update();
                left -= frame;
            }
            let taken: Vec<f64> =
                plates.iter().zip(&before).map(|(&plate, before)| (steps(&app, plate) - before) as f64).collect();
            for (taken_here, rate) in taken.iter().zip(&rates) {
                let due = taken[fastest] * rate / rates[fastest];
                assert!((taken_here - due).abs() <= 2.0, "seed {seed}, second {second}: {taken:?} at {rates:?}");
            }
        }
    }
}

#[test]
fn nothing_that_films_are_owed_is_taken_while_they_are_paused() {
    // There is time for one of the three films a frame, so two owe steps at any time.
    let mut app = app();
    let plates = [0; 3].map(|_| spawn_plate(&mut app, 4, quick_coating()));
    wait_for_films(&mut app, 3);
    take_steps(&mut app, 1);
    let (max_time, fixed_cost) = (Duration::from_millis(1), Some(Duration::from_secs(1)));
    app.insert_resource(CoatingBudget { max_time, max_steps: 100, fixed_cost });
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 0.8;
    for _ in 0..5 {
        app.update();
    }
    let taken = plates.map(|plate| steps(&app, plate));
    assert!(taken.iter().min() < taken.iter().max(), "some have waited: {taken:?}");
    let stand_still = |app: &mut App, how: &str| {
        for _ in 0..6 {
            app.update();
        }
        assert_eq!(plates.map(|plate| steps(app, plate)), taken, "{how}");
    };
    clock(&mut app).paused = true;
    stand_still(&mut app, "a paused clock");
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 0.0;
    stand_still(&mut app, "a clock without speed");
    clock(&mut app).age_per_second = 0.8;
    app.world_mut().resource_mut::<Time<Virtual>>().pause();
    stand_still(&mut app, "paused time");
    app.world_mut().resource_mut::<Time<Virtual>>().unpause();
    for plate in plates {
        app.world_mut().get_mut::<Coating>(plate).expect("a coating").paused = true;
    }
    stand_still(&mut app, "paused props");
    for plate in plates {
        app.world_mut().get_mut::<Coating>(plate).expect("a coating").paused = false;
    }
    for _ in 0..60 {
        app.update();
    }
    let now = plates.map(|plate| steps(&app, plate));
    assert!(now.iter().max() <= now.iter().min().map(|least| least + 12).as_ref(), "all catch up afterwards: {now:?}");
}

#[test]
fn a_prop_is_paused_and_let_go_in_the_same_frame() {
    let mut app = app();
    let plate = ready_plate(&mut app, quick_coating());
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 1.0;
    for expected in [5, 5, 10, 10, 15] {
        app.world_mut().get_mut::<Coating>(plate).expect("a coating").paused = expected == steps(&app, plate);
        app.update();
        assert_eq!(steps(&app, plate), expected);
    }
}

#[test]
fn rate_and_quality_act_in_the_frame_in_which_they_are_set() {
    let mut app = app();
    let plate = ready_plate(&mut app, quick_coating());
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 1.0;
    let mut coating = app.world_mut().get_mut::<Coating>(plate).expect("a coating");
    (coating.rate, coating.quality) = (3.0, SolverQuality::High);
    app.update();
    assert_eq!(steps(&app, plate), 15);
    assert_eq!(app.world().get::<FilmPace>(plate).expect("a film").quality, SolverQuality::High);
}

#[test]
fn requested_steps_leave_paused_props_alone() {
    let mut app = app();
    let plates = [0; 2].map(|_| spawn_plate(&mut app, 4, quick_coating()));
    wait_for_films(&mut app, 2);
    app.world_mut().get_mut::<Coating>(plates[1]).expect("a coating").paused = true;
    take_steps(&mut app, 3);
    assert_eq!(plates.map(|plate| steps(&app, plate)), [3, 0]);
    app.world_mut().get_mut::<Coating>(plates[1]).expect("a coating").paused = false;
    app.update();
    assert_eq!(plates.map(|plate| steps(&app, plate)), [3, 0], "they were not meant");
    take_steps(&mut app, 3);
    assert_eq!(plates.map(|plate| steps(&app, plate)), [6, 3]);
}

#[test]
fn a_rate_that_goes_out_of_range_leaves_the_last_valid_one() {
    let mut app = app();
    let plate = ready_plate(&mut app, quick_coating().with_rate(0.5));
    clock(&mut app).paused = false;
    clock(&mut app).age_per_second = 0.4;
    // A step a frame.
    let mut expected = 0;
    for rate in [f64::NAN, f64::INFINITY, -1.0, 1000.5, f64::NEG_INFINITY, f64::MAX] {
        app.world_mut().get_mut::<Coating>(plate).expect("a coating").rate = rate;
        for _ in 0..3 {
            app.update();
            expected += 1;
            assert_eq!(steps(&app, plate), expected, "rate {rate}");
        }
    }
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").rate = 1.0;
    app.update();
    assert_eq!(steps(&app, plate), expected + 2, "and a valid one is followed again");
}

#[test]
fn a_clock_out_of_range_stands_still_and_can_be_set_right() {
    let mut app = app();
    app.insert_resource(CoatingBudget { max_steps: 50, ..CoatingBudget::UNLIMITED });
    let plate = ready_plate(&mut app, quick_coating());
    clock(&mut app).paused = false;
    for speed in [f64::NAN, -1.0, f64::NEG_INFINITY, -0.0] {
        clock(&mut app).age_per_second = speed;
        app.update();
        assert_eq!(steps(&app, plate), 0, "speed {speed}");
    }
    clock(&mut app).age_per_second = 0.4;
    for target in [f64::NAN, -1.0, f64::NEG_INFINITY] {
        clock(&mut app).target_age = Some(target);
        app.update();
        assert_eq!(steps(&app, plate), 0, "target {target}");
    }
    clock(&mut app).target_age = Some(f64::INFINITY);
    app.update();
    assert_eq!(steps(&app, plate), 2, "an infinite target is none");
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

#[test]
fn steps_are_requested_of_one_prop_alone() {
    let mut app = app();
    let [one, other, still] = [1, 2, 3].map(|seed| {
        let coating = Coating { paused: seed == 3, ..quick_coating().with_seed(seed) };
        spawn_plate(&mut app, 6, coating)
    });
    wait_for_films(&mut app, 3);
    clock(&mut app).paused = true;
    for prop in [one, still] {
        app.world_mut().commands().entity(prop).request_steps(7);
    }
    for _ in 0..3 {
        app.update();
    }
    assert_eq!([one, other, still].map(|film| steps(&app, film)), [7, 0, 0]);
    app.world_mut().get_mut::<FilmPace>(other).expect("a film").request_steps(2);
    for _ in 0..3 {
        app.update();
    }
    assert_eq!([one, other, still].map(|film| steps(&app, film)), [7, 2, 0]);
    // What is no prop, or has no films yet, is left alone.
    let empty = app.world_mut().spawn_empty().id();
    app.world_mut().commands().entity(empty).request_steps(7);
    app.update();
}
