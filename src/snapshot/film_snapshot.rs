//! The snapshot of a film.

use std::{fmt, path::Path};

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::*;

use super::{
    digest::MeshName,
    error::SnapshotError,
    header::{self, HeaderError, Kind},
};
use crate::{
    coding::Damage,
    files::{
        self, folder_of,
        temporary::{self, Temporary},
    },
    film::FilmMesh,
    sim::{FilmState, FreshFilm},
};

/// Format of snapshots. Another version for every change of what is saved, in which order, or of what is expected of
/// it.
pub(super) const SNAPSHOT: Kind = Kind { magic: *b"bvcoat", version: 2 };

/// State of a film at one moment, as bytes: all that decides what becomes of it, to the bit.
///
/// A film that is restored goes on exactly as the one that was saved would have. Settings and environment are inputs of
/// its next step and no part of it. Counters and buffers for display are not saved, and
/// [`FilmState::changes`](crate::sim::FilmState::changes) are empty after restoring: display shows a restored film as
/// it would a new one.
///
/// Only what differs from the fresh film is saved, so that a snapshot needs the film's mesh to be restored. It names
/// that mesh by a digest and refuses any other. It has a version, and a checksum over all of it (BLAKE3). As
/// [`serde`] data it is one string of bytes.
///
/// ```
/// use bevy_coating::{
///     remesh::sample, settings::CoatingSettings, sim::FilmState, snapshot::Snapshot, stain::Environment,
/// };
///
/// let (settings, environment) = (CoatingSettings::default(), Environment::default());
/// let piece = sample::plate(200, 7)?;
/// let mut film = FilmState::new(&piece.film, &settings, 7, 100).ok_or("no film")?;
/// film.age_to(0.5, &settings, &environment);
/// let saved = Snapshot::of(&film)?;
///
/// // Later, elsewhere: the same prop is built again.
/// let fresh = FilmState::new(&piece.film, &settings, 1, 100).ok_or("no film")?;
/// let mut restored = Snapshot::from_bytes(saved.into_bytes())?.restore(&fresh.mesh)?;
/// film.age_to(1.0, &settings, &environment);
/// restored.age_to(1.0, &settings, &environment);
/// assert_eq!(restored.digest(), film.digest());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, PartialEq, Eq)]
#[cfg_attr(
    feature = "plugin",
    derive(Reflect),
    reflect(opaque, Clone, PartialEq, Debug, Serialize, Deserialize),
    type_path = "bevy_coating::snapshot"
)]
pub struct Snapshot(pub(super) Vec<u8>);

impl Snapshot {
    /// Saves `film`.
    ///
    /// # Errors
    /// [`SnapshotError::Unsaveable`] if public fields of the film were changed so that it is none any more.
    pub fn of(film: &FilmState) -> Result<Self, SnapshotError> {
        let fail = |part| SnapshotError::Unsaveable { part };
        let rest = film.mesh.at_rest().map_err(|_| fail("its mesh"))?;
        let state = FreshFilm::new(rest).write(&mut film.clone()).map_err(|Damage(part)| fail(part))?;
        header::wrap(SNAPSHOT, &MeshName::of(&film.mesh), &state).map(Self).map_err(|Damage(part)| fail(part))
    }

    /// Takes the bytes of a snapshot, as [`as_bytes`](Self::as_bytes) and [`into_bytes`](Self::into_bytes) give them.
    ///
    /// # Errors
    /// [`SnapshotError::NotASnapshot`], [`SnapshotError::Version`], [`SnapshotError::Length`] or
    /// [`SnapshotError::Checksum`].
    ///
    /// ```
    /// use bevy_coating::snapshot::{Snapshot, SnapshotError};
    ///
    /// assert!(matches!(Snapshot::from_bytes(b"something else".to_vec()), Err(SnapshotError::NotASnapshot)));
    /// ```
    pub fn from_bytes(bytes: impl Into<Vec<u8>>) -> Result<Self, SnapshotError> {
        let bytes = bytes.into();
        unwrap(&bytes)?;
        Ok(Self(bytes))
    }

