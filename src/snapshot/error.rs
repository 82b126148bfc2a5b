//! Errors of snapshots.

use std::{io, path::PathBuf};

/// Reason why a film cannot be saved or restored. Whatever it is, the film at hand stays as it was.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SnapshotError {
    /// The bytes do not begin as a snapshot does.
    #[error("these bytes are no snapshot of a film: look whether the right file or message was read")]
    NotASnapshot,
    /// The snapshot was made by a release that saves films in another way.
    #[error(
        "this snapshot has version {found} of the format, and this release of bevy_coating reads version {known} only: \
         use the release that saved it, or age the film again"
    )]
    Version {
        /// Version of the snapshot.
        found: u16,
        /// Version that this release reads and writes.
        known: u16,
    },
    /// The snapshot is not as long as it says: it was cut off, or something follows it.
    #[error(
        "this snapshot has {found} bytes instead of {expected}: it was cut off or joined with something, so take an \
         older one, or age the film again"
    )]
    Length {
        /// Number of bytes.
        found: usize,
        /// Number of bytes that it says it has; more than can be counted for most damage in that number.
        expected: u64,
    },
    /// Bytes of the snapshot have changed since it was made.
    #[error(
        "this snapshot is damaged: its bytes do not agree with its checksum, so take an older one, or age the film \
         again"
    )]
    Checksum,
    /// The snapshot is one of a film on another mesh.
    #[error(
        "this snapshot is of a film of {} vertices and {} triangles, and this one has {} and {}, or others: restore it \
         on the mesh and the resolution that it was saved with",
        saved[0], saved[1], found[0], found[1]
    )]
    OtherFilm {
        /// Number of vertices at rest and of triangles of the film that was saved.
        saved: [u32; 2],
        /// Number of vertices at rest and of triangles of the film that it is to be restored on.
        found: [u32; 2],
    },
    /// The snapshot is whole, but no film can have been like that: another program has made it.
    #[error("this snapshot was not made by bevy_coating: {part} cannot be so; take one that a film was saved in")]
    Inconsistent {
        /// The part of the film that is wrong.
        part: &'static str,
    },
    /// The film cannot be saved, as fields of it were changed by hand.
    #[error("the film cannot be saved: {part} cannot be so; change films by their methods only")]
    Unsaveable {
        /// The part of the film that is wrong.
        part: &'static str,
    },
    /// Nothing was saved of the film.
    #[error("nothing was saved of a film at `{path}` below its coating: name entities as they were when it was saved")]
    NoFilm {
        /// Names of the entities that lead to the film.
        path: String,
    },
    /// The file cannot be read.
    #[error("cannot read the snapshot {}: {source}", path.display())]
    Read {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
    /// The file cannot be written. Nothing is left of it.
    #[error("cannot write the snapshot {}: {source}", path.display())]
    Write {
        /// Path of the file.
        path: PathBuf,
        /// Error of the operating system.
        source: io::Error,
    },
}
