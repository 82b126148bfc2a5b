//! Names the way from a coating to its films.

use bevy::ecs::{
    entity::Entity,
    hierarchy::{ChildOf, Children},
    name::Name,
    world::World,
};

use crate::sim::PathStep;

/// Returns the names on the way from `root`, which is not included, down to `entity`, which is.
pub(crate) fn path_to(world: &World, root: Entity, entity: Entity) -> Vec<PathStep<'_>> {
    let name_of = |e: Entity| world.get::<Name>(e).map_or("", Name::as_str);
    let mut path = Vec::new();
    let mut at = entity;
    while at != root {
        let Some(&ChildOf(parent)) = world.get::<ChildOf>(at) else { break };
        let name = name_of(at);
        let siblings = world.get::<Children>(parent).into_iter().flatten().copied();
        let before = siblings.take_while(|&sibling| sibling != at).filter(|&sibling| name_of(sibling) == name);
        path.push(PathStep { name, number: before.count() as u32 });
        at = parent;
    }
    path.reverse();
    path
}

/// Returns the way from `root` down to `entity` as one text, by which a saved film is found again: names with a slash
/// between them, and `#1` after the name of a second sibling that is called so.
pub(crate) fn written_path(world: &World, root: Entity, entity: Entity) -> String {
    let step = |PathStep { name, number }: &PathStep| {
        let name = name.replace('\\', "\\\\").replace('/', "\\/").replace('#', "\\#");
        if *number == 0 { name } else { format!("{name}#{number}") }
    };
    path_to(world, root, entity).iter().map(step).collect::<Vec<_>>().join("/")
}
