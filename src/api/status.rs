//! Counts the films and their ages.

use bevy::{
    ecs::{reflect::ReflectResource, resource::Resource},
    reflect::prelude::*,
};

/// Number of films in each state, and their ages, counted once a frame.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// /// Returns whether all props have their films, so that the loading screen can go.
/// fn all_painted(status: Res<CoatingStatus>) -> bool {
///     status.waiting == 0
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, (|| info!("ready")).run_if(all_painted));
/// app.update();
/// # assert_eq!(*app.world().resource::<CoatingStatus>(), CoatingStatus::default());
/// ```
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingStatus {
    /// Number of mesh entities whose film is being built, or that wait for assets to load.
    pub waiting: usize,
    /// Number of mesh entities that could not be coated, and are not being tried again.
    pub refused: usize,
    /// Number of films that are built again, because their coating changed. They age and are shown until then.
    pub renewing: usize,
    /// Number of films that are ready.
    pub films: usize,
    /// Number of films that took a step in the last frame.
    pub stepped: usize,
    /// Number of films that were postponed in the last frame, as the [budget](super::budget::CoatingBudget) had no time
    /// for their steps.
    pub postponed: usize,
    /// Number of films that have steps to take, but wait for rays to be cast against their
    /// [shelters](super::shelter::Shelter).
    pub casting: usize,
    /// Number of films that are on their way to another age, or to a saved state.
    pub seeking: usize,
    /// Age of the youngest film; 0 without films.
    pub youngest: f64,
    /// Age of the oldest film; 0 without films.
    pub oldest: f64,
    /// Age that a film of rate 1 gained per second, averaged over half a second. It is less than
    /// [`CoatingClock::age_per_second`](super::clock::CoatingClock::age_per_second) where the budget is too small, and
    /// 0 while no film ages.
    pub age_per_second: f64,
}
