//! Defines [`CoatingExclude`], which keeps meshes below a coating from being coated.

use bevy::{
    ecs::{component::Component, reflect::ReflectComponent},
    reflect::prelude::*,
};

/// Marker of an entity whose mesh, and all meshes below it, are not coated by a [`Coating`](super::coating::Coating)
/// above. It may be inserted and removed at any time. It has no effect on an entity that has a `Coating` itself, nor
/// below one.
///
/// Meshes whose `StandardMaterial` is alpha-blended or transmissive, like panes of glass, are left alone without it.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// /// Keeps the tyres of a car from peeling.
/// fn spare_rubber(mut commands: Commands, parts: Query<(Entity, &Name), (Added<Name>, With<Mesh3d>)>) {
///     for (part, name) in &parts {
///         if name.contains("tyre") {
///             commands.entity(part).insert(CoatingExclude);
///         }
///     }
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, spare_rubber);
/// app.update();
/// ```
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct CoatingExclude;
