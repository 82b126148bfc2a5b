//! Which entities belong together: coating, film, the prop's meshes and the children that show what is under the paint.

use bevy::{
    asset::Handle,
    ecs::{component::Component, entity::Entity, reflect::ReflectComponent},
    math::Vec3,
    mesh::Mesh,
    reflect::prelude::*,
};

use super::coating::FilmKey;

/// On the entity of every film that is being built or ready: the entity whose [`Coating`](super::coating::Coating) it is.
#[derive(Component, Clone, Copy, Debug, PartialEq, Eq, Reflect)]
#[reflect(Component, Debug, Clone, PartialEq)]
pub struct CoatedBy(pub Entity);

/// On the entities that the plugin spawns to show the paint's back and the bare metal.
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Default, Debug, Clone)]
pub struct CoatingPart;

/// What a film was made of and how.
#[derive(Component, Clone, Debug)]
pub(crate) struct FilmSource {
    pub key: FilmKey,
    /// Entities whose meshes make up the film, by slot.
    pub slots: Vec<Entity>,
    /// World scale at which the film was built: film position = scale * mesh position.
    pub scale: Vec3,
}

/// On a mesh entity that waits for its film.
#[derive(Component, Clone, Copy, Debug)]
pub(crate) struct AwaitingFilm {
    pub root: Entity,
}

/// On a mesh entity that could not be coated. Kept until its mesh or coating changes.
#[derive(Component, Clone, Copy, Debug)]
pub(crate) struct FilmRefused {
    pub root: Entity,
}

/// On a mesh entity whose film is being built or ready.
#[derive(Component, Clone, Debug)]
pub(crate) struct FilmSlot {
    /// Entity of the film.
    pub film: Entity,
    /// The prop's own mesh.
    pub original: Handle<Mesh>,
    /// The mesh that shows the film; `None` while it is being built.
    pub shown: Option<Handle<Mesh>>,
}
