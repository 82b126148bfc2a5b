//! A history goes anywhere, with the bits that were there.

use bevy_math::Vec3;

use super::{
    event::Event,
    film_history::History,
    keyframes::{Keyframe, Keyframes},
};
use crate::{
    deform::SolverQuality,
    film::{FaceId, HalfEdgeId, VertexId},
    remesh::sample,
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    stain::{Environment, Exposure},
    touch::{Change, Effect, Site, Touch},
};

fn history(triangles: u32) -> History {
    let settings = CoatingSettings::default();
    let piece = sample::plate(triangles, 5).expect("a plate");
    let film = FilmState::new(&piece.film, &settings, 5, 100).expect("a manifold");
    History::new(film, settings, Environment::default()).expect("a history")
}

fn touch(face: u32, effect: Effect) -> Event {
    Event::Touch(Touch::new(Site::new(FaceId(face), Vec3::ONE), 0.2, effect), face)
}

/// An event at each of some steps.
fn events() -> Vec<(u64, Event)> {
    let rain = Environment { rain: Vec3::NEG_Y, ..Environment::default() };
    vec![
        (0, Event::Adhesion(VertexId(3), f32::INFINITY)),
        (10, Event::Environment(rain)),
        (20, Event::Settings(Box::new(CoatingSettings::from(Preset::Heavy)))),
        (20, Event::StripFace(FaceId(100))),
        (35, Event::Exposure(Exposure { rain: vec![0.5; 40], sun: Vec::new() })),
        (40, Event::Environment(Environment::still(Vec3::new(0.6, -0.8, 0.0)))),
        (50, Event::Quality(SolverQuality::Fast)),
        (60, Event::Contraction(FaceId(7), 2.5)),
        (61, Event::Binding(HalfEdgeId(50), 0.1)),
        (62, touch(40, Effect::Dust(Change::Set(0.9)))),
        (70, touch(90, Effect::Hit(8.0))),
        (75, touch(100, Effect::Repaint)),
        (90, touch(20, Effect::Scratch(Site::new(FaceId(200), Vec3::ONE)))),
    ]
}

#[test]
fn a_stroke_is_taken_back_and_put_again_while_all_else_stays() {
    let mut history = history(300);
    history.set_keyframe_bytes(60_000);
    let mut other = history.clone();
    for step in 0..60 {
        for (face, at, stroke) in [(100, 20, 1), (110, 22, 1), (150, 30, 2)] {
            if step == at {
                let strip = Touch::new(Site::new(FaceId(face), Vec3::ONE), 0.15, Effect::Hit(9.0));
                assert!(history.record(Event::Touch(strip, stroke)));
                if stroke == 1 {
                    assert!(other.record(Event::Touch(strip, stroke)));
                }
            }
        }
        if step == 40 {
            let rain = Environment { rain: Vec3::NEG_Y, ..Environment::default() };
            for history in [&mut history, &mut other] {
                assert!(history.record(Event::Environment(rain)));
            }
        }
        for history in [&mut history, &mut other] {
            history.step().expect("a step");
        }
    }
    let all = history.film().digest();
    let taken = history.undo().expect("a way").expect("a stroke");
    assert_eq!(taken.len(), 1);
    assert_eq!(history.film().digest(), other.film().digest(), "as if the second stroke had never been");
    let first = history.undo().expect("a way").expect("a stroke");
    assert_eq!((first.len(), history.undo().expect("no way")), (2, None));
    history.redo(&first).expect("a way");
    assert_eq!(history.film().digest(), other.film().digest());
    history.redo(&taken).expect("a way");
    assert_eq!(history.film().digest(), all);
    history.seek(25).expect("the past");
    history.seek(60).expect("the future");
    assert_eq!(history.film().digest(), all);
}

