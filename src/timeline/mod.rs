//! Takes films to any age: back and forward in time, with their past, in the background.
//!
//! ```text
//! FilmClock::seek, target age in the past, saved state --travel--> FilmJourney --task--> arrival: components swapped
//!                                                                       ^
//! CoatingStep --record--> FilmHistory (log, keyframes) -----------------+
//! ```

mod commands;
mod film_history;
mod journey;
mod path;
mod record;
mod save;
mod travel;
mod whole_film;

pub use commands::CoatingCommands;
pub(crate) use commands::{AgeWish, hand_out_ages};
pub use film_history::FilmHistory;
pub(crate) use journey::{FilmJourney, FilmWish, Goal};
pub(crate) use path::{path_to, written_path};
pub(crate) use record::{keep_past, note_conditions};
pub(crate) use travel::{follow_histories, travel};
