//! Ages one film step by step, without an engine.
//!
//! [`FilmState`] holds everything that one film needs, [`stage`] the stages of a step and [`edit`] what may be done to
//! a film from outside. Baking, benches, background ageing and tests use them as they are; the plugin runs the same
//! stages on the same parts, as components.

mod clock;
mod coarse;
mod digest;
pub mod edit;
mod film_measures;
mod measure;
mod saved;
mod scratch;
mod seed;
pub mod stage;
mod state;
mod timing;
mod validate;

#[cfg(test)]
mod tests;

pub use clock::{DEFAULT_STEPS_PER_AGE, FilmClock};
pub use coarse::coarser_than_grain;
pub use digest::DIGEST_ALGORITHM;
pub use film_measures::FilmMeasures;
pub(crate) use saved::FreshFilm;
pub use scratch::StepScratch;
pub use seed::{PathStep, film_seed, place_seed};
pub use state::FilmState;
pub use timing::{Stage, StageTimes};
