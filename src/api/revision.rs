//! What changed on a film since display last looked.

use bevy::{
    ecs::{component::Component, reflect::ReflectComponent},
    reflect::prelude::*,
};

/// Counts what changed, so that display follows only when something did. A system that edits a film counts up.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct FilmRevision {
    /// Vertices may have moved.
    pub positions: u32,
    /// Vertices separated or faces were removed: other parts of the metal show.
    pub exposure: u32,
    /// Edges tore or faces were removed.
    pub topology: u32,
    /// [`StainFields::revision`]: stains look different.
    pub stains: u32,
}
