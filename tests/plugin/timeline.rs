//! Films that go back and forward in time.

use bevy::prelude::*;
use bevy_coating::{CoatingPart, FilmEdit, FilmHistory, FilmPace, film::FilmMesh, prelude::*, stain::StainFields};

use crate::common::*;

fn digest(app: &App, film: Entity) -> String {
    film_state(app, film).digest()
}

fn steps(app: &App, film: Entity) -> u64 {
    app.world().get::<FilmClock>(film).expect("a film").steps
}

/// Asks for `age` and waits until the film is there.
fn seek(app: &mut App, film: Entity, age: f64) {
    messages::<AgeReached>(app);
    app.world_mut().get_mut::<FilmClock>(film).expect("a film").seek(age);
    update_until(app, |app| {
        // A way that was under way to another age may end first.
        let reached = messages::<AgeReached>(app);
        let is_there = app.world().get::<FilmClock>(film).is_some_and(|clock| clock.sought().is_none());
        is_there && reached.iter().any(|reached| reached.entity == film)
    });
}

/// A plate whose past is kept, at age 0, with the clock stopped.
fn kept_plate(app: &mut App) -> Entity {
    let plate = spawn_plate(app, 10, quick_coating());
    app.world_mut().entity_mut(plate).insert(CoatingHistory::default());
    wait_for_films(app, 1);
    plate
}

/// Takes `count` steps one by one and returns the digest before each, and after the last.
fn live(app: &mut App, film: Entity, count: u64) -> Vec<String> {
    let mut digests = vec![digest(app, film)];
    for step in 1..=count {
        let before = steps(app, film);
        take_steps(app, 1);
        // Where it has begun to rain, rays are cast first.
        update_until(app, |app| steps(app, film) > before);
        assert_eq!(steps(app, film), before + 1, "step {step}");
        digests.push(digest(app, film));
    }
    digests
}

#[test]
fn a_film_goes_to_any_age_and_is_what_it_was() {
    let mut app = app();
    let plate = kept_plate(&mut app);
    let mut digests = live(&mut app, plate, 30);
    app.world_mut().resource_mut::<CoatingWeather>().rain = Vec3::new(0.6, -0.8, 0.0);
    digests.extend(live(&mut app, plate, 30).split_off(1));
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").settings = Preset::Gentle.into();
    app.update();
    digests.extend(live(&mut app, plate, 60).split_off(1));
    let clock = *app.world().get::<FilmClock>(plate).expect("a clock");
    for step in [100, 20, 0, 31, 119, 60, 59, 120, 61] {
        seek(&mut app, plate, step as f64 / 100.0);
        assert_eq!(steps(&app, plate), step);
        assert_eq!(digest(&app, plate), digests[step as usize], "step {step}");
        film_state(&app, plate).validate().expect("a sound film");
        let history = app.world().get::<FilmHistory>(plate).expect("a history");
        assert_eq!((history.first_age(&clock), history.last_age(&clock)), (0.0, 1.2));
    }
    assert_eq!(app.world().resource::<CoatingStatus>().seeking, 0);
}

