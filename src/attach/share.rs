//! Finds the target of each film of a coating, which share its triangles.

use bevy::{
    asset::Assets,
    ecs::{entity::Entity, world::World},
    math::Vec3,
    mesh::{Mesh, Mesh3d},
    transform::components::GlobalTransform,
};

use super::build::FilmBuild;
use crate::{
    api::{
        links::{FilmSlot, FilmSource},
        unit::CoatingUnit,
    },
    mesh_reader::area_of,
    remesh::{FilmResolution, FilmTarget, film_targets},
};

/// Returns the area of the own meshes of `slots` in the world, in square metres, also while they show a film. Meshes
/// that cannot be read have none.
pub(super) fn area_of_slots(world: &World, slots: &[Entity]) -> f64 {
    let assets = world.get_resource::<Assets<Mesh>>();
    let metres = world.get_resource::<CoatingUnit>().copied().unwrap_or_default().metres;
    let area = |&slot: &Entity| {
        let own = world.get::<FilmSlot>(slot).map(|claim| &claim.original);
        let mesh = assets?.get(own.or(world.get::<Mesh3d>(slot).map(|mesh| &mesh.0))?)?;
        let scale = world.get::<GlobalTransform>(slot).map_or(Vec3::ONE, GlobalTransform::scale);
        Some(area_of(mesh, scale * metres))
    };
    slots.iter().filter_map(area).sum()
}

/// Returns the area of the film that is built or being built.
pub(super) fn area_of_film(source: Option<&FilmSource>, build: Option<&FilmBuild>) -> Option<f64> {
    source.map(|source| source.area).or(build.map(|build| build.area))
}

/// Returns the target of each film of area `new`, if a coating asks for `resolution`, its settings for `grain`, and it
/// has films of the areas `others` besides.
pub(super) fn targets_of(resolution: FilmResolution, grain: f32, new: &[f64], others: &[f64]) -> Vec<FilmTarget> {
    let mut targets = film_targets(resolution, grain, &[new, others].concat());
    targets.truncate(new.len());
    targets
}
