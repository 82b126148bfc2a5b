//! Where all films stand.

use bevy::{
    ecs::{reflect::ReflectResource, resource::Resource},
    reflect::prelude::*,
};

/// Where all films stand, counted once a frame.
#[derive(Resource, Clone, Copy, Debug, Default, PartialEq, Reflect)]
#[reflect(Resource, Default, Debug, Clone, PartialEq)]
pub struct CoatingStatus {
    /// Mesh entities that wait for their film, or for assets to be loaded.
    pub waiting: usize,
    /// Mesh entities that could not be coated.
    pub refused: usize,
    /// Films that are ready.
    pub films: usize,
    /// Films that took a step in the last frame.
    pub stepped: usize,
    /// Films that had no turn in the last frame, as there was no time for all.
    pub postponed: usize,
    /// Films that owe steps, but wait until it is known what [shelters](super::shelter::Shelter) them.
    pub casting: usize,
    /// Age of the youngest film; 0 without films.
    pub youngest: f64,
    /// Age of the oldest film; 0 without films.
    pub oldest: f64,
}
