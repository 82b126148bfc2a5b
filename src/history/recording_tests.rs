//! Recordings give the same past again, and nothing else is taken for one.

use bevy_math::{Vec3, ops};
use proptest::prelude::*;

use super::{
    event::Event,
    film_history::History,
    recording::{RECORDING, Recording},
    recording_error::RecordingError,
};
use crate::{
    deform::SolverQuality,
    film::{FaceId, HalfEdgeId, VertexId},
    remesh::sample,
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    snapshot::header,
    stain::{Environment, Exposure},
    touch::{Change, Effect, Site, Touch},
};

fn film(triangles: u32, seed: u64) -> FilmState {
    let piece = sample::plate(triangles, 5).expect("a plate");
    FilmState::new(&piece.film, &CoatingSettings::default(), seed, 100).expect("a manifold")
}

fn touched(face: u32, effect: Effect) -> Event {
    Event::Touch(Touch::new(Site::new(FaceId(face), Vec3::new(0.2, 0.3, 0.5)), 0.2, effect), face / 4)
}

/// A past with events of all kinds.
fn eventful(triangles: u32) -> History {
    let settings = CoatingSettings::from(Preset::Gentle);
    let mut history = History::new(film(triangles, 5), settings, Environment::default()).expect("a history");
    let rain = Environment { rain: Vec3::NEG_Y, ..Environment::default() };
    let events = [
        (0, Event::Adhesion(VertexId(3), f32::INFINITY)),
        (10, Event::Environment(rain)),
        (20, Event::Settings(Box::new(CoatingSettings::from(Preset::Heavy)))),
        (20, Event::StripFace(FaceId(17))),
        (35, Event::Exposure(Exposure { rain: vec![0.5; 40], sun: Vec::new() })),
        (40, Event::Environment(Environment::still(Vec3::new(0.6, -0.8, 0.0)))),
        (50, Event::Quality(SolverQuality::Fast)),
        (60, Event::Contraction(FaceId(7), 2.5)),
        (61, Event::Binding(HalfEdgeId(50), 0.1)),
        (61, Event::Adhesion(VertexId(8), -0.0)),
        (62, Event::Exposure(Exposure { rain: Vec::new(), sun: vec![0.25; 50] })),
        (63, touched(11, Effect::Adhesion(Change::Set(f32::INFINITY)))),
        (63, touched(12, Effect::Binding(Change::Multiply(0.25)))),
        (64, touched(13, Effect::Contraction(Change::Add(0.5)))),
        (64, touched(14, Effect::Rust(0.5))),
        (65, touched(15, Effect::Moisture(Change::Set(0.7)))),
        (66, touched(16, Effect::Strip)),
        (66, touched(17, Effect::Hit(6.0))),
        (67, touched(18, Effect::Wash(0.5))),
        (67, touched(19, Effect::Sand(0.25))),
        (68, touched(20, Effect::Scratch(Site::new(FaceId(45), Vec3::Z)))),
        (69, touched(16, Effect::Repaint)),
    ];
    for (step, event) in events {
        history.seek(step).expect("a step");
        assert!(history.record(event.clone()), "{event:?} changes something");
    }
    let tears = (0..90).map(HalfEdgeId).filter(|&h| history.record(Event::TearEdge(h))).count();
    assert!(tears > 3, "{tears} edges torn");
    history.seek(90).expect("a step");
    history
}

#[test]
fn a_recording_gives_every_step_again() {
    let mut history = eventful(300);
    let recording = history.recording().expect("a recording");
    let fresh = film(300, 77);
    let mut replayed = recording.replay(&fresh.mesh).expect("the same mesh");
    assert_eq!((replayed.log(), replayed.film().clock.steps), (history.log(), 0));
    assert_eq!(replayed.recording().expect("a recording"), recording, "the same bytes for the same past");
    for step in [0, 20, 36, 61, 90, 120, 30] {
        history.seek(step).expect("a step");
        replayed.seek(step).expect("a step");
        assert_eq!(replayed.film().digest(), history.film().digest(), "step {step}");
        assert_eq!(replayed.settings(), history.settings());
    }
    eprintln!("{} events, {} bytes", history.log().len(), recording.as_bytes().len());
}

#[test]
fn a_recording_begins_where_its_history_does() {
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    let mut film = film(200, 5);
    film.age_to(0.5, &settings, &environment);
    let mut history = History::new(film, settings, environment).expect("a history");
    assert!(history.record(Event::StripFace(FaceId(3))));
    let recording = history.recording().expect("a recording");
    history.seek(70).expect("a step");
    let mut replayed = recording.replay(&history.film().mesh).expect("the same mesh");
    assert_eq!(replayed.film().clock.steps, 50);
    replayed.seek(70).expect("a step");
    assert_eq!(replayed.film().digest(), history.film().digest());
}

