//! The Bevy plugin: films as components, stages as systems, the clock, and what is told to the game.

mod attach;
mod clock;
mod coating;
mod components;
pub mod diagnostics;
mod drive;
mod error;
mod messages;
mod reflect;
mod report;
mod schedule;
mod shelter;
mod step;
mod turns;
mod weather;

use bevy::{
    app::{App, Plugin, Update},
    ecs::{
        intern::Interned,
        schedule::{IntoScheduleConfigs, ScheduleLabel, SystemSet},
    },
};

pub use crate::render::{ATTRIBUTE_REST, ATTRIBUTE_REST_NORMAL, ATTRIBUTE_STAINS, CoatingDisplay, StainDisplay};
#[cfg(feature = "render")]
pub use crate::render::{CoatedMaterial, StainExtension, StainView, StainedMaterial};
pub use attach::CoatingAttach;
pub(crate) use attach::SlotAttributes;
#[cfg(feature = "render")]
pub(crate) use attach::loaded;
pub use clock::{CoatingBudget, CoatingClock, CoatingGravity, CoatingStatus, DEFAULT_AGE_PER_SECOND};
pub use coating::{Coating, DEFAULT_TRIANGLES, MetalLook, SettingsSource};
pub use components::{CoatedBy, CoatingPart, FilmPace, FilmRevision};
#[cfg(feature = "render")]
pub(crate) use components::{FilmSlot, FilmSource};
pub(crate) use diagnostics::CoatingTimings;
pub use error::{CoatingError, CoatingFault};
pub use messages::{FilmFailed, FilmReady, FirstCrack, PieceFallen};
pub use schedule::{CoatingStep, CoatingSystems};
pub use shelter::{RainShelter, Shelter};
pub use weather::CoatingWeather;

use crate::CoatingSettingsPlugin;

/// Ages the paint of every prop with a [`Coating`]. Needs Bevy's `AssetPlugin` and its (main world's) `MeshPlugin`,
/// which `DefaultPlugins` has, and takes time from [`Time`](bevy::time::Time).
///
/// ```
/// # use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// App::new().add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, CoatingWeatheringPlugin::default()));
/// ```
#[derive(Clone, Copy, Debug)]
pub struct CoatingWeatheringPlugin {
    schedule: Interned<dyn ScheduleLabel>,
}

impl CoatingWeatheringPlugin {
    /// The plugin, with the steps of a frame taken in `schedule`.
    pub fn new(schedule: impl ScheduleLabel) -> Self {
        Self { schedule: schedule.intern() }
    }
}

impl Default for CoatingWeatheringPlugin {
    /// Steps are taken in [`Update`]: they are counted out of elapsed time anyway, so a fixed timestep would add
    /// nothing, and one that has fallen behind would run the budget several times in one frame.
    fn default() -> Self {
        Self::new(Update)
    }
}

/// In the plugin's schedule: the steps of the frame are taken.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingAdvance;

impl Plugin for CoatingWeatheringPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins(CoatingSettingsPlugin)
            .init_resource::<CoatingClock>()
            .init_resource::<CoatingBudget>()
            .init_resource::<CoatingGravity>()
            .init_resource::<CoatingWeather>()
            .init_resource::<CoatingStatus>()
            .init_resource::<turns::StepCost>()
            .add_message::<FilmReady>()
            .add_message::<FilmFailed>()
            .add_message::<FirstCrack>()
            .add_message::<PieceFallen>();
        diagnostics::add_diagnostics(app);
        schedule::add_step_schedule(app);
        attach::add_attachment(app);
        app.add_systems(self.schedule, (weather::check_weather, drive::advance).chain().in_set(CoatingAdvance));
        app.add_plugins(crate::render::FilmDisplayPlugin);
    }
}
