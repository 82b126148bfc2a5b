//! Defines the messages that the plugin sends.
//!
//! Each is also an event that observers get, of the film's entity and of all above it: the plugin triggers it at the
//! end of the frame in which it was sent.

use std::sync::Arc;

use bevy::{
    ecs::{entity::Entity, event::EntityEvent, message::Message},
    math::Vec3,
};

use super::error::CoatingError;
use crate::{
    film::{FaceId, FilmMesh},
    fracture::FilmForces,
    snapshot::SnapshotError,
    surface::BuildWarning,
    survey::Rating,
};

/// Message that a film has been built and its prop shows it.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn greet(mut ready: MessageReader<FilmReady>) {
///     for film in ready.read() {
///         info!("{} is painted with {} triangles", film.entity, film.triangles);
///         for warning in &film.warnings {
///             warn!("{warning}");
///         }
///     }
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, greet);
/// # let mesh = app.world_mut().resource_mut::<Assets<Mesh>>().add(Cuboid::default());
/// # app.world_mut().spawn((Mesh3d(mesh), Coating::default().with_triangles(200)));
/// # for _ in 0..60_000 {
/// #     app.update();
/// #     if !app.world().resource::<Messages<FilmReady>>().is_empty() {
/// #         return;
/// #     }
/// #     std::thread::sleep(std::time::Duration::from_millis(1));
/// # }
/// # panic!("no film was built");
/// ```
///
/// Like all messages of the plugin it is an event for observers, too, of the film's entity or any above it:
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// # let mesh = app.world_mut().resource_mut::<Assets<Mesh>>().add(Cuboid::default());
/// # let mut commands = app.world_mut().commands();
/// commands.spawn((Mesh3d(mesh), Coating::default())).observe(|ready: On<FilmReady>| {
///     info!("painted with {} triangles", ready.triangles);
/// });
/// # app.update();
/// ```
#[derive(Message, EntityEvent, Clone, Debug)]
#[entity_event(propagate, auto_propagate)]
pub struct FilmReady {
    /// Entity of the film.
    pub entity: Entity,
    /// Entity with the film's `Coating`.
    pub root: Entity,
    /// Number of triangles of the film.
    pub triangles: usize,
    /// Faults of the prop's mesh that were mended, and requests that could not be met exactly.
    pub warnings: Vec<BuildWarning>,
}

/// Message that a mesh could not be coated. The prop keeps its own mesh and material; where a changed coating asked for
/// another film, it keeps the film that it has.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn complain(mut failed: MessageReader<FilmFailed>) {
///     for FilmFailed { root, error, .. } in failed.read() {
///         if error.cause == CoatingFault::Skinned {
///             info!("the coating of {root} leaves out its skinned meshes");
///         }
///     }
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, complain);
/// app.update();
/// ```
#[derive(Message, EntityEvent, Clone, Debug)]
#[entity_event(propagate, auto_propagate)]
pub struct FilmFailed {
    /// Entity on which the film would have been.
    pub entity: Entity,
    /// Entity with the film's `Coating`.
    pub root: Entity,
    /// Reason for the refusal.
    pub error: CoatingError,
}

/// Message that a film has let go of its metal for the first time: at one vertex, where it may begin to crack and curl.
/// It is not sent for films that have separated already when they appear.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn hint(mut separations: MessageReader<FirstSeparation>) {
///     for first in separations.read() {
///         info!("paint is loose at {} from age {:.2} on", first.position, first.age);
///     }
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, hint);
/// app.update();
/// ```
#[derive(Message, EntityEvent, Clone, Copy, Debug, PartialEq)]
#[entity_event(propagate, auto_propagate)]
pub struct FirstSeparation {
    /// Entity of the film.
    pub entity: Entity,
    /// Age of the film: 0 is fresh.
    pub age: f64,
    /// Position of the vertex, in world space.
    pub position: Vec3,
}

/// Message that the first edge of a film has torn. It is not sent for films that are cracked already when they appear.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn play_crack(mut cracks: MessageReader<FirstCrack>) {
///     for crack in cracks.read() {
///         info!("a crack opens at {} at age {:.2}", crack.position, crack.age);
///     }
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, play_crack);
/// app.update();
/// ```
#[derive(Message, EntityEvent, Clone, Copy, Debug, PartialEq)]
#[entity_event(propagate, auto_propagate)]
pub struct FirstCrack {
    /// Entity of the film.
    pub entity: Entity,
    /// Age of the film: 0 is fresh.
    pub age: f64,
    /// Middle of the edge, in world space.
    pub position: Vec3,
}

