//! Defines [`CoatingHistory`], with which the films of a coating can go back in time.

use bevy::{
    ecs::{component::Component, reflect::ReflectComponent},
    reflect::prelude::*,
};

use crate::history::DEFAULT_KEYFRAME_BYTES;

/// Request to keep the past of a coating's films, on the entity with the [`Coating`](super::coating::Coating). They can
/// go back then: by [`FilmClock::seek`](crate::sim::FilmClock::seek), by
/// [`CoatingCommands::age_to`](crate::CoatingCommands::age_to), and to a
/// [target age](super::clock::CoatingClock::target_age) that lies in the past.
///
/// The log has all that acts on a film from outside, with the number of the step: settings, gravity and weather,
/// quality, shelter, and [edits](crate::FilmEdit). Now and then the state of the film is kept. Both are done in the
/// background, or cost next to nothing. A film that is built with this begins its history fresh, whatever its start
/// age; one that was there before begins it where it is. The history ends when this is removed.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{CoatingHistory, prelude::*};
///
/// fn spawn(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>) {
///     let barrel = meshes.add(Cylinder::new(0.3, 0.9));
///     commands.spawn((Mesh3d(barrel), Coating::new(Preset::Heavy), CoatingHistory::default()));
/// }
///
/// /// Turns everything back to fresh paint.
/// fn rewind(mut clocks: Query<&mut FilmClock>) {
///     for mut clock in &mut clocks {
///         clock.seek(0.0);
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Startup, spawn).add_systems(Update, rewind);
/// app.update();
/// ```
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct CoatingHistory {
    /// Memory for the kept states of each film, in bytes. More of it makes going back faster; the film can go to any
    /// step whatever it is. Default: [`DEFAULT_KEYFRAME_BYTES`], 16 MiB, which a film of 10,000 triangles fills with
    /// some sixty states.
    pub keyframe_bytes: usize,
}

impl Default for CoatingHistory {
    fn default() -> Self {
        Self { keyframe_bytes: DEFAULT_KEYFRAME_BYTES }
    }
}
