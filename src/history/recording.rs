//! The past of a film as bytes.

use std::{fmt, path::Path};

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

use super::{
    conditions::Conditions,
    film_history::{DEFAULT_KEYFRAME_BYTES, History},
    log_coding::{MOST_BYTES, code_conditions, code_log},
    past::Past,
    recording_error::RecordingError,
};
use crate::{
    coding::{Damage, Reader, Writer, deserialize_bytes},
    files::{
        self, folder_of,
        temporary::{self, Temporary},
    },
    film::FilmMesh,
    settings::CoatingSettings,
    snapshot::{
        MeshName,
        header::{self, Kind},
    },
    stain::Environment,
};

/// Format of recordings. Another version for every change of what is recorded, in which order, or of what is expected
/// of it, and for every change of snapshots.
pub(super) const RECORDING: Kind = Kind { magic: *b"bvcrec", version: 2 };

/// Past of a film as bytes: how it began, and all events since. Replayed on the same mesh, on any machine, it gives the
/// same film at every step, to the bit.
///
/// It holds no keyframes and so is far smaller than a snapshot as long as little was done to the film; to replay it
/// takes the time of all its steps. It needs the film's mesh, which it names by a digest, and has a version and a
/// checksum (BLAKE3). As [`serde`] data it is one string of bytes.
///
/// ```
/// use bevy_coating::{
///     film::VertexId,
///     history::{Event, History, Recording},
///     remesh::sample,
///     settings::CoatingSettings,
///     sim::FilmState,
///     stain::Environment,
/// };
///
/// let settings = CoatingSettings::default();
/// let piece = sample::plate(200, 7)?;
/// let film = FilmState::new(&piece.film, &settings, 7, 100).ok_or("no film")?;
/// let mut history = History::new(film, settings.clone(), Environment::default())?;
/// history.seek(40)?;
/// history.record(Event::Adhesion(VertexId(11), 0.0));
/// history.seek(60)?;
/// let recording = history.recording()?;
///
/// // On another machine: the same prop is built again.
/// let fresh = FilmState::new(&piece.film, &settings, 1, 100).ok_or("no film")?;
/// let recording = Recording::from_bytes(recording.into_bytes())?;
/// let mut replayed = recording.replay(&fresh.mesh)?;
/// replayed.seek(60)?;
/// assert_eq!(replayed.film().digest(), history.film().digest());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Eq)]
pub struct Recording(Vec<u8>);

impl Recording {
    /// Takes the bytes of a recording, as [`as_bytes`](Self::as_bytes) and [`into_bytes`](Self::into_bytes) give them.
    ///
    /// # Errors
    /// [`RecordingError::NotARecording`], [`RecordingError::Version`], [`RecordingError::Length`] or
    /// [`RecordingError::Checksum`].
    pub fn from_bytes(bytes: impl Into<Vec<u8>>) -> Result<Self, RecordingError> {
        let bytes = bytes.into();
        unwrap(&bytes)?;
        Ok(Self(bytes))
    }

    /// Returns the bytes: the same for the same past.
    pub fn as_bytes(&self) -> &[u8] {
        &self.0
    }

    /// Returns the bytes: the same for the same past.
    pub fn into_bytes(self) -> Vec<u8> {
        self.0
    }

    /// Returns whether this is the past of a film on `mesh`, whatever has become of either.
    pub fn is_of(&self, mesh: &FilmMesh) -> bool {
        unwrap(&self.0).is_ok_and(|(name, _)| name == MeshName::of(mesh))
    }

    /// Makes the history that was recorded, at the step at which it begins; [`History::seek`] goes on from there.
    /// `mesh` is the film's mesh, fresh or not: one built from the same prop at the same resolution.
    ///
    /// # Errors
    /// [`RecordingError::OtherFilm`] if it is the mesh of another film, [`RecordingError::Inconsistent`] if another
    /// program has made the recording.
    pub fn replay(&self, mesh: &FilmMesh) -> Result<History, RecordingError> {
        let (recorded, content) = unwrap(&self.0)?;
        let found = MeshName::of(mesh);
        if recorded != found {
            return Err(RecordingError::OtherFilm { recorded: recorded.counts, found: found.counts });
        }
        begin(content, mesh).map_err(|Damage(part)| RecordingError::Inconsistent { part })
    }

