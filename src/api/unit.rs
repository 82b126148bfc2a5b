//! Defines the unit of the world.

use std::ops::RangeInclusive;

use bevy::{
    ecs::{reflect::ReflectResource, resource::Resource},
    reflect::prelude::*,
};

use super::error::CoatingFault;

/// Range of [`CoatingUnit::metres`].
pub const UNITS: RangeInclusive<f32> = 1e-4..=1e4;

/// Length of the world's unit.
///
/// Films know metres: the grain of cracks, the length of streaks, the patterns of stains. This says how long a unit of
/// the world is, so that a prop ages alike in a world of any unit. It counts when a film is built; films that are there
/// already stay as they are. Set it before the first prop is coated.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// // A world in centimetres.
/// app.insert_resource(CoatingUnit { metres: 0.01 });
/// ```
#[derive(Resource, Clone, Copy, Debug, PartialEq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingUnit {
    /// Metres that a unit of the world is long: 0.0001 to 10,000, default 1. While it is out of this range, no film is
    /// built: props are refused with [`CoatingFault::Unit`].
    pub metres: f32,
}

impl Default for CoatingUnit {
    fn default() -> Self {
        Self { metres: 1.0 }
    }
}

impl CoatingUnit {
    /// Returns the metres a unit is long.
    ///
    /// # Errors
    /// [`CoatingFault::Unit`] if they are NaN or out of their range.
    pub(crate) fn checked(self) -> Result<f32, CoatingFault> {
        if UNITS.contains(&self.metres) { Ok(self.metres) } else { Err(CoatingFault::Unit(self.metres)) }
    }
}
