//! Defines [`CoatingSnapshot`], the saved films of one coating.

use bevy::{
    ecs::{component::Component, entity::Entity, reflect::ReflectComponent},
    reflect::prelude::*,
};
use serde::{Deserialize, Serialize};

use crate::snapshot::{Snapshot, SnapshotError};

/// Saved films of one [`Coating`](super::coating::Coating): the state of each, to the bit.
///
/// As a component beside the `Coating` it is where its films begin: a prop that is spawned with it appears as it was
/// saved, and goes on as if it had never been away. It is part of a saved Bevy scene, can be put into a game's own
/// saves by [`serde`], and changes nothing by being there once the films have been built.
/// [`restore_films`](crate::CoatingCommands::restore_films) puts it back on films that are there already. It goes with
/// its `Coating`.
///
/// Settings, rate and everything else that a `Coating` says are not in it, and are saved with the `Coating`. The prop
/// must have the same mesh, scale and resolution as when it was saved: its film is found by a digest of its mesh, and
/// any other is refused with [`RestoreFailed`](super::messages::RestoreFailed). The seed is in it.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{CoatingSnapshot, prelude::*};
///
/// #[derive(Resource)]
/// struct Save(Vec<(Transform, Coating, CoatingSnapshot)>);
///
/// fn save(world: &mut World) {
///     let mut props = world.query::<(Entity, &Transform, &Coating)>();
///     let props: Vec<_> = props.iter(world).map(|(prop, at, coating)| (prop, *at, coating.clone())).collect();
///     let saved = |(prop, at, coating)| Some((at, coating, CoatingSnapshot::of(world, prop).ok()?));
///     let save = Save(props.into_iter().filter_map(saved).collect());
///     world.insert_resource(save);
/// }
///
/// fn load(mut commands: Commands, save: Res<Save>, mut meshes: ResMut<Assets<Mesh>>) {
///     for prop in &save.0 {
///         commands.spawn((Mesh3d(meshes.add(Cylinder::new(0.3, 0.9))), prop.clone()));
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Startup, (save, load).chain());
/// app.update();
/// ```
#[derive(Component, Clone, Debug, Default, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Component, Default, Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CoatingSnapshot {
    /// Seed from which those of the films follow: that of the coating, or the one that was drawn for it.
    pub seed: u64,
    /// [Date](super::calendar::CoatingCalendar) at which the films were saved, an age.
    pub date: f64,
    /// Films, in the order of their paths.
    pub films: Vec<SavedFilm>,
}

/// Saved film of a [`CoatingSnapshot`].
#[derive(Clone, Debug, PartialEq, Reflect, Serialize, Deserialize)]
#[reflect(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SavedFilm {
    /// Names of the entities that lead from the coating down to the film; empty for a film on the coating's entity.
    pub path: String,
    /// State of the film.
    pub state: Snapshot,
}

impl CoatingSnapshot {
    /// Returns the saved film at `path`.
    pub(crate) fn film_at(&self, path: &str) -> Option<&Snapshot> {
        self.films.iter().find(|film| film.path == path).map(|film| &film.state)
    }
}

/// Reason why the films of a coating cannot be saved.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SaveError {
    /// The entity has no `Coating`.
    #[error("entity {entity} cannot be saved: it has no `Coating`; give the entity that has one")]
    NoCoating {
        /// The entity.
        entity: Entity,
    },
    /// A film of the coating is being built.
    #[error(
        "the films of entity {entity} cannot be saved: they are being built; wait until `CoatingStatus::waiting` is 0, \
         or save its `CoatingSnapshot` if it has one"
    )]
    NotReady {
        /// Entity with the coating.
        entity: Entity,
    },
    /// A film cannot be saved.
    #[error("the film of entity {entity} cannot be saved: {source}")]
    Film {
        /// Entity of the film.
        entity: Entity,
        /// Reason.
        source: SnapshotError,
    },
}
