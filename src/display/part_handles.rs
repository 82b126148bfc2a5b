//! Keeps the entities and assets of a film's parts: the backs of its flakes and the bare metal.

use bevy::{asset::Handle, ecs::entity::Entity, mesh::Mesh, pbr::StandardMaterial};

use super::material::extension::StainedMaterial;

/// Backs and metal of a film, as far as they have been spawned.
#[derive(Default)]
pub(super) struct PartHandles {
    pub backs: Option<PartHandle>,
    pub metal: Option<PartHandle>,
}

/// Entity that draws a part, and its assets.
pub(super) struct PartHandle {
    pub entity: Entity,
    pub mesh: Handle<Mesh>,
    pub material: PartMaterial,
}

/// Material of a part.
pub(super) enum PartMaterial {
    /// Material that draws the stains in detail.
    Stained(Handle<StainedMaterial>),
    /// Material that draws the stains as vertex colours, where no other is available or the coating asks for it.
    Plain(Handle<StandardMaterial>),
}

impl PartHandles {
    /// Returns whether `entity` draws one of the parts.
    pub fn contains(&self, entity: Entity) -> bool {
        [&self.backs, &self.metal].into_iter().flatten().any(|part| part.entity == entity)
    }

    /// Returns the materials that draw stains in detail.
    pub fn stained(&self) -> impl Iterator<Item = &Handle<StainedMaterial>> {
        [&self.backs, &self.metal].into_iter().flatten().filter_map(|part| match &part.material {
            PartMaterial::Stained(handle) => Some(handle),
            PartMaterial::Plain(_) => None,
        })
    }
}
