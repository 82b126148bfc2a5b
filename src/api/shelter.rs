//! Defines how props are sheltered from rain and sun.

use bevy::{
    ecs::{component::Component, reflect::ReflectComponent},
    reflect::prelude::*,
};

/// Marker of a mesh, or of the root of a scene, that keeps rain and sun off props.
///
/// On an entity with a [`Mesh3d`](bevy::mesh::Mesh3d) that mesh shelters; on the root of a scene every mesh below it
/// does. Invisible meshes shelter, too, so that a plain shape can stand in for a detailed one. Skinned meshes do not
/// shelter. A mesh that is in the render world only cannot be read: it does not shelter, and a warning says so.
///
/// Shelters should stand still: when one moves noticeably, the props that it may shelter take no steps until rays have
/// been cast again.
///
/// A prop needs no marker to shelter itself: all meshes below its [`Coating`](super::coating::Coating) do.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn build_roof(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>) {
///     let roof = meshes.add(Cuboid::new(4.0, 0.1, 4.0));
///     commands.spawn((Mesh3d(roof), Transform::from_xyz(0.0, 3.0, 0.0), RainShelter));
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.insert_resource(CoatingWeather { rain: Vec3::NEG_Y, ..CoatingWeather::default() });
/// app.add_systems(Startup, build_roof);
/// app.update();
/// ```
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct RainShelter;

/// Source of a prop's exposure to rain and sun. It matters only while there is rain or sun.
///
/// ```
/// use bevy_coating::prelude::*;
///
/// // A buoy at sea: no rays need to be cast for it.
/// let buoy = Coating::default().with_shelter(Shelter::Open);
/// assert_eq!(Coating::default().shelter, Shelter::Scene);
/// # assert_eq!(buoy.shelter, Shelter::Open);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub enum Shelter {
    /// Rays that are cast in the background against the prop's own meshes and those marked with [`RainShelter`].
    ///
    /// They are cast again when rain, sun, prop or shelters turn by more than a degree, move by more than a quarter of
    /// the film's mean edge length, appear or disappear. Until the result is known, the prop takes no steps and the
    /// steps that the clock owes it add up.
    #[default]
    Scene,
    /// No shelter: rain and sun reach the whole prop.
    Open,
    /// Exposure that the game writes to [`StainFields::exposure`](crate::stain::StainFields::exposure) itself. Until it
    /// does, nothing shelters the prop, also while it is aged to its start age.
    Given,
}