#[test]
fn what_is_shown_follows_at_once_and_never_flashes() {
    let mut app = app();
    let plate = kept_plate(&mut app);
    let own = app.world().get::<bevy_coating::CoatedMesh>(plate).expect("its own mesh").0.clone();
    let shown = app.world().get::<Mesh3d>(plate).expect("a mesh").0.clone();
    assert_ne!(own, shown);
    let picture = |app: &App| {
        let mesh = app.world().resource::<Assets<Mesh>>().get(&shown).expect("an asset");
        let positions = mesh.attribute(Mesh::ATTRIBUTE_POSITION).expect("positions").as_float3().expect("floats");
        let triangles = triangles_of(mesh).into_iter();
        triangles.map(|t| t.map(|corner| positions[corner].map(f32::to_bits))).collect::<Vec<_>>()
    };
    let mut pictures = vec![picture(&app)];
    for _ in 0..4 {
        take_steps(&mut app, 25);
        pictures.push(picture(&app));
    }
    assert_ne!(pictures[0], pictures[4], "it has aged");
    app.world_mut().get_mut::<FilmClock>(plate).expect("a film").seek(0.25);
    messages::<AgeReached>(&mut app);
    update_until(&mut app, |app| {
        let arrived = !messages::<AgeReached>(app).is_empty();
        assert_eq!(picture(app), pictures[if arrived { 1 } else { 4 }], "arrived: {arrived}");
        assert_eq!(app.world().get::<Mesh3d>(plate).expect("a mesh").0, shown);
        arrived
    });
    for (i, before) in pictures.iter().enumerate().rev() {
        seek(&mut app, plate, i as f64 * 0.25);
        assert_eq!(picture(&app), *before, "age {}", i as f64 * 0.25);
    }
}

#[test]
fn edits_happen_again_and_another_edit_makes_another_future() {
    let mut app = app();
    let plate = kept_plate(&mut app);
    let edge = {
        let topology = &app.world().get::<FilmMesh>(plate).expect("a film").topology;
        topology.all_edges().find(|&h| topology.bound_twin(h).is_some()).expect("an edge")
    };
    take_steps(&mut app, 20);
    let before = digest(&app, plate);
    take_steps(&mut app, 5);
    app.world_mut().commands().entity(plate).queue(FilmEdit::TearEdge(edge));
    take_steps(&mut app, 40);
    let (age, torn) = (0.65, digest(&app, plate));
    seek(&mut app, plate, 0.2);
    assert_eq!(digest(&app, plate), before);
    seek(&mut app, plate, age);
    assert_eq!(digest(&app, plate), torn);
    // By the clock as well: nothing is other than it was then.
    seek(&mut app, plate, 0.2);
    take_steps(&mut app, 45);
    assert_eq!(digest(&app, plate), torn, "it tears again at age 0.25");
    // Another blow before: what came later never happens.
    seek(&mut app, plate, 0.1);
    let face = app.world().get::<FilmMesh>(plate).expect("a film").topology.live_faces().nth(70).expect("a face");
    app.world_mut().commands().entity(plate).queue(FilmEdit::StripFace(face));
    app.update();
    let history = app.world().get::<FilmHistory>(plate).expect("a history");
    assert_eq!(history.log().last().map(|entry| entry.step), Some(10), "the blow at age 0.25 is forgotten");
    take_steps(&mut app, 55);
    let other = digest(&app, plate);
    assert_ne!(other, torn);
    seek(&mut app, plate, 0.05);
    seek(&mut app, plate, age);
    assert_eq!(digest(&app, plate), other);
}

#[test]
fn other_weather_makes_another_future() {
    let mut app = app();
    let plate = kept_plate(&mut app);
    let dry = live(&mut app, plate, 80);
    seek(&mut app, plate, 0.3);
    let rain = |app: &mut App, rain| app.world_mut().resource_mut::<CoatingWeather>().rain = rain;
    // Looking at the future does not change it, whatever the weather today.
    rain(&mut app, Vec3::NEG_Y);
    seek(&mut app, plate, 0.8);
    assert_eq!(digest(&app, plate), dry[80]);
    seek(&mut app, plate, 0.3);
    take_steps(&mut app, 50);
    let wet = digest(&app, plate);
    assert_ne!(wet, dry[80]);
    rain(&mut app, Vec3::ZERO);
    seek(&mut app, plate, 0.3);
    assert_eq!(digest(&app, plate), dry[30]);
    seek(&mut app, plate, 0.8);
    assert_eq!(digest(&app, plate), wet, "the wet future is the one that was lived last");
}

