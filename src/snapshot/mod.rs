//! Saves films and restores them, to the bit: [`Snapshot`].

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

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
