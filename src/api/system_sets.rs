//! The schedule of a step and the sets of the plugin's systems.

use bevy::ecs::schedule::{ScheduleLabel, SystemSet};

/// One step. Run as often as the clock and the budget ask for; in each run only the films that are due take a
/// step ([`FilmPace::is_due`](super::film_pace::FilmPace::is_due)), so films of different pace share it.
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

/// In the plugin's schedule: the steps of the frame are taken.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingAdvance;

/// In `PostUpdate`: finished films are put on their props, meshes to be coated are found, builds are begun.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingAttach;

/// In `PostUpdate`: the meshes of films that changed are brought up to date, in time for bounds, visibility and
/// extraction.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingDisplay;
