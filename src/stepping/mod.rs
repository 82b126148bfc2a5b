//! Turns time into steps: plans how many steps each film takes in a frame, and runs the stages of a step as systems.
//!
//! ```text
//! CoatingClock, CoatingBudget --runner, budget--> runs of CoatingStep --systems--> stages --report--> messages
//! ```

mod budget;
mod checks;
mod edit;
mod follow;
mod frame_time;
mod reached;
mod report;
mod runner;
mod schedule;
mod systems;
mod touch;

pub(crate) use budget::{StepCost, bounds};
pub(crate) use checks::{check_clock, check_weather, check_weather_of_props};
pub use edit::FilmEdit;
pub(crate) use follow::follow_coatings;
pub(crate) use reached::ReachedPace;
pub(crate) use runner::advance;
pub(crate) use schedule::add_step_schedule;
pub use touch::{TouchAt, TouchCommands};
