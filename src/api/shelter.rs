//! What keeps rain and sun off props.

use bevy::{
    ecs::{component::Component, reflect::ReflectComponent},
    reflect::prelude::*,
};

/// Marks what keeps rain and sun off props: on an entity with a [`Mesh3d`](bevy::mesh::Mesh3d), or on the root of a
/// scene, and then every mesh below it counts.
///
/// Meshes count whether they are visible or not, so that a plain shape can stand in for a detailed one. Put it
/// on what stands still: when a shelter moves by more than a trifle, what it may keep dry waits until rays have been cast
/// anew. Skinned meshes do not count. Meshes must be readable: one that is kept in the render world only is passed
/// over with a warning.
///
/// A prop shelters itself without it, with all meshes below its [`Coating`](super::coating::Coating).
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct RainShelter;

/// What decides how much rain and sun reaches a prop. Matters only while there is any.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub enum Shelter {
    /// Rays are cast in the background against the prop's own meshes and those marked with [`RainShelter`], and
    /// again when rain, sun, prop or shelters turn by more than a degree, move by more than a quarter of the film's mean
    /// edge, come or go. Until it is known what they reach, the prop takes no steps; those that the clock owes it wait.
    #[default]
    Scene,
    /// Nothing shelters it.
    Open,
    /// [`StainFields::exposure`](crate::stain::StainFields::exposure) as you write it. Until you do, nothing shelters
    /// the prop, also while it is aged to its start age.
    Given,
}