#[test]
fn a_target_in_the_past_takes_films_with_a_past_back() {
    let mut app = app();
    let kept = kept_plate(&mut app);
    let other = spawn_plate(&mut app, 10, quick_coating());
    wait_for_films(&mut app, 2);
    take_steps(&mut app, 20);
    let before = digest(&app, kept);
    take_steps(&mut app, 40);
    app.world_mut().resource_mut::<CoatingClock>().target_age = Some(0.2);
    update_until(&mut app, |app| steps(app, kept) == 20);
    assert_eq!(digest(&app, kept), before);
    assert_eq!(steps(&app, other), 60, "what has no past stays as it is");
    app.world_mut().resource_mut::<CoatingClock>().target_age = Some(0.5);
    take_steps(&mut app, 90);
    assert_eq!((steps(&app, kept), steps(&app, other)), (50, 60));
}

#[test]
fn forward_needs_no_history_and_back_does() {
    let mut app = app();
    let [plate, twin] = [0; 2].map(|_| spawn_plate(&mut app, 10, quick_coating()));
    wait_for_films(&mut app, 2);
    seek(&mut app, plate, 0.7);
    take_steps(&mut app, 70);
    // The twin has taken the same steps in frames.
    let reached = digest(&app, plate);
    assert_eq!(steps(&app, plate), 140);
    take_steps(&mut app, 70);
    assert_eq!(digest(&app, twin), reached);
    app.world_mut().get_mut::<FilmClock>(twin).expect("a film").seek(0.1);
    for _ in 0..20 {
        app.update();
    }
    let clock = app.world().get::<FilmClock>(twin).expect("a film");
    assert_eq!((clock.steps, clock.sought()), (140, None), "it stays, and a warning says so");
}

#[test]
fn all_films_of_a_prop_go_to_an_age_also_before_they_are_ready() {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(6));
    let root = app.world_mut().spawn((Transform::default(), quick_coating())).id();
    let films = [0.0, 3.0].map(|x| {
        let at = Transform::from_xyz(x + 1.0, 0.0, 0.0);
        app.world_mut().spawn((Mesh3d(mesh.clone()), at, ChildOf(root))).id()
    });
    app.world_mut().commands().entity(root).age_to(0.4);
    wait_for_films(&mut app, 2);
    update_until(&mut app, |app| films.iter().all(|&film| steps(app, film) == 40));
    // Ages that are none count as 0, and nothing goes back without a history.
    for age in [f64::NAN, -1.0, f64::NEG_INFINITY] {
        app.world_mut().commands().entity(root).age_to(age);
        app.update();
        app.update();
    }
    assert!(films.iter().all(|&film| steps(&app, film) == 40));
}

#[test]
fn a_history_begins_late_goes_with_clones_and_ends() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 10, quick_coating().with_start_age(0.3));
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 10);
    app.world_mut().entity_mut(plate).insert(CoatingHistory { keyframe_bytes: 1 << 20 });
    update_until(&mut app, |app| app.world().get::<FilmHistory>(plate).is_some());
    let begin = digest(&app, plate);
    take_steps(&mut app, 30);
    let late = digest(&app, plate);
    let clone = app.world_mut().entity_mut(plate).clone_and_spawn();
    app.update();
    seek(&mut app, clone, 0.0);
    assert_eq!((steps(&app, clone), digest(&app, clone)), (40, begin), "as far as its history reaches");
    assert_eq!(digest(&app, plate), late, "the original does not notice");
    app.world_mut().entity_mut(plate).remove::<CoatingHistory>();
    app.update();
    assert!(app.world().get::<FilmHistory>(plate).is_none() && app.world().get::<FilmHistory>(clone).is_some());

    // One that is there from the start has all of the past, also that before the prop was seen.
    let early = spawn_plate(&mut app, 10, quick_coating().with_start_age(0.3));
    app.world_mut().entity_mut(early).insert(CoatingHistory::default());
    wait_for_films(&mut app, 3);
    seek(&mut app, early, 0.0);
    assert_eq!(steps(&app, early), 0);
    assert_eq!(film_state(&app, early).forces.torn_edges, 0);
}

