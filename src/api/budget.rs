//! Defines [`CoatingBudget`], the limit on ageing in one frame.

use std::time::Duration;

use bevy::{
    ecs::{reflect::ReflectResource, resource::Resource},
    reflect::prelude::*,
};

/// Limit on the time and the steps that ageing may take in one frame.
///
/// When the steps of all films do not fit into a frame, films that are large in the view of the nearest active camera
/// (radius over distance) step first and the others are postponed. A film far away is postponed up to 16 times longer
/// than one that fills the view. A postponed film keeps the steps that the clock owes it and takes them together later,
/// with the same result.
///
/// Showing films that changed takes its time from the same budget, half of it at most. Films that do not fit are shown
/// in a later frame, in the same order of preference; what they missed is shown together. Ageing does not wait for it.
///
/// A frame is worth less age for all films alike when a film would need more than [`max_steps`](Self::max_steps), when
/// time runs out, or when postponed films are several frames' worth of steps behind: on a slow machine paint ages more
/// slowly instead of making frames stutter, and each prop keeps its [rate](super::coating::Coating::rate) beside the
/// others. [`CoatingStatus`](super::status::CoatingStatus) tells the pace that is reached. At least one step is taken
/// in a frame in which any is due. Steps that were [requested](super::clock::CoatingClock::request_steps) are never
/// dropped.
///
/// Building films and other work in the background has threads of its own. In browsers, where it has none, it may take
/// [`max_time`](Self::max_time) in each frame as well.
///
/// ```
/// use std::time::Duration;
///
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.insert_resource(CoatingBudget { max_time: Duration::from_millis(2), ..CoatingBudget::default() });
/// ```
#[derive(Resource, Clone, Copy, Debug, PartialEq, Eq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingBudget {
    /// Wall time of a frame after which no further step is begun, less what showing films takes. Default 4 ms.
    pub max_time: Duration,
    /// Most steps that a film may take in one frame; 0 counts as 1. Default 16.
    pub max_steps: u32,
    /// Assumed cost of one step of a film with a thousand moving vertices. `None`, the default, measures it as the game
    /// runs. With a fixed cost the steps that fit into a frame do not depend on the machine, as replays and tests need.
    pub fixed_cost: Option<Duration>,
}

impl CoatingBudget {
    /// Budget without limits, for tools and tests.
    pub const UNLIMITED: Self = Self { max_time: Duration::MAX, max_steps: u32::MAX, fixed_cost: None };
}

impl Default for CoatingBudget {
    fn default() -> Self {
        Self { max_time: Duration::from_millis(4), max_steps: 16, fixed_cost: None }
    }
}