    /// Writes a file, whole or not at all: it is written beside its place, and then takes the place of what is there.
    ///
    /// # Errors
    /// [`RecordingError::Write`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), RecordingError> {
        let path = path.as_ref();
        let fail = |source| RecordingError::Write { path: path.into(), source };
        let mut file = Temporary::write(folder_of(path), ".coating-", &self.0).map_err(fail)?;
        file.persist(&mut temporary::list(), path).map_err(fail)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`RecordingError::Read`], and the errors of [`from_bytes`](Self::from_bytes).
    pub fn read(path: impl AsRef<Path>) -> Result<Self, RecordingError> {
        let path = path.as_ref();
        let bytes = files::read(path).map_err(|source| RecordingError::Read { path: path.into(), source })?;
        Self::from_bytes(bytes)
    }
}

const CUT: Damage = Damage("the length of its data");

/// Makes the history whose header was taken off.
fn begin(content: &[u8], mesh: &FilmMesh) -> Result<History, Damage> {
    let (length, rest) = content.split_first_chunk().ok_or(CUT)?;
    let (first, log) = rest.split_at_checked(u32::from_le_bytes(*length) as usize).ok_or(CUT)?;
    let mut reader = Reader::new(log, true)?;
    let mut conditions = Conditions { settings: CoatingSettings::default(), environment: Environment::default() };
    code_conditions(&mut conditions, &mut reader)?;
    let (mut past, mut film) = Past::again(mesh, first, &conditions, DEFAULT_KEYFRAME_BYTES)?;
    let mut log = Vec::new();
    let vertices = mesh.topology.original_vertex_count();
    code_log(&mut log, film.clock.steps, &conditions, vertices, &mut reader)?;
    reader.finish()?;
    past.set_log(log);
    let mut now = conditions;
    for event in past.events_at(film.clock.steps) {
        now.apply(&mut film, event);
    }
    Ok(History { film, now, past })
}

fn unwrap(bytes: &[u8]) -> Result<(MeshName, &[u8]), RecordingError> {
    header::unwrap(RECORDING, bytes).map_err(|error| RecordingError::of_header(error, RECORDING.version))
}

impl fmt::Debug for Recording {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Recording({} bytes)", self.0.len())
    }
}

impl Serialize for Recording {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_bytes(self.as_bytes())
    }
}

impl<'de> Deserialize<'de> for Recording {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let bytes = deserialize_bytes(deserializer, "the bytes of a recording")?;
        Self::from_bytes(bytes).map_err(D::Error::custom)
    }
}

impl Past {
    /// Records this past: its beginning and its log.
    ///
    /// # Errors
    /// [`RecordingError::Unrecordable`] if settings are out of range, [`RecordingError::TooLong`] if the log is.
    pub(crate) fn recording(&self) -> Result<Recording, RecordingError> {
        let fail = |Damage(part)| RecordingError::Unrecordable { part };
        if self.log_bytes() > MOST_BYTES {
            return Err(RecordingError::TooLong { most: MOST_BYTES });
        }
        let (mut conditions, mut log) = (self.first_conditions().clone(), self.log().to_vec());
        let first = self.keyframes().first().ok_or(RecordingError::Unrecordable { part: "its beginning" })?;
        let (mut writer, name) = (Writer::new(), self.mesh_name());
        code_conditions(&mut conditions, &mut writer).map_err(fail)?;
        code_log(&mut log, first.step, &conditions, name.counts[0] as usize, &mut writer).map_err(fail)?;
        let length = u32::try_from(first.state.len()).map_err(|_| fail(CUT))?;
        let content = [&length.to_le_bytes()[..], &first.state, &writer.finish()].concat();
        header::wrap(RECORDING, &name, &content).map(Recording).map_err(fail)
    }
}

impl History {
    /// Records the past: how it began, and all events since. Keyframes are no part of it.
    ///
    /// # Errors
    /// [`RecordingError::Unrecordable`] if settings were out of their ranges, [`RecordingError::TooLong`] if the log
    /// takes more than 256 MiB.
    pub fn recording(&self) -> Result<Recording, RecordingError> {
        self.past.recording()
    }
}