#[test]
fn seeking_while_the_game_goes_on_ends_where_it_was_asked_to() {
    let mut app = app();
    let plate = kept_plate(&mut app);
    let digests = live(&mut app, plate, 100);
    app.world_mut().resource_mut::<CoatingClock>().paused = false;
    app.world_mut().resource_mut::<CoatingClock>().age_per_second = 1.0;
    // A scrub bar that is dragged: another age in every frame.
    for i in 0..200 {
        app.world_mut().get_mut::<FilmClock>(plate).expect("a film").seek(f64::from((i * 37) % 100) / 100.0);
        app.update();
        let at = steps(&app, plate) as usize;
        assert_eq!(digest(&app, plate), digests[at], "frame {i}");
    }
    app.world_mut().resource_mut::<CoatingClock>().paused = true;
    seek(&mut app, plate, 0.42);
    assert_eq!(digest(&app, plate), digests[42]);
    // A prop that is removed on the way, and one whose coating is.
    app.world_mut().get_mut::<FilmClock>(plate).expect("a film").seek(0.9);
    app.update();
    app.world_mut().entity_mut(plate).remove::<Coating>();
    app.update();
    assert!(app.world().get::<FilmHistory>(plate).is_none() && app.world().get::<FilmPace>(plate).is_none());
    let parts = app.world_mut().query::<&CoatingPart>().iter(app.world()).count();
    assert_eq!(parts, 0);
}

#[test]
fn rain_and_sun_are_known_again_after_going_back() {
    let mut app = app();
    app.world_mut().resource_mut::<CoatingWeather>().rain = Vec3::NEG_Z;
    let roof = add_mesh(&mut app, plate(2));
    let plate = kept_plate(&mut app);
    take_steps(&mut app, 20);
    let open = app.world().get::<StainFields>(plate).expect("stains").exposure.clone();
    app.world_mut().spawn((Mesh3d(roof), Transform::from_xyz(0.2, 0.0, 1.0), RainShelter));
    let sheltered = |app: &App| app.world().get::<StainFields>(plate).expect("stains").exposure != open;
    update_until(&mut app, |app| sheltered(app));
    take_steps(&mut app, 20);
    let late = digest(&app, plate);
    seek(&mut app, plate, 0.1);
    assert!(!sheltered(&app), "as it was then");
    seek(&mut app, plate, 0.4);
    assert_eq!(digest(&app, plate), late);
    seek(&mut app, plate, 0.1);
    app.world_mut().resource_mut::<CoatingClock>().request_steps(10);
    update_until(&mut app, |app| sheltered(app) && steps(app, plate) == 20);
}

