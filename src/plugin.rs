//! The Bevy plugin: films as components, stages as systems, the clock, and what is told to the game.

use bevy::{
    app::{App, Plugin, Update},
    ecs::{
        intern::Interned,
        schedule::{IntoScheduleConfigs, ScheduleLabel},
    },
};

use crate::{
    api::{
        budget::CoatingBudget,
        clock::{CoatingClock, CoatingGravity},
        diagnostics,
        messages::{FilmFailed, FilmReady, FirstCrack, PieceFallen},
        status::CoatingStatus,
        system_sets::CoatingAdvance,
        weather::CoatingWeather,
    },
    attach::add_attachment,
    display::FilmDisplayPlugin,
    settings::asset::CoatingSettingsPlugin,
    stepping,
};

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

impl Plugin for CoatingWeatheringPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins(CoatingSettingsPlugin)
            .init_resource::<CoatingClock>()
            .init_resource::<CoatingBudget>()
            .init_resource::<CoatingGravity>()
            .init_resource::<CoatingWeather>()
            .init_resource::<CoatingStatus>()
            .init_resource::<stepping::StepCost>()
            .add_message::<FilmReady>()
            .add_message::<FilmFailed>()
            .add_message::<FirstCrack>()
            .add_message::<PieceFallen>();
        diagnostics::add_diagnostics(app);
        stepping::add_step_schedule(app);
        add_attachment(app);
        app.add_systems(self.schedule, (stepping::check_weather, stepping::advance).chain().in_set(CoatingAdvance));
        app.add_plugins(FilmDisplayPlugin);
    }
}