#[test]
fn every_step_is_again_what_it_was() {
    let mut history = history(300);
    history.set_keyframe_bytes(40_000);
    let (mut events, mut digests) = (events().into_iter().peekable(), Vec::new());
    for step in 0..=120 {
        while let Some((_, event)) = events.next_if(|(at, _)| *at == step) {
            assert!(history.record(event.clone()), "{event:?} changes something");
        }
        digests.push(history.film().digest());
        history.step().expect("a step");
    }
    assert!(history.keyframe_bytes() <= 40_000 && history.keyframe_steps().count() > 2);
    for step in [100, 3, 0, 119, 20, 21, 19, 60, 61, 40, 120, 1, 120] {
        history.seek(step).expect("the past");
        assert_eq!(history.film().clock.steps, step);
        assert_eq!(history.film().digest(), digests[step as usize], "step {step}");
    }
}

#[test]
fn a_change_in_the_past_forgets_the_future_alone() {
    let mut history = history(200);
    history.seek(30).expect("a step");
    assert!(history.record(Event::Quality(SolverQuality::High)));
    history.seek(80).expect("a step");
    history.seek(20).expect("the past");
    let same = Event::Environment(*history.environment());
    assert!(!history.record(same), "nothing changes");
    assert!(
        !history.record(Event::TearEdge(HalfEdgeId(u32::MAX))) && !history.record(Event::Adhesion(VertexId(9999), 1.0))
    );
    assert_eq!(history.log().len(), 1, "the future is still there");
    assert!(history.record(Event::Adhesion(VertexId(4), 0.0)));
    assert_eq!((history.log().len(), history.log()[0].step), (1, 20));
    assert!(history.keyframe_steps().all(|step| step <= 20));
    history.seek(80).expect("a step");
    assert_eq!(history.film().quality, SolverQuality::Default);
    let digest = history.film().digest();
    history.seek(0).expect("the past");
    history.seek(80).expect("a step");
    assert_eq!(history.film().digest(), digest);
}

#[test]
fn a_history_begins_where_its_film_is() {
    let mut film = history(200).into_film();
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    film.age_to(0.5, &settings, &environment);
    let digest = film.digest();
    let mut history = History::new(film, settings, environment).expect("a history");
    history.seek(90).expect("a step");
    history.seek(10).expect("the past");
    assert_eq!((history.film().clock.steps, history.film().digest()), (50, digest));
}

#[test]
fn keyframes_are_thinned_evenly() {
    let keyframe = |step: u64| Keyframe { step, state: vec![0; 1000].into() };
    let mut keyframes = Keyframes::new(keyframe(0), 20_000);
    for step in 1..=1000 {
        if keyframes.is_due(step) {
            keyframes.push(keyframe(step));
        }
        assert!(keyframes.bytes() <= 20_000);
    }
    let steps: Vec<u64> = keyframes.steps().collect();
    let gaps: Vec<u64> = steps.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let (least, most) = (gaps.iter().min(), gaps.iter().max());
    assert!(steps.len() >= 15 && most < Some(&130) && least > Some(&15), "{gaps:?}");
    keyframes.set_budget(0);
    assert_eq!(keyframes.steps().collect::<Vec<_>>(), [0], "the first stays");
}

#[test]
fn a_long_log_moves_the_beginning() {
    let mut history = history(200);
    history.set_keyframe_bytes(20_000);
    let mut digests = vec![history.film().digest()];
    for step in 0..400_u32 {
        let tilt = bevy_math::ops::sin(step as f32 * 0.1 + 0.1);
        let turned = Environment::still(Vec3::new(tilt, -1.0, 0.0).normalize());
        assert!(history.record(Event::Environment(turned)));
        history.step().expect("a step");
        digests.push(history.film().digest());
    }
    assert!(history.log().len() < 400, "the log is bounded: {}", history.log().len());
    let first = history.keyframe_steps().next().expect("a keyframe");
    assert!(first > 0 && history.log()[0].step >= first);
    history.seek(0).expect("the past");
    assert_eq!(history.film().clock.steps, first, "there is nothing before");
    for step in [first, 399, first + 1, 400] {
        history.seek(step).expect("the past");
        assert_eq!(history.film().digest(), digests[step as usize], "step {step}");
    }
}
