//! Everything one film needs to step, and the step: the stages in order, without ECS. The same code serves
//! baking, benches, background ageing and tests; the plugin runs the same functions on the same parts.

mod clock;
mod digest;
mod measure;
mod state;
mod timing;

#[cfg(test)]
mod tests;

pub use clock::{DEFAULT_STEPS_PER_AGE, FilmClock};
pub use digest::DIGEST_ALGORITHM;
pub use measure::FilmMeasures;
pub use state::{FilmState, StepScratch, stage};
pub use timing::{Stage, StageTimes};
