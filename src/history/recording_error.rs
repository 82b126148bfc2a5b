//! Errors of recordings.

use std::{io, path::PathBuf};

use crate::snapshot::header::HeaderError;

/// Reason why the past of a film cannot be recorded or replayed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordingError {
    /// The bytes do not begin as a recording does.
    #[error("these bytes are no recording of a film's past: look whether the right file or message was read")]
    NotARecording,
    /// The recording was made by a release that records in another way.
    #[error(
        "this recording has version {found} of the format, and this release of bevy_coating reads version {known} \
         only: replay it with the release that made it, and save a snapshot there"
    )]
    Version {
        /// Version of the recording.
        found: u16,
        /// Version that this release reads and writes.
        known: u16,
    },
    /// The recording is not as long as it says: it was cut off, or something follows it.
    #[error(
        "this recording has {found} bytes instead of {expected}: it was cut off or joined with something, so take \
         another copy"
    )]
    Length {
        /// Number of bytes.
        found: usize,
        /// Number of bytes that it says it has; more than can be counted for most damage in that number.
        expected: u64,
    },
    /// Bytes of the recording have changed since it was made.
    #[error("this recording is damaged: its bytes do not agree with its checksum, so take another copy")]
    Checksum,
    /// The recording is one of a film on another mesh.
    #[error(
        "this recording is of a film of {} vertices and {} triangles, and this one has {} and {}, or others: replay it \
         on the mesh and the resolution that it was made with",
        recorded[0], recorded[1], found[0], found[1]
    )]
    OtherFilm {
        /// Number of vertices at rest and of triangles of the film that was recorded.
        recorded: [u32; 2],
        /// Number of vertices at rest and of triangles of the film that it is to be replayed on.
        found: [u32; 2],
    },
    /// The recording is whole, but no past can have been like that: another program has made it.
    #[error("this recording was not made by bevy_coating: {part} cannot be so; take one that a history has made")]
    Inconsistent {
        /// The part of the past that is wrong.
        part: &'static str,
    },
    /// The past cannot be recorded.
    #[error("the past of the film cannot be recorded: {part} cannot be so; keep to the ranges of the settings")]
    Unrecordable {
        /// The part of the past that is wrong.
        part: &'static str,
    },
    /// The log of events is too long to be recorded.
    #[error(
        "the past of the film cannot be recorded: its log takes more than {most} bytes; give the history less memory \
         for keyframes, so that it forgets more of its beginning"
    )]
    TooLong {
        /// Most memory that the log of a recording may take, in bytes.
        most: usize,
    },
    /// The file cannot be read.
    #[error("cannot read the recording {}: {source}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file cannot be written. What was there is still there.
    #[error("cannot write the recording {}: {source}", path.display())]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
}

impl RecordingError {
    /// Names what is wrong with a header; recordings have the version `known`.
    pub(super) fn of_header(error: HeaderError, known: u16) -> Self {
        match error {
            HeaderError::OtherKind => Self::NotARecording,
            HeaderError::Version(found) => Self::Version { found, known },
            HeaderError::Length { found, expected } => Self::Length { found, expected },
            HeaderError::Checksum => Self::Checksum,
        }
    }
}
