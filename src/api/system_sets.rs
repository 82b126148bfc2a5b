//! Defines the schedule of a step and the plugin's system sets.

use bevy::ecs::schedule::{ScheduleLabel, SystemSet};

/// Schedule of one step, with the stages of [`CoatingSystems`]. It runs several times in a frame, or not at all, as the
/// clock and the budget demand.
///
/// In each run only the films that are [due](super::film_pace::FilmPace::is_due) take a step, so films of different
/// speeds share the schedule. Systems of a game can be added to it once the plugin has been added, which creates it.
#[derive(ScheduleLabel, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingStep;

/// Stages of a step, in the order in which they run in [`CoatingStep`]. Each works on all due films in parallel.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{FilmPace, film::FilmChanges, prelude::*};
///
/// /// Runs between tearing and stripping of the same step.
/// fn count_cracks(films: Query<(&FilmPace, &FilmChanges)>) {
///     let torn: usize = films.iter().filter(|(pace, _)| pace.is_due()).map(|(_, changes)| changes.torn.len()).sum();
///     debug!("{torn} edges tore");
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(CoatingStep, count_cracks.after(CoatingSystems::Tear).before(CoatingSystems::Strip));
/// app.update();
/// ```
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CoatingSystems {
    /// Stage that counts the step and ages the forces: adhesion falls, contraction grows, and edges of torn faces lose
    /// binding (VC 5.1, 5.2).
    Forces,
    /// Stage that separates vertices whose bending force exceeds their adhesion (VC 5.1).
    Separate,
    /// Stage that tears edges, from which cracks run on (VC 5.2).
    Tear,
    /// Stage that removes faces that are cut out all round, and small loose pieces (VC 5.3).
    Strip,
    /// Stage that updates the constraints after fracture, then bends the separated film (PBD-2, VC 4).
    Bend,
    /// Stage that lets rust come out of cracks, run off and stain, and bare metal rust (VC 6.1).
    Rust,
    /// Stage that lets dust and soot settle (VC 6.2).
    Dust,
    /// Stage that wets the film with rain, dries it by air and sun, and lets water wash it.
    Moisture,
    /// Stage that sends messages about the step and notes for display what changed.
    Report,
}

/// Set of the systems that take the steps of a frame. It is in the schedule that is given to
/// `CoatingWeatheringPlugin::new`.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingAdvance;

/// Set of the systems in `PostUpdate` that put finished films on their props, find meshes to coat and begin to build
/// films.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingAttach;

/// Set of the systems in `PostUpdate` that bring the meshes of changed films up to date, before Bevy computes bounds
/// and visibility and extracts the meshes for rendering.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingDisplay;
