//! Any moment of a film again: [`History`] keeps what acted on it from outside, and snapshots on the way.
//!
//! A film follows from its mesh, its seed, and what acted on it: the settings and the environment of each step, and
//! edits between steps. A history logs these as [`Event`]s with the number of the step before them. With keyframes here
//! and there it goes to any step, forward and back: it restores the keyframe before that step, and takes the steps from
//! there again, with the same bits.
//!
//! A [`Recording`] is the same past as bytes: the beginning and the log. It is replayed on another machine, in the time
//! that all steps take.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

mod conditions;
mod event;
mod film_history;
mod keyframes;
mod log_coding;
mod past;
mod recent;
mod recording;
mod recording_error;
mod touch_coding;
mod touched;

#[cfg(test)]
mod recording_tests;
#[cfg(test)]
mod tests;

pub use event::{Event, LogEntry};
pub use film_history::{DEFAULT_KEYFRAME_BYTES, History};
pub use recording::Recording;
pub use recording_error::RecordingError;
#[cfg(feature = "plugin")]
pub(crate) use {conditions::Conditions, keyframes::Keyframe, past::Past};
