//! Shares the triangles of a coating between its films.

use bevy::{
    asset::Assets,
    ecs::{entity::Entity, world::World},
    math::Vec3,
    mesh::{Mesh, Mesh3d},
    transform::components::GlobalTransform,
};

use super::build::FilmBuild;
use crate::{
    api::links::FilmSource,
    mesh_reader::area_of,
    remesh::{FilmResolution, share_triangles},
};

/// Returns the area of the meshes of `slots` in the world, in square metres. Meshes that cannot be read have none.
pub(super) fn area_of_slots(world: &World, slots: &[Entity]) -> f64 {
    let assets = world.get_resource::<Assets<Mesh>>();
    let area = |&slot: &Entity| {
        let mesh = assets?.get(&world.get::<Mesh3d>(slot)?.0)?;
        let scale = world.get::<GlobalTransform>(slot).map_or(Vec3::ONE, GlobalTransform::scale);
        Some(area_of(mesh, scale))
    };
    slots.iter().filter_map(area).sum()
}

/// Returns the area of the film that is built or being built.
pub(super) fn area_of_film(source: Option<&FilmSource>, build: Option<&FilmBuild>) -> Option<f64> {
    source.map(|source| source.area).or(build.map(|build| build.area))
}

/// Returns the resolution of each film of area `new`, if a coating asks for `resolution` and has films of the areas
/// `others` besides.
pub(super) fn share(resolution: FilmResolution, new: &[f64], others: &[f64]) -> Vec<FilmResolution> {
    match resolution {
        FilmResolution::Triangles(budget) => {
            let areas = [new, others].concat();
            let shares = share_triangles(budget, &areas).into_iter();
            // A budget that cannot be met is told as such, not as the least share of it.
            let told = |share| FilmResolution::Triangles(if budget < 4 { budget } else { share });
            shares.take(new.len()).map(told).collect()
        }
        other => vec![other; new.len()],
    }
}
