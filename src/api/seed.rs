//! Defines [`CoatingSeed`], which keeps the seed that was drawn for a coating.

use bevy::{
    ecs::{component::Component, reflect::ReflectComponent},
    reflect::prelude::*,
};

/// Seed that the plugin drew for a [`Coating`](super::coating::Coating) without one, from the place in the world where
/// it was first coated. See [`Coating::seed`](super::coating::Coating::seed).
///
/// It stays when the prop moves and is saved with a scene, so a level looks the same each time. Clones do not take it
/// over. Insert one with the coating to choose the seed of a prop and leave the coating itself as it is.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// /// Prints the seed with which a prop can be had again.
/// fn print_seeds(seeds: Query<(Entity, &CoatingSeed), Added<CoatingSeed>>) {
///     for (prop, seed) in &seeds {
///         info!("{prop} has the seed {}", seed.0);
///     }
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, print_seeds);
/// app.update();
/// ```
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[component(clone_behavior = Ignore)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct CoatingSeed(pub u64);
