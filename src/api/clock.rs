//! Defines the clock that all films share, and the direction of gravity.

use bevy::{
    ecs::{reflect::ReflectResource, resource::Resource},
    math::Vec3,
    reflect::prelude::*,
};

/// Default of [`CoatingClock::age_per_second`]: 50 seconds from fresh paint (age 0) to age 1.
pub const DEFAULT_AGE_PER_SECOND: f64 = 0.02;

/// Speed at which paint ages, for all films.
///
/// Elapsed seconds become whole steps of each film. The state of a film depends on the number of its steps alone,
/// not on the frame rate.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// /// Ages all paint from fresh to age 1 in ten minutes, and stops there.
/// fn set_speed(mut clock: ResMut<CoatingClock>) {
///     clock.age_per_second = 1.0 / 600.0;
///     clock.target_age = Some(1.0);
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Startup, set_speed);
/// app.update();
/// # assert_eq!(app.world().resource::<CoatingClock>().target_age, Some(1.0));
/// ```
#[derive(Resource, Clone, Debug, PartialEq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingClock {
    /// Age gained per second of [`Time`](bevy::time::Time), by films of rate 1. 0 or more, default
    /// [`DEFAULT_AGE_PER_SECOND`]. Infinite: as fast as the [budget](super::budget::CoatingBudget) allows. Negative
    /// speeds and NaN count as 0; a warning says so.
    pub age_per_second: f64,
    /// Whether the clock stands still. Only [requested steps](Self::request_steps) are taken then; steps that films are
    /// owed wait. Default false.
    pub paused: bool,
    /// Age at which films stop ageing, also by requested steps. Films that are older stay as they are. `None`, the
    /// default, lets films age without end, also beyond age 1, and so does an infinite age. Negative ages and NaN count
    /// as 0; a warning says so.
    pub target_age: Option<f64>,
    /// Steps [requested](Self::request_steps) since the last frame. The next frame hands them to the films and sets
    /// this to 0. Default 0.
    pub requested_steps: u64,
    /// Age that is [skipped](Self::skip) in the next frame, which sets this to 0. Default 0.
    pub skipped_age: f64,
}

impl Default for CoatingClock {
    fn default() -> Self {
        Self {
            age_per_second: DEFAULT_AGE_PER_SECOND,
            paused: false,
            target_age: None,
            requested_steps: 0,
            skipped_age: 0.0,
        }
    }
}

impl CoatingClock {
    /// Requests `steps` further steps from every film that is ready, also while the clock is paused: so time can be
    /// taken step by step. Props whose own [`Coating::paused`](super::coating::Coating::paused) is true take none.
    ///
    /// The steps are spread over as many frames as the [budget](super::budget::CoatingBudget) needs. While the clock
    /// runs, they come on top of its steps.
    ///
    /// ```
    /// use bevy_coating::CoatingClock;
    ///
    /// let mut clock = CoatingClock { paused: true, ..CoatingClock::default() };
    /// clock.request_steps(10);
    /// assert_eq!(clock.requested_steps, 10);
    /// ```
    pub fn request_steps(&mut self, steps: u64) {
        self.requested_steps = self.requested_steps.saturating_add(steps);
    }

    /// Lets `age` pass at once: the date of the [calendar](super::calendar::CoatingCalendar) leaps, and every film goes
    /// on by as much, times its rate, in the background and in today's weather. Each shows itself as it was until it
    /// has arrived. Ages that are negative, infinite or NaN count as 0. Props that are paused stay as they are, and
    /// nothing grows older than the [target](Self::target_age).
    ///
    /// ```
    /// use bevy::prelude::*;
    /// use bevy_coating::prelude::*;
    ///
    /// /// Ten years pass while the player sleeps.
    /// fn sleep(mut clock: ResMut<CoatingClock>) {
    ///     clock.skip(0.3);
    /// }
    /// # let mut app = App::new();
    /// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
    /// # app.add_plugins(CoatingWeatheringPlugin::default());
    /// app.add_systems(Startup, sleep);
    /// app.update();
    /// # assert_eq!(app.world().resource::<CoatingCalendar>().date(), 0.3);
    /// ```
    pub fn skip(&mut self, age: f64) {
        self.skipped_age += checked_skip(age);
    }

    /// Takes the age that is to be skipped.
    pub(crate) fn take_skip(&mut self) -> f64 {
        checked_skip(std::mem::take(&mut self.skipped_age))
    }

    /// Returns [`CoatingClock::age_per_second`], or 0 if it is out of range.
    pub(crate) fn checked_speed(&self) -> f64 {
        // NaN becomes 0.
        self.age_per_second.max(0.0)
    }

    /// Returns [`CoatingClock::target_age`], with 0 for ages out of range, and `None` for an infinite one.
    pub(crate) fn checked_target(&self) -> Option<f64> {
        self.target_age.filter(|&age| age != f64::INFINITY).map(|age| age.max(0.0))
    }

    /// Returns the names of the fields that are out of range, with what they count as.
    pub(crate) fn faults(&self) -> Vec<&'static str> {
        let is_fault = |value: f64| !(value >= 0.0);
        let faults = [
            (is_fault(self.age_per_second), "`age_per_second` is negative or NaN and counts as 0"),
            (self.target_age.is_some_and(is_fault), "`target_age` is negative or NaN and counts as 0"),
        ];
        faults.into_iter().filter_map(|(is_fault, name)| is_fault.then_some(name)).collect()
    }
}

/// Returns `age`, or 0 if time cannot leap by it.
fn checked_skip(age: f64) -> f64 {
    if age > 0.0 && age.is_finite() { age } else { 0.0 }
}

/// Direction of gravity in the world, of any length. Default: -y. Zero means weightlessness: nothing runs off.
///
/// Gravity decides where rust comes out of a crack and runs off, where dust settles, and which side of a crack's end
/// keeps its vertex.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// // A world in which z points up.
/// app.insert_resource(CoatingGravity(Vec3::NEG_Z));
/// ```
#[derive(Resource, Clone, Copy, Debug, PartialEq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingGravity(pub Vec3);

impl Default for CoatingGravity {
    fn default() -> Self {
        Self(Vec3::NEG_Y)
    }
}
