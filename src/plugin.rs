//! Defines the Bevy plugin, which adds all resources, messages, schedules and systems.

use bevy::{
    app::{App, Plugin, PostUpdate, Update},
    ecs::{
        event::Event,
        intern::Interned,
        message::{Message, MessageReader},
        schedule::{IntoScheduleConfigs, ScheduleLabel},
        system::Commands,
    },
};

use crate::{
    api::{
        budget::CoatingBudget,
        calendar::CoatingCalendar,
        clock::{CoatingClock, CoatingGravity},
        diagnostics,
        messages::{
            AgeReached, FilmFailed, FilmReady, FilmRepainted, FirstCrack, FirstSeparation, PieceFallen, RatingReached,
            RestoreFailed,
        },
        status::CoatingStatus,
        system_sets::{CoatingAdvance, CoatingDisplay},
        turn::add_frames,
        unit::CoatingUnit,
        weather::CoatingWeather,
    },
    attach::add_attachment,
    debris::add_debris,
    display::FilmDisplayPlugin,
    settings::asset::CoatingSettingsPlugin,
    stepping, timeline,
};

/// Plugin that ages the paint of every entity with a [`Coating`](crate::api::coating::Coating).
///
/// It needs Bevy's `AssetPlugin`, `MeshPlugin` and `TransformPlugin`, which are part of `DefaultPlugins`, and measures
/// time by [`Time`](bevy::time::Time). To draw stains it must be added after `DefaultPlugins` (or `PbrPlugin`).
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// App::new()
///     // In a game: DefaultPlugins.
///     .add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin))
///     .add_plugins(CoatingWeatheringPlugin::default())
///     .update();
/// ```
#[derive(Clone, Copy, Debug)]
pub struct CoatingWeatheringPlugin {
    schedule: Interned<dyn ScheduleLabel>,
}

impl CoatingWeatheringPlugin {
    /// Returns the plugin with the steps of a frame taken in `schedule`. The [default](Self::default) is [`Update`].
    ///
    /// ```
    /// use bevy::prelude::*;
    /// use bevy_coating::prelude::*;
    ///
    /// let mut app = App::new();
    /// app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
    /// app.add_plugins(CoatingWeatheringPlugin::new(PreUpdate));
    /// app.update();
    /// ```
    pub fn new(schedule: impl ScheduleLabel) -> Self {
        Self { schedule: schedule.intern() }
    }
}

impl Default for CoatingWeatheringPlugin {
    /// Returns the plugin with the steps taken in [`Update`].
    ///
    /// Steps are counted out of elapsed time anyway, so a fixed timestep would gain nothing. A fixed timestep that has
    /// fallen behind would even spend the budget several times in one frame.
    fn default() -> Self {
        Self::new(Update)
    }
}

impl Plugin for CoatingWeatheringPlugin {
    fn build(&self, app: &mut App) {
        app.add_plugins(CoatingSettingsPlugin)
            .init_resource::<CoatingClock>()
            .init_resource::<CoatingBudget>()
            .init_resource::<CoatingCalendar>()
            .init_resource::<CoatingGravity>()
            .init_resource::<CoatingWeather>()
            .init_resource::<CoatingUnit>()
            .init_resource::<CoatingStatus>()
            .init_resource::<stepping::StepCost>()
            .init_resource::<stepping::ReachedPace>()
            .add_message::<FilmReady>()
            .add_message::<FilmFailed>()
            .add_message::<FirstSeparation>()
            .add_message::<FirstCrack>()
            .add_message::<PieceFallen>()
            .add_message::<FilmRepainted>()
            .add_message::<RatingReached>()
            .add_message::<AgeReached>()
            .add_message::<RestoreFailed>();
        diagnostics::add_diagnostics(app);
        stepping::add_step_schedule(app);
        add_frames(app);
        add_attachment(app);
        add_debris(app);
        let checks = (
            stepping::check_weather,
            stepping::check_weather_of_props,
            stepping::check_clock,
            stepping::follow_coatings,
        );
        let travels = (timeline::follow_histories, timeline::hand_out_ages, timeline::travel).chain();
        app.add_systems(self.schedule, (checks, travels, stepping::advance).chain().in_set(CoatingAdvance));
        app.add_plugins(FilmDisplayPlugin);
        app.add_systems(
            PostUpdate,
            (
                announce::<FilmReady>,
                announce::<FilmFailed>,
                announce::<FirstSeparation>,
                announce::<FirstCrack>,
                announce::<PieceFallen>,
                announce::<FilmRepainted>,
                announce::<RatingReached>,
                announce::<AgeReached>,
                announce::<RestoreFailed>,
            )
                .chain()
                .after(CoatingDisplay),
        );
    }
}

/// Tells observers what messages say.
fn announce<E>(mut told: MessageReader<E>, mut commands: Commands)
where
    E: Message + Clone + for<'a> Event<Trigger<'a>: Default>,
{
    for message in told.read() {
        commands.trigger(message.clone());
    }
}
