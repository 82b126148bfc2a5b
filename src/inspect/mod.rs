//! Inspects films: keeps their summaries up to date, and answers what lies where in the world.

mod query;
mod summary;

pub use query::{FilmHit, FilmQuery};
pub(crate) use summary::{survey_changed, survey_due};
