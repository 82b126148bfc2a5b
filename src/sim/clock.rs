//! Counts the steps of one film, and tells its age.

use crate::stain::TICKS_PER_AGE;

/// Default number of steps per unit age: 1,000, as in the paper's reference run.
pub const DEFAULT_STEPS_PER_AGE: u32 = 1000;

/// Step counter of one film. Age follows from the number of whole steps, so it never drifts.
///
/// ```
/// use bevy_coating::sim::FilmClock;
///
/// let mut clock = FilmClock::new(500);
/// assert_eq!((clock.age(), clock.dt()), (0.0, 0.002));
/// clock.steps += 250;
/// assert_eq!(clock.age(), 0.5);
/// assert_eq!(clock.step_at(0.75), 375);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component), component(clone_behavior = Ignore))]
pub struct FilmClock {
    /// Number of steps taken so far.
    pub steps: u64,
    /// Number of steps in a unit of age, 1 or more (0 counts as 1). Default 1,000.
    pub steps_per_age: u32,
    /// Step to which the plugin is to bring the film.
    pub(crate) goal: Option<u64>,
}

impl Default for FilmClock {
    fn default() -> Self {
        Self::new(DEFAULT_STEPS_PER_AGE)
    }
}

impl FilmClock {
    /// Creates a clock at age 0 with steps of 1 / `steps_per_age`; 0 counts as 1.
    pub fn new(steps_per_age: u32) -> Self {
        Self { steps: 0, steps_per_age: steps_per_age.max(1), goal: None }
    }

    /// Asks the plugin to bring the film of this clock to `age`, back or forward; negative ages and NaN count as 0.
    ///
    /// The film is brought there in the background and shows itself as it was until it has arrived; it takes no other
    /// steps meanwhile. [`AgeReached`](crate::AgeReached) tells of it. Until then another call changes the goal. To go
    /// back, the film needs a [`CoatingHistory`](crate::CoatingHistory) beside its `Coating`; without one a warning
    /// says so, and the film stays. The film goes no farther back than its history.
    ///
    /// On the way the film meets what it has met before, as far as it has been there already, and the conditions of
    /// today from there on. When time runs on from an age in the past, conditions or edits that differ from those of
    /// then begin another future.
    ///
    /// ```
    /// use bevy::prelude::*;
    /// use bevy_coating::prelude::*;
    ///
    /// /// Shows every film at half its life.
    /// fn scrub(mut clocks: Query<&mut FilmClock>) {
    ///     for mut clock in &mut clocks {
    ///         clock.seek(0.5);
    ///     }
    /// }
    /// # let mut app = App::new();
    /// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
    /// # app.add_plugins(CoatingWeatheringPlugin::default());
    /// app.add_systems(Update, scrub);
    /// app.update();
    /// ```
    #[cfg(feature = "plugin")]
    pub fn seek(&mut self, age: f64) {
        self.goal = Some(self.step_at(age));
    }

    /// Returns the age to which the film is being brought, if it is.
    #[cfg(feature = "plugin")]
    pub fn sought(&self) -> Option<f64> {
        self.goal.map(|steps| Self { steps, ..*self }.age())
    }

    /// Returns the age at the end of the last step: 0 is fresh, 1 the end of the paper's reference run.
    pub fn age(&self) -> f64 {
        self.steps as f64 / f64::from(self.steps_per_age.max(1))
    }

    /// Returns the length of a step, an age.
    pub fn dt(&self) -> f32 {
        1.0 / self.steps_per_age.max(1) as f32
    }

    /// Returns the length of the tick of stains that the last step completed, an age, or `None` if it completed none.
    ///
    /// There are [`TICKS_PER_AGE`] ticks in a unit of age. A step that is longer than a tick counts as one tick, as
    /// long as the step.
    ///
    /// ```
    /// use bevy_coating::sim::FilmClock;
    ///
    /// let mut clock = FilmClock::new(1000);
    /// clock.steps = 9;
    /// assert_eq!(clock.tick(), None);
    /// clock.steps = 10;
    /// assert!(clock.tick().is_some_and(|dt| (dt - 0.01).abs() < 1e-6));
    /// ```
    pub fn tick(&self) -> Option<f32> {
        let (per_age, ticks_per_age) = (u128::from(self.steps_per_age.max(1)), u128::from(TICKS_PER_AGE));
        let ticks = |steps: u64| u128::from(steps) * ticks_per_age / per_age;
        let before = ticks(self.steps.checked_sub(1)?);
        if ticks(self.steps) == before {
            return None;
        }
        // The first step at or after the end of the tick before.
        let last = (before * per_age).div_ceil(ticks_per_age);
        Some((u128::from(self.steps) - last) as f32 * self.dt())
    }

    /// Returns the next step that completes a [tick](Self::tick) of stains.
    ///
    /// ```
    /// use bevy_coating::sim::FilmClock;
    ///
    /// let mut clock = FilmClock::new(1000);
    /// assert_eq!(clock.next_tick(), 10);
    /// clock.steps = 10;
    /// assert_eq!(clock.next_tick(), 20);
    /// ```
    pub fn next_tick(&self) -> u64 {
        let (per_age, ticks_per_age) = (u128::from(self.steps_per_age.max(1)), u128::from(TICKS_PER_AGE));
        let ticks = u128::from(self.steps) * ticks_per_age / per_age;
        let step = ((ticks + 1) * per_age).div_ceil(ticks_per_age);
        u64::try_from(step).unwrap_or(u64::MAX)
    }

    /// Returns the first step at which the film is at least `age` old; 0 for negative ages and NaN.
    pub fn step_at(&self, age: f64) -> u64 {
        // An age that is a whole number of steps is to give that step, although the age itself has been rounded.
        let steps = (age * f64::from(self.steps_per_age.max(1)) - 1e-6).ceil();
        if steps > 0.0 { steps as u64 } else { 0 }
    }
}