#[test]
fn props_that_come_late_are_as_old_as_those_that_were_there() {
    let mut app = app();
    let coating = || quick_coating().with_seed(3).with_rate(0.5).with_painted(0.0);
    let calendar = |app: &App| app.world().resource::<CoatingCalendar>().date();
    let there = spawn_plate(&mut app, 8, coating());
    wait_for_films(&mut app, 1);
    assert_eq!((steps(&app, there), calendar(&app)), (0, 0.0));
    let run = |app: &mut App, frames: u32| {
        app.world_mut().resource_mut::<CoatingClock>().paused = false;
        app.world_mut().resource_mut::<CoatingClock>().age_per_second = 0.4;
        (0..frames).for_each(|_| app.update());
        app.world_mut().resource_mut::<CoatingClock>().paused = true;
    };
    run(&mut app, 20);
    app.world_mut().resource_mut::<CoatingWeather>().wind = Vec3::X * 2.0;
    app.update();
    run(&mut app, 40);
    assert!((calendar(&app) - 1.2).abs() < 0.02, "{}", calendar(&app));
    assert!((58..=60).contains(&steps(&app, there)), "{}", steps(&app, there));
    let late = spawn_plate(&mut app, 8, coating());
    wait_for_films(&mut app, 2);
    assert!(steps(&app, late).abs_diff(steps(&app, there)) <= 1);
    // The weather changed at the same age, give or take a step, so that the same has become of it.
    let cracks = |app: &App, film| film_state(app, film).forces.torn_edges as f64;
    assert!((cracks(&app, late) / cracks(&app, there) - 1.0).abs() < 0.1);

    // One that is saved, away for a while and back.
    let snapshot = CoatingSnapshot::of(app.world(), late).expect("a film that can be saved");
    app.world_mut().entity_mut(late).despawn();
    run(&mut app, 20);
    let mesh = add_mesh(&mut app, plate(8));
    let back = app.world_mut().spawn((Mesh3d(mesh.clone()), coating(), snapshot.clone())).id();
    wait_for_films(&mut app, 2);
    assert!(steps(&app, back).abs_diff(steps(&app, there)) <= 1, "{} {}", steps(&app, back), steps(&app, there));
    // Without a date it is as it was saved.
    let coating = Coating { painted: None, ..coating() };
    let kept = app.world_mut().spawn((Mesh3d(mesh), coating, snapshot)).id();
    wait_for_films(&mut app, 3);
    assert!((58..=60).contains(&steps(&app, kept)));
}

#[test]
fn what_passes_while_a_film_is_built_is_caught_up_with() {
    let mut app = app();
    app.world_mut().resource_mut::<CoatingClock>().age_per_second = 0.2;
    let plate = spawn_plate(&mut app, 8, quick_coating().with_painted(-0.5));
    update_until(&mut app, |app| app.world().get::<FilmMesh>(plate).is_some());
    for _ in 0..40 {
        app.update();
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    let date = app.world().resource::<CoatingCalendar>().date();
    let behind = (date + 0.5) * 100.0 - steps(&app, plate) as f64;
    assert!((0.0..4.0).contains(&behind), "{behind} steps");
    // A target holds for what is spawned late, too; a start age is what it is.
    app.world_mut().resource_mut::<CoatingClock>().target_age = Some(0.3);
    let late = spawn_plate(&mut app, 8, quick_coating().with_painted(-9.0));
    let old = spawn_plate(&mut app, 8, quick_coating().with_painted(-9.0).with_start_age(0.4));
    wait_for_films(&mut app, 3);
    app.update();
    assert_eq!((steps(&app, late), steps(&app, old)), (30, 40));
    app.world_mut().resource_mut::<CoatingClock>().target_age = None;
    let ancient = spawn_plate(&mut app, 4, quick_coating().with_painted(-1e300));
    wait_for_films(&mut app, 4);
    assert_eq!(steps(&app, ancient), 1000, "10 of age at most");
}

#[test]
fn years_pass_in_a_night() {
    let mut app = app();
    let [plate, slow, paused] = [1.0, 0.5, 1.0].map(|rate| spawn_plate(&mut app, 8, quick_coating().with_rate(rate)));
    wait_for_films(&mut app, 3);
    app.world_mut().get_mut::<Coating>(paused).expect("a coating").paused = true;
    app.update();
    for age in [f64::NAN, f64::INFINITY, -1.0, 0.4] {
        app.world_mut().resource_mut::<CoatingClock>().skip(age);
    }
    update_until(&mut app, |app| steps(app, plate) == 40 && steps(app, slow) == 20);
    assert_eq!(app.world().resource::<CoatingCalendar>().date(), 0.4);
    app.world_mut().resource_mut::<CoatingClock>().target_age = Some(0.5);
    app.world_mut().resource_mut::<CoatingClock>().skip(0.4);
    update_until(&mut app, |app| steps(app, plate) == 50 && steps(app, slow) == 40);
    app.update();
    assert_eq!((steps(&app, paused), app.world().resource::<CoatingStatus>().seeking), (0, 0));
}