    /// Returns the bytes: the same for the same state.
    pub fn as_bytes(&self) -> &[u8] {
        &self.0
    }

    /// Returns the bytes: the same for the same state.
    pub fn into_bytes(self) -> Vec<u8> {
        self.0
    }

    /// Returns whether this is a snapshot of a film on `mesh`, whatever has become of either.
    pub fn is_of(&self, mesh: &FilmMesh) -> bool {
        unwrap(&self.0).is_ok_and(|(name, _)| name == MeshName::of(mesh))
    }

    /// Makes the film that was saved. `mesh` is the film's mesh, fresh or not: one built from the same prop at the same
    /// resolution.
    ///
    /// # Errors
    /// [`SnapshotError::OtherFilm`] if it is the mesh of another film, [`SnapshotError::Inconsistent`] if another
    /// program has made the snapshot.
    pub fn restore(&self, mesh: &FilmMesh) -> Result<FilmState, SnapshotError> {
        let (saved, state) = unwrap(&self.0)?;
        let found = MeshName::of(mesh);
        if saved != found {
            return Err(SnapshotError::OtherFilm { saved: saved.counts, found: found.counts });
        }
        let fail = |part| SnapshotError::Inconsistent { part };
        let rest = mesh.at_rest().map_err(|_| fail("its mesh"))?;
        FreshFilm::new(rest).read(state, true).map_err(|Damage(part)| fail(part))
    }

    /// Writes a file, whole or not at all: it is written beside its place, and then takes the place of what is there.
    ///
    /// # Errors
    /// [`SnapshotError::Write`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), SnapshotError> {
        let path = path.as_ref();
        let fail = |source| SnapshotError::Write { path: path.into(), source };
        let mut file = Temporary::write(folder_of(path), ".coating-", &self.0).map_err(fail)?;
        file.persist(&mut temporary::list(), path).map_err(fail)
    }

    /// Reads a file.
    ///
    /// # Errors
    /// [`SnapshotError::Read`], and the errors of [`from_bytes`](Self::from_bytes).
    pub fn read(path: impl AsRef<Path>) -> Result<Self, SnapshotError> {
        let path = path.as_ref();
        let bytes = files::read(path).map_err(|source| SnapshotError::Read { path: path.into(), source })?;
        Self::from_bytes(bytes)
    }
}

fn unwrap(bytes: &[u8]) -> Result<(MeshName, &[u8]), SnapshotError> {
    header::unwrap(SNAPSHOT, bytes).map_err(|error| match error {
        HeaderError::OtherKind => SnapshotError::NotASnapshot,
        HeaderError::Version(found) => SnapshotError::Version { found, known: SNAPSHOT.version },
        HeaderError::Length { found, expected } => SnapshotError::Length { found, expected },
        HeaderError::Checksum => SnapshotError::Checksum,
    })
}

impl fmt::Debug for Snapshot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Snapshot({} bytes)", self.0.len())
    }
}

impl FilmState {
    /// Puts this film into the state of `snapshot`. Instruction set and buffers stay; on an error all stays as it was.
    ///
    /// # Errors
    /// Those of [`Snapshot::restore`].
    ///
    /// ```
    /// use bevy_coating::{
    ///     remesh::sample, settings::CoatingSettings, sim::FilmState, snapshot::Snapshot, stain::Environment,
    /// };
    ///
    /// let settings = CoatingSettings::default();
    /// let piece = sample::plate(200, 7)?;
    /// let mut film = FilmState::new(&piece.film, &settings, 7, 100).ok_or("no film")?;
    /// let fresh = Snapshot::of(&film)?;
    /// film.age_to(0.5, &settings, &Environment::default());
    /// film.restore(&fresh)?;
    /// assert_eq!(film.clock.age(), 0.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn restore(&mut self, snapshot: &Snapshot) -> Result<(), SnapshotError> {
        let restored = snapshot.restore(&self.mesh)?;
        let scratch = std::mem::take(&mut self.scratch);
        *self = Self { scratch, ..restored };
        Ok(())
    }
}
