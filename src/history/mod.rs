//! Any moment of a film again: [`History`] keeps what acted on it from outside, and snapshots on the way.
//!
//! A film follows from its mesh, its seed, and what acted on it: the settings and the environment of each step, and
//! edits between steps. A history logs these as [`Event`]s with the number of the step before them. With keyframes here
//! and there it goes to any step, forward and back: it restores the keyframe before that step, and takes the steps from
//! there again, with the same bits.

mod conditions;
mod event;
mod film_history;
mod keyframes;
mod past;

#[cfg(test)]
mod tests;

pub use event::{Event, LogEntry};
pub use film_history::{DEFAULT_KEYFRAME_BYTES, History};
#[cfg(feature = "plugin")]
pub(crate) use {conditions::Conditions, keyframes::Keyframe, past::Past};
