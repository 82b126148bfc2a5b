//! Links the entities of a coating: its root, its films, the prop's meshes and the children that the plugin spawns.

use bevy::{
    asset::Handle,
    ecs::{component::Component, entity::Entity, reflect::ReflectComponent},
    math::Vec3,
    mesh::Mesh,
    reflect::prelude::*,
};

use super::coating::FilmKey;

/// Link from the entity of a film to the entity with its [`Coating`](super::coating::Coating).
///
/// It is present while the film is being built and afterwards.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// /// Prints the age of every film and the name of its prop.
/// fn print_ages(films: Query<(&CoatedBy, &FilmClock)>, names: Query<&Name>) {
///     for (coated_by, clock) in &films {
///         if let Ok(name) = names.get(coated_by.0) {
///             info!("{name} is {:.2} old", clock.age());
///         }
///     }
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, print_ages);
/// app.update();
/// ```
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Reflect)]
#[reflect(Component, Debug, Clone, PartialEq)]
pub struct CoatedBy(pub Entity);

/// Marker of the entities that the plugin spawns to draw the backs of flakes and the bare metal. They are children of
/// the entities of the prop's meshes, and have their render layers, shadow flags and visibility.
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Default, Debug, Clone)]
pub struct CoatingPart;

/// Origin of a film: its meshes and the fields with which it was built.
#[derive(Component, Clone, Debug)]
pub(crate) struct FilmSource {
    /// Fields of the coating with which the film was built.
    pub key: FilmKey,
    /// Entities whose meshes make up the film, by slot.
    pub slots: Vec<Entity>,
    /// World scale at which the film was built: a position of the film is scale * position in the mesh.
    pub scale: Vec3,
}

/// Marker of a mesh entity whose film has not been begun yet.
#[derive(Component, Clone, Copy, Debug)]
pub(crate) struct AwaitingFilm {
    /// Entity with the coating.
    pub root: Entity,
}

/// Marker of a mesh entity that could not be coated. It is kept until the mesh or the coating changes.
#[derive(Component, Clone, Copy, Debug)]
pub(crate) struct FilmRefused {
    /// Entity with the coating.
    pub root: Entity,
}

/// Link from a mesh entity to its film, which is being built or ready.
#[derive(Component, Clone, Debug)]
pub(crate) struct FilmSlot {
    /// Entity of the film.
    pub film: Entity,
    /// Mesh of the prop itself.
    pub original: Handle<Mesh>,
    /// Mesh that draws the film; `None` while the film is being built.
    pub display_mesh: Option<Handle<Mesh>>,
}