/// Three bytes changed in a recording once made 64 million of them, which took seconds to read.
#[test]
fn exposures_of_vertices_that_are_not_there_are_not_recorded() {
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    let mut history = History::new(film(200, 5), settings, environment).expect("a history");
    let count = history.film().mesh.topology.original_vertex_count();
    let exposure = Exposure { rain: vec![0.5; count + 9], sun: vec![0.25; count - 9] };
    assert!(history.record(Event::Exposure(exposure)));
    history.seek(20).expect("a step");
    let recording = history.recording().expect("a recording");
    let mut replayed = recording.replay(&history.film().mesh).expect("the same mesh");
    let Event::Exposure(Exposure { rain, sun }) = &replayed.log()[0].event else { panic!("{:?}", replayed.log()) };
    assert_eq!([rain.len(), sun.len()], [count, count - 9]);
    replayed.seek(20).expect("a step");
    assert_eq!(replayed.film().digest(), history.film().digest());
}

/// Events at one step that say the same of the same thing leave one entry, and the same film.
#[test]
fn what_is_overwritten_before_a_step_is_forgotten() {
    let mut history = History::new(film(200, 5), CoatingSettings::default(), Environment::default()).expect("one");
    history.seek(10).expect("a step");
    let h = history.film().mesh.topology.all_edges().find(|&h| history.film().mesh.topology.bound_twin(h).is_some());
    let h = h.expect("an inner edge");
    let twin = history.film().mesh.topology.bound_twin(h).expect("a twin");
    for force in [0.5, 0.25, 0.125] {
        history.record(Event::Adhesion(VertexId(3), force));
        history.record(Event::Adhesion(VertexId(4), 2.0 * force));
        history.record(Event::Contraction(FaceId(3), force));
        history.record(Event::Binding(h, force));
        history.record(Event::Binding(twin, 3.0 * force));
        history.record(Event::Environment(Environment { gusts: force, ..Environment::default() }));
    }
    assert_eq!(history.log().len(), 5);
    // What a tear does depends on what was before it.
    assert!(history.record(Event::TearEdge(h)));
    history.record(Event::Adhesion(VertexId(3), 0.75));
    assert_eq!(history.log().len(), 7);
    history.seek(11).expect("a step");
    history.record(Event::Adhesion(VertexId(3), 0.25));
    assert_eq!(history.log().len(), 8, "another step");
    history.seek(30).expect("a step");
    let digest = history.film().digest();
    history.seek(0).expect("the past");
    history.seek(30).expect("a step");
    assert_eq!(history.film().digest(), digest);
    // Back at a step in the past its events are still overwritten.
    history.seek(11).expect("the past");
    history.record(Event::Adhesion(VertexId(3), 0.5));
    assert_eq!(history.log().len(), 8);
    assert_eq!(history.log().last().map(|entry| &entry.event), Some(&Event::Adhesion(VertexId(3), 0.5)));
}

#[test]
fn damage_is_named() {
    let recording = eventful(100).recording().expect("a recording");
    let bytes = recording.as_bytes();
    for length in 0..bytes.len() {
        match Recording::from_bytes(&bytes[..length]) {
            Err(RecordingError::NotARecording) if length == 0 => {}
            Err(RecordingError::Length { found, .. }) if found == length && length > 0 => {}
            other => panic!("{length} bytes: {other:?}"),
        }
    }
    for place in 0..bytes.len() {
        let mut flipped = bytes.to_vec();
        flipped[place] ^= 1 << (place % 8);
        let error = Recording::from_bytes(flipped).expect_err("damage");
        let fits = match place {
            0..6 => matches!(error, RecordingError::NotARecording),
            6..8 => matches!(error, RecordingError::Version { .. }),
            48..52 => matches!(error, RecordingError::Length { .. }),
            _ => matches!(error, RecordingError::Checksum),
        };
        assert!(fits, "{place}: {error}");
    }
    let error = recording.replay(&film(102, 5).mesh).expect_err("another film");
    assert!(matches!(error, RecordingError::OtherFilm { .. }) && error.to_string().contains("100"), "{error}");
    assert!(recording.is_of(&film(100, 9).mesh) && !recording.is_of(&film(102, 5).mesh));

    let mut settings = CoatingSettings::default();
    settings.tearing.beta = 2.0;
    let history = History::new(film(100, 5), settings, Environment::default()).expect("a history");
    assert!(matches!(history.recording(), Err(RecordingError::Unrecordable { .. })), "settings out of range");
}

