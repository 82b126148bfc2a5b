//! The step schedule: one run is one step of every film that is due.

use bevy::{
    app::App,
    ecs::schedule::{IntoScheduleConfigs, Schedule, ScheduleLabel, SingleThreadedExecutor, SystemSet},
};

use super::{report, step};

/// One step. Run as often as the clock and the budget ask for; in each run only the films that are due take a
/// step ([`FilmPace::is_due`](super::FilmPace::is_due)), so films of different pace share it.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingStep;

/// The stages of a step, in their order. Each runs over all due films, in parallel.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CoatingSystems {
    /// The step is counted; adhesion falls, contraction grows, torn faces' edges lose binding (VC 5.1, 5.2).
    Forces,
    /// Vertices separate where the bending force exceeds their adhesion (VC 5.1).
    Separate,
    /// Edges tear, and cracks run (VC 5.2).
    Tear,
    /// Faces cut out all round and small loose pieces fall (VC 5.3).
    Strip,
    /// Constraints follow fracture, then the separated film bends (PBD-2, VC 4).
    Bend,
    /// Rust comes out of cracks, runs off and stains; bare metal rusts (VC 6.1).
    Rust,
    /// Dust and soot settle (VC 6.2).
    Dust,
    /// Rain wets, air and sun dry, and water washes.
    Moisture,
    /// What happened becomes messages and is noted for display.
    Report,
}

pub(super) fn add_step_schedule(app: &mut App) {
    let mut schedule = Schedule::new(CoatingStep);
    // The stages follow each other and are parallel inside: a second thread would only be waited for.
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
            (step::begin, step::age_forces).chain().in_set(CoatingSystems::Forces),
            step::separate.in_set(CoatingSystems::Separate),
            step::tear.in_set(CoatingSystems::Tear),
            step::strip.in_set(CoatingSystems::Strip),
            (step::link, step::bend).chain().in_set(CoatingSystems::Bend),
            step::rust.in_set(CoatingSystems::Rust),
            step::dust.in_set(CoatingSystems::Dust),
            step::moisture.in_set(CoatingSystems::Moisture),
            report::report.in_set(CoatingSystems::Report),
        ),
    );
}
