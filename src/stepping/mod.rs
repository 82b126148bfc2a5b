//! Turns time into steps: plans how many steps each film takes in a frame, and runs the stages of a step as systems.
//!
//! ```text
//! CoatingClock, CoatingBudget --runner, budget--> runs of CoatingStep --systems--> stages --report--> messages
//! ```

mod budget;
mod report;
mod runner;
mod schedule;
mod systems;
mod weather;

pub(crate) use budget::{StepCost, bounds};
pub(crate) use runner::advance;
pub(crate) use schedule::add_step_schedule;
pub(crate) use weather::check_weather;
