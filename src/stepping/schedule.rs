//! Builds the step schedule, one run of which is one step of every film that is due.

use bevy::{
    app::App,
    ecs::schedule::{IntoScheduleConfigs, Schedule, SingleThreadedExecutor},
};

use super::{report, systems};
use crate::{
    api::system_sets::{CoatingStep, CoatingSystems},
    inspect, timeline,
};

/// Adds the schedule [`CoatingStep`] with its stages and systems.
pub(crate) fn add_step_schedule(app: &mut App) {
    let mut schedule = Schedule::new(CoatingStep);
    // The stages run one after the other, each in parallel inside, so threads for whole systems would gain nothing.
    schedule.set_executor(SingleThreadedExecutor::new());
    app.add_schedule(schedule);
    app.configure_sets(
        CoatingStep,
        (
            CoatingSystems::Forces,
            CoatingSystems::Separate,
            CoatingSystems::Tear,
            CoatingSystems::Strip,
            CoatingSystems::Bend,
            CoatingSystems::Rust,
            CoatingSystems::Dust,
            CoatingSystems::Moisture,
            CoatingSystems::Report,
        )
            .chain(),
    );
    app.add_systems(
        CoatingStep,
        (
            (timeline::note_conditions, systems::begin, systems::age_forces).chain().in_set(CoatingSystems::Forces),
            systems::separate.in_set(CoatingSystems::Separate),
            systems::tear.in_set(CoatingSystems::Tear),
            systems::strip.in_set(CoatingSystems::Strip),
            (systems::link, systems::bend).chain().in_set(CoatingSystems::Bend),
            systems::rust.in_set(CoatingSystems::Rust),
            systems::dust.in_set(CoatingSystems::Dust),
            systems::moisture.in_set(CoatingSystems::Moisture),
            (report::report, inspect::survey_due, timeline::keep_past).chain().in_set(CoatingSystems::Report),
        ),
    );
}
