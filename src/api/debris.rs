//! Debris: pieces of paint that fall as objects of the world.

use bevy::{
    ecs::{component::Component, entity::Entity, reflect::ReflectComponent},
    math::Vec3,
    reflect::prelude::*,
};

use crate::film::FaceId;

/// Component beside a [`Coating`](super::coating::Coating): pieces of paint that come off fall into the world.
///
/// Each becomes an entity with a [`Flake`] and the piece's own mesh, with the prop's texture in front and primer behind
/// it. By default flakes flutter down, come to rest, shrink away and are despawned. A physics engine takes them over in
/// one line:
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{CoatingDebris, Flake, prelude::*};
///
/// #[derive(Component)]
/// struct RigidBody(Vec3);
///
/// let mut app = App::new();
/// app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_observer(|flake: On<Add, Flake>, flakes: Query<&Flake>, mut commands: Commands| {
///     if let Ok(&Flake { velocity, .. }) = flakes.get(flake.entity) {
///         commands.entity(flake.entity).insert(RigidBody(velocity));
///     }
/// });
/// let mesh = app.world_mut().resource_mut::<Assets<Mesh>>().add(Cuboid::default());
/// let debris = CoatingDebris { flutters: false, ..CoatingDebris::default() };
/// app.world_mut().spawn((Mesh3d(mesh), Coating::new(Preset::Heavy), debris));
/// app.update();
/// ```
#[derive(Component, Clone, Copy, Debug, PartialEq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct CoatingDebris {
    /// Whether the plugin moves flakes and despawns them. Default true.
    pub flutters: bool,
    /// Time for which a flake lasts, in seconds: 0 or more, default 8. In its last second it shrinks away.
    pub lifetime: f32,
    /// Height of the ground against gravity, in world units, on which flakes come to rest. `None`, the default: they
    /// fall on.
    pub floor: Option<f32>,
    /// Least size of a piece that becomes a flake, the square root of its area in world units. Default 0.
    pub least_size: f32,
    /// Most flakes of the coating at a time; further pieces vanish. Default 200.
    pub most: u32,
}

impl Default for CoatingDebris {
    fn default() -> Self {
        Self { flutters: true, lifetime: 8.0, floor: None, least_size: 0.0, most: 200 }
    }
}

/// Piece of paint that has come off, with a mesh of its own. See [`CoatingDebris`].
#[derive(Component, Clone, Copy, Debug, PartialEq, Reflect)]
#[reflect(Component, Debug, Clone, PartialEq)]
pub struct Flake {
    /// Entity with the `Coating` that it was part of.
    pub root: Entity,
    /// Velocity in world units a second: at first a guess, slowly away from the prop.
    pub velocity: Vec3,
    /// Axis of its turning times the speed, in radians a second.
    pub spin: Vec3,
    /// Square root of its area, in world units.
    pub size: f32,
    /// Time since it came off, in seconds.
    pub time: f32,
}

/// Pieces that have come off a film since debris was made of them, on the film's entity where its coating has
/// [`CoatingDebris`].
#[derive(Component, Clone, Debug, Default)]
#[component(clone_behavior = Ignore)]
pub(crate) struct FallenPieces {
    /// Faces of all pieces, one piece after the other.
    pub faces: Vec<FaceId>,
    /// Number of faces of each piece.
    pub counts: Vec<u32>,
}
