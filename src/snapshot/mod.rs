//! Saves films and restores them, to the bit: [`Snapshot`].

mod digest;
mod error;
mod film_snapshot;
pub(crate) mod header;
mod serial;

#[cfg(test)]
mod tests;

pub(crate) use digest::MeshName;
pub use error::SnapshotError;
pub use film_snapshot::Snapshot;
