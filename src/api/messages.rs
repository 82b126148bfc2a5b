//! What the plugin tells.

use bevy::{
    ecs::{entity::Entity, message::Message},
    math::Vec3,
};

use super::error::CoatingError;
use crate::surface::BuildWarning;
/// A film is ready, and its prop shows it.
#[derive(Message, Clone, Debug)]
pub struct FilmReady {
    /// Entity of the film.
    pub entity: Entity,
    /// Entity whose `Coating` it is.
    pub root: Entity,
    /// Triangles of the film.
    pub triangles: usize,
    /// What was put right in the prop's mesh, or could not be met.
    pub warnings: Vec<BuildWarning>,
}

/// A mesh could not be coated. It stays as it is.
#[derive(Message, Clone, Debug)]
pub struct FilmFailed {
    /// Entity that the film would have lived on.
    pub entity: Entity,
    /// Entity whose `Coating` it is.
    pub root: Entity,
    /// Why.
    pub error: CoatingError,
}

/// The first edge of a film tore. Not sent for films that appear cracked.
#[derive(Message, Clone, Copy, Debug, PartialEq)]
pub struct FirstCrack {
    /// Entity of the film.
    pub entity: Entity,
    /// Age of the film.
    pub age: f64,
    /// Middle of the edge, in the world.
    pub position: Vec3,
}

/// A piece of film fell off.
#[derive(Message, Clone, Copy, Debug, PartialEq)]
pub struct PieceFallen {
    /// Entity of the film.
    pub entity: Entity,
    /// Middle of the piece when it fell, in the world.
    pub position: Vec3,
    /// Its outward normal in the world: of unit length, or zero for a piece folded onto itself.
    pub normal: Vec3,
    /// Square root of its area, in the world's unit.
    pub size: f32,
    /// Triangles of the piece.
    pub faces: u32,
}
