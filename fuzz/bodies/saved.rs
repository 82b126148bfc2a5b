//! Snapshots and recordings: any bytes, and real ones with changes under a checksum that is right.

use std::sync::OnceLock;

use bevy_coating::{
    film::{FaceId, VertexId},
    history::{Event, History, Recording},
    remesh::sample,
    settings::CoatingSettings,
    sim::FilmState,
    snapshot::Snapshot,
    stain::Environment,
};

use super::input::Input;

/// Bytes before what is saved, and after it: the header and the checksum of the format.
const HEADER: usize = 52;
const CHECKSUM: usize = 16;

/// A film with a short past.
fn history() -> &'static History {
    static HISTORY: OnceLock<History> = OnceLock::new();
    HISTORY.get_or_init(|| {
        let settings = CoatingSettings::default();
        let piece = sample::plate(60, 7).expect("a plate");
        let film = FilmState::new(&piece.film, &settings, 7, 40).expect("a manifold");
        let mut history = History::new(film, settings, Environment::default()).expect("a history");
        history.seek(10).expect("a step");
        history.record(Event::StripFace(FaceId(9)));
        history.record(Event::Adhesion(VertexId(5), 0.25));
        history.seek(30).expect("a step");
        history
    })
}

/// Returns what `input` makes of `whole`.
fn changed(whole: &[u8], input: &mut Input) -> Vec<u8> {
    match input.byte() % 3 {
        0 => input.0.to_vec(),
        1 => rewrapped(whole, input.0),
        _ => {
            let mut content = whole[HEADER..whole.len() - CHECKSUM].to_vec();
            while !input.is_empty() {
                let (place, byte) = (usize::from(input.word()) % content.len(), input.byte());
                content[place] = byte;
            }
            rewrapped(whole, &content)
        }
    }
}

/// Returns the header of `whole` with another content, and the checksum that belongs to it.
fn rewrapped(whole: &[u8], content: &[u8]) -> Vec<u8> {
    let mut bytes = whole[..HEADER - 4].to_vec();
    bytes.extend((content.len() as u32).to_le_bytes());
    bytes.extend(content);
    let mut sum = [0; CHECKSUM];
    let mut hasher = blake3::Hasher::new();
    hasher.update(&bytes);
    hasher.finalize_xof().fill(&mut sum);
    bytes.extend(sum);
    bytes
}

/// Reads a snapshot and restores it.
pub fn snapshot(bytes: &[u8]) {
    let film = history().film();
    let whole = Snapshot::of(film).expect("a snapshot").into_bytes();
    let Ok(snapshot) = Snapshot::from_bytes(changed(&whole, &mut Input(bytes))) else { return };
    let Ok(mut restored) = snapshot.restore(&film.mesh) else { return };
    if restored.clock == film.clock {
        restored.step(&CoatingSettings::default(), &Environment::default());
    }
}

/// Reads a recording and replays a little of it.
pub fn recording(bytes: &[u8]) {
    let whole = history().recording().expect("a recording").into_bytes();
    let Ok(recording) = Recording::from_bytes(changed(&whole, &mut Input(bytes))) else { return };
    let Ok(mut replayed) = recording.replay(&history().film().mesh) else { return };
    let begin = replayed.film().clock.steps;
    if begin < 1 << 32 {
        replayed.seek(begin + 12).expect("a past");
        assert!(replayed.recording().is_ok(), "what was read can be written");
    }
}
