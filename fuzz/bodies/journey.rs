//! A film with a history, and all that a game can do to it.

use bevy_coating::{
    deform::SolverQuality,
    film::{FaceId, HalfEdgeId, VertexId},
    history::{Event, History},
    remesh::sample,
    settings::CoatingSettings,
    sim::FilmState,
    snapshot::Snapshot,
    stain::{Environment, Exposure},
    touch::{Change, Effect, Site, Touch},
};

use super::input::Input;

/// Does to a film what `bytes` say. It must be in order at the end, and the same when all of it happens again.
pub fn journey(bytes: &[u8]) {
    let mut input = Input(bytes);
    let settings = CoatingSettings::default();
    let piece = sample::plate(60 + 2 * u32::from(input.byte() % 8), 7).expect("a plate");
    let film = FilmState::new(&piece.film, &settings, u64::from(input.byte()), 40).expect("a manifold");
    let mut history = History::new(film, settings, Environment::default()).expect("a history");
    history.set_keyframe_bytes(usize::from(input.word()));
    for _ in 0..100 {
        if input.is_empty() {
            break;
        }
        act(&mut history, &mut input);
    }
    history.film().validate().expect("a film in order");
    let (step, digest) = (history.film().clock.steps, history.film().digest());
    history.seek(0).expect("the past");
    history.seek(step).expect("a step");
    assert_eq!(history.film().digest(), digest, "all happens again as it did");
    let recording = history.recording().expect("a recording");
    let mut replayed = recording.replay(&history.film().mesh).expect("the same film");
    replayed.seek(step).expect("a step");
    assert_eq!(replayed.film().digest(), digest, "it is replayed as it was");
}

fn touch(input: &mut Input) -> Touch {
    let site = |input: &mut Input| Site {
        face: FaceId(u32::from(input.byte()) % 90),
        shares: [input.word() / 2, input.word() / 2],
    };
    let at = site(input);
    let number = input.float();
    let change = match input.byte() % 3 {
        0 => Change::Set(number),
        1 => Change::Add(number),
        _ => Change::Multiply(number),
    };
    let effect = match input.byte() % 12 {
        0 => Effect::Adhesion(change),
        1 => Effect::Binding(change),
        2 => Effect::Contraction(change),
        3 => Effect::Rust(number),
        4 => Effect::Dust(change),
        5 => Effect::Moisture(change),
        6 => Effect::Strip,
        7 => Effect::Repaint,
        8 => Effect::Hit(number),
        9 => Effect::Scratch(site(input)),
        10 => Effect::Wash(number),
        _ => Effect::Sand(number),
    };
    let radius = f32::from(input.byte()) / 200.0;
    Touch { site: at, radius, hardness: f32::from(input.byte()) / 255.0, effect }
}

fn act(history: &mut History, input: &mut Input) {
    let now = history.film().clock.steps;
    let event = match input.byte() % 16 {
        0 | 1 => return history.step().expect("a step"),
        2 => return history.seek(now + u64::from(input.byte() % 16)).expect("a step"),
        3 => return history.seek(now.saturating_sub(u64::from(input.byte()))).expect("the past"),
        4 => {
            let saved = Snapshot::of(history.film()).expect("a snapshot");
            let restored = saved.restore(&history.film().mesh).expect("the same film");
            return assert_eq!(restored.digest(), history.film().digest());
        }
        5 => Event::TearEdge(HalfEdgeId(input.word().into())),
        6 => Event::StripFace(FaceId(input.word().into())),
        7 => Event::Adhesion(VertexId(input.byte().into()), input.float()),
        8 => Event::Contraction(FaceId(input.byte().into()), input.float()),
        9 => Event::Binding(HalfEdgeId(input.byte().into()), input.float()),
        10 => Event::Quality(SolverQuality::ALL[usize::from(input.byte() % 4)]),
        11 => Event::Environment(Environment {
            gravity: input.vector(),
            wind: input.vector(),
            gusts: input.float(),
            rain: input.vector(),
            sun: input.vector(),
        }),
        12 => {
            let [rain, sun] = [(); 2].map(|()| (0..input.byte() % 64).map(|_| input.float()).collect());
            Event::Exposure(Exposure { rain, sun })
        }
        13 | 14 => Event::Touch(touch(input), input.byte().into()),
        _ => {
            let mut settings = history.settings().clone();
            let fields = CoatingSettings::fields().count();
            let field = CoatingSettings::fields().nth(usize::from(input.byte()) % fields).expect("a field");
            // Most values are out of range, or of names that do not exist, and stay as they were.
            let _ = field.set(&mut settings, input.float());
            Event::Settings(Box::new(settings))
        }
    };
    history.record(event);
}