/// A player who paints without a rest, 60 touches a second while a film takes 20 steps, sends less than 1 kB a second.
#[test]
fn strokes_take_few_bytes() {
    let mut history = History::new(film(3_000, 5), CoatingSettings::default(), Environment::default()).expect("one");
    let faces = history.film().mesh.topology.face_count() as f32;
    let bytes = |history: &History| history.recording().expect("a recording").as_bytes().len();
    let before = bytes(&history);
    for i in 0..600u32 {
        let turn = i as f32 * 0.013;
        let face = (faces * (0.5 + 0.4 * ops::sin(turn * 7.0) * ops::cos(turn))) as u32;
        let at = Vec3::new(turn.fract(), (turn * 31.0).fract(), (turn * 17.0).fract());
        let touch = Touch::new(Site::new(FaceId(face), at), 0.1, Effect::Adhesion(Change::Multiply(0.9)));
        assert!(history.record(Event::Touch(touch, i / 100)));
        if i % 3 == 2 {
            history.step().expect("a step");
        }
    }
    let rate = (bytes(&history) - before) / 10;
    println!("{rate} bytes a second");
    assert!(rate < 1_000, "{rate}");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Whoever writes a checksum over anything can make recordings that no history made.
    #[test]
    fn foreign_recordings_are_refused_or_are_pasts(
        places in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        random in prop::option::of(prop::collection::vec(any::<u8>(), 0..300)),
    ) {
        let history = eventful(60);
        let recording = history.recording().expect("a recording");
        let (name, content) = header::unwrap(RECORDING, recording.as_bytes()).expect("a recording");
        let mut changed = content.to_vec();
        for (place, byte) in places {
            let place = place.index(changed.len());
            changed[place] = byte;
        }
        let changed = random.unwrap_or(changed);
        let foreign = header::wrap(RECORDING, &name, &changed).expect("small");
        let foreign = Recording::from_bytes(foreign).expect("a header");
        match foreign.replay(&history.film().mesh) {
            Ok(mut history) => {
                let begin = history.film().clock.steps;
                prop_assert!(history.seek(begin + 8).is_ok());
            }
            Err(RecordingError::Inconsistent { .. }) => {}
            Err(other) => prop_assert!(false, "{other}"),
        }
    }
}

#[test]
fn recordings_are_files_and_serde_data() {
    let folder = tempfile::tempdir().expect("a folder");
    let recording = eventful(100).recording().expect("a recording");
    let path = folder.path().join("film.recording");
    recording.write(&path).expect("a file");
    assert_eq!(Recording::read(&path).expect("a recording"), recording);
    assert!(matches!(Recording::read(folder.path()), Err(RecordingError::Read { .. })));
    assert!(matches!(recording.write(folder.path().join("missing/file")), Err(RecordingError::Write { .. })));
    let json = serde_json::to_string(&recording).expect("JSON");
    assert_eq!(serde_json::from_str::<Recording>(&json).expect("a recording"), recording);
    let ron = ron::to_string(&recording).expect("RON");
    assert_eq!(ron::from_str::<Recording>(&ron).expect("a recording"), recording);
    let error = serde_json::from_str::<Recording>("[1, 2, 3]").expect_err("no recording");
    assert!(error.to_string().contains("no recording of a film"), "{error}");
}

/// Returns the bytes a second that a brush adds to a recording: 60 samples a second, of the 20 vertices next to it,
/// which each set to `force` of what they had and of the distance to the brush. The film takes a step after so many
/// samples.
fn brush(samples_a_step: usize, force: impl Fn(f32, f32) -> f32) -> f64 {
    const SECONDS: usize = 20;
    let mut history =
        History::new(film(3000, 5), CoatingSettings::default(), Environment::default()).expect("a history");
    let before = history.recording().expect("a recording").as_bytes().len();
    for sample in 0..60 * SECONDS {
        let t = sample as f32 / 60.0;
        let (sin, cos) = bevy_math::ops::sin_cos(t * 1.3);
        let at = Vec3::new(0.4 * cos, 0.3 * sin * bevy_math::ops::cos(t * 0.31), 0.0);
        let places =
            &history.film().mesh.geometry.rest_positions[..history.film().mesh.topology.original_vertex_count()];
        let mut near: Vec<(f32, u32)> = places.iter().zip(0..).map(|(p, v)| (p.distance(at), v)).collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.truncate(20);
        near.sort_by_key(|&(_, v)| v);
        for (distance, v) in near {
            let had = history.film().forces.adhesion(VertexId(v));
            history.record(Event::Adhesion(VertexId(v), force(had, distance)));
        }
        if (sample + 1) % samples_a_step == 0 {
            history.step().expect("a step");
        }
    }
    let after = history.recording().expect("a recording").as_bytes().len();
    (after - before) as f64 / SECONDS as f64
}

#[test]
fn a_brush_adds_little() {
    let wear = |had: f32, distance: f32| had * (1.0 - 0.05 * (1.0 - distance / 0.06).max(0.0));
    let [set, worn] = [brush(3, |_, _| 0.0), brush(3, wear)];
    eprintln!("bytes a second, 20 steps a second: {set:.0} where vertices are set, {worn:.0} where they are worn");
    assert!(set <= 500.0 && worn <= 1200.0, "{set} {worn}");
    let [set, worn] = [brush(1, |_, _| 0.0), brush(1, wear)];
    eprintln!("bytes a second, 60 steps a second: {set:.0} where vertices are set, {worn:.0} where they are worn");
    assert!(set <= 1000.0, "{set}");
}
