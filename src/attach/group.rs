//! Groups the meshes that share a film.

use bevy::{
    ecs::{
        entity::Entity,
        hierarchy::{ChildOf, Children},
        world::World,
    },
    mesh::Mesh3d,
    transform::components::Transform,
};

use crate::api::links::{AwaitingFilm, CoatedBy};

/// Returns the entity of the film for the mesh of `entity`, and the entities of all meshes that share it: its siblings
/// with an identity transform that also await a film, unless the parent has a mesh itself. `wanted` tells the siblings
/// that are to be coated.
pub(super) fn group_of(
    world: &World,
    entity: Entity,
    root: Entity,
    wanted: impl Fn(Entity) -> bool,
) -> (Entity, Vec<Entity>) {
    let alone = (entity, vec![entity]);
    let in_place = |e: Entity| world.get::<Transform>(e).is_some_and(|t| *t == Transform::IDENTITY);
    let Some(&ChildOf(parent)) = world.get::<ChildOf>(entity) else { return alone };
    if entity == root || !in_place(entity) || world.get::<Mesh3d>(parent).is_some() {
        return alone;
    }
    let belongs = |e: Entity| in_place(e) && world.get::<AwaitingFilm>(e).is_some_and(|a| a.root == root) && wanted(e);
    let siblings = world.get::<Children>(parent).into_iter().flatten();
    let group: Vec<Entity> = siblings.copied().filter(|&e| e != root && belongs(e)).collect();
    // A parent that carries a film already cannot carry another.
    if group.len() < 2 || world.get::<CoatedBy>(parent).is_some() { alone } else { (parent, group) }
}