/// Message that a rating of a film has got worse by a class or more: its rust, its flaking or its cracking. There is
/// one for each rating.
///
/// It is not sent for ratings with which a film appears, nor when a film goes back in time; afterwards it tells of
/// ratings again. The film's [`FilmSummary`](super::summary::FilmSummary) has all figures.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{prelude::*, survey::{Rating, RustGrade}};
///
/// fn warn_of_rust(mut ratings: MessageReader<RatingReached>) {
///     for reached in ratings.read() {
///         if reached.rating == Rating::Rust(RustGrade::Ri3) {
///             info!("{} needs new paint at age {:.2}", reached.root, reached.age);
///         }
///     }
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, warn_of_rust);
/// app.update();
/// ```
#[derive(Message, EntityEvent, Clone, Copy, Debug, PartialEq)]
#[entity_event(propagate, auto_propagate)]
pub struct RatingReached {
    /// Entity of the film.
    pub entity: Entity,
    /// Entity with the film's `Coating`.
    pub root: Entity,
    /// Age of the film: 0 is fresh.
    pub age: f64,
    /// The rating now.
    pub rating: Rating,
    /// The worst rating of the same kind before.
    pub before: Rating,
}

/// Message that a piece of paint has fallen off.
///
/// The piece itself is gone from the film; the message has all that is needed to spawn debris in its place.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn spawn_debris(mut commands: Commands, mut pieces: MessageReader<PieceFallen>, mut meshes: ResMut<Assets<Mesh>>) {
///     for piece in pieces.read() {
///         let normal = piece.normal.try_normalize().unwrap_or(Vec3::Y);
///         let flake = meshes.add(Plane3d::new(normal, Vec2::splat(piece.size / 2.0)));
///         commands.spawn((Mesh3d(flake), Transform::from_translation(piece.position)));
///     }
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, spawn_debris);
/// app.update();
/// ```
#[derive(Message, EntityEvent, Clone, Copy, Debug, PartialEq)]
#[entity_event(propagate, auto_propagate)]
pub struct PieceFallen {
    /// Entity of the film.
    pub entity: Entity,
    /// Centre of the piece when it fell, in world space.
    pub position: Vec3,
    /// Outward normal of the piece in world space: of unit length, or zero for a piece that is folded onto itself.
    pub normal: Vec3,
    /// Square root of the piece's area, in world units.
    pub size: f32,
    /// Number of triangles of the piece.
    pub faces: u32,
}

/// Message that a film was painted over ([`Effect::Repaint`](crate::touch::Effect::Repaint)): one for each touch of the
/// brush, with how far the work has come.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn praise(mut painted: MessageReader<FilmRepainted>) {
///     for film in painted.read().filter(|film| film.is_finished()) {
///         info!("{} is as good as new", film.root);
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, praise);
/// app.update();
/// ```
#[derive(Message, EntityEvent, Clone, Copy, Debug, PartialEq)]
#[entity_event(propagate, auto_propagate)]
pub struct FilmRepainted {
    /// Entity of the film.
    pub entity: Entity,
    /// Entity with the film's `Coating`.
    pub root: Entity,
    /// Share of the film's area that is there and attached to the metal at all corners, from 0 to 1.
    pub whole: f32,
}

impl FilmRepainted {
    /// Share of the film from which it counts as painted.
    pub const FINISHED: f32 = 0.98;

    /// Returns whether the film is whole but for 2 %: nobody finds the last spot.
    pub fn is_finished(&self) -> bool {
        self.whole >= Self::FINISHED
    }

    /// Returns the message for a film.
    pub(crate) fn of(entity: Entity, root: Entity, mesh: &FilmMesh, forces: &FilmForces) -> Self {
        let topology = &mesh.topology;
        let holds = |f: &FaceId| topology.corners(*f).into_iter().all(|v| forces.is_attached(v));
        let area = |f: FaceId| f64::from(mesh.geometry.rest_area_of(topology, f));
        let whole: f64 = topology.live_faces().filter(holds).map(area).sum();
        Self { entity, root, whole: (whole / f64::from(mesh.geometry.rest_area)) as f32 }
    }
}

/// Message that a film has come to the age to which it was [sought](crate::sim::FilmClock::seek), or to a saved state
/// that was put back. It is shown from this frame on.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn announce(mut reached: MessageReader<AgeReached>) {
///     for film in reached.read() {
///         info!("{} is {:.2} old now", film.entity, film.age);
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, announce);
/// app.update();
/// ```
#[derive(Message, EntityEvent, Clone, Copy, Debug, PartialEq)]
#[entity_event(propagate, auto_propagate)]
pub struct AgeReached {
    /// Entity of the film.
    pub entity: Entity,
    /// Entity with the film's `Coating`.
    pub root: Entity,
    /// Age of the film now.
    pub age: f64,
}

/// Message that a saved state could not be put back. The film stays as it was, or begins at its start age if it has
/// only been built. The error is logged, too.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn complain(mut failed: MessageReader<RestoreFailed>) {
///     for film in failed.read() {
///         info!("{} is not as it was saved: {}", film.entity, film.error);
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, complain);
/// app.update();
/// ```
#[derive(Message, EntityEvent, Clone, Debug)]
#[entity_event(propagate, auto_propagate)]
pub struct RestoreFailed {
    /// Entity of the film.
    pub entity: Entity,
    /// Entity with the film's `Coating`.
    pub root: Entity,
    /// Reason, with the way out.
    pub error: Arc<SnapshotError>,
}
