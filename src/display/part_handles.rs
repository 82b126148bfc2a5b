//! Keeps the entities and assets of a film's parts: the backs of its flakes and the bare metal.

use bevy::{asset::Handle, ecs::entity::Entity, mesh::Mesh, pbr::StandardMaterial};

use super::{
    canvas::{StainCanvas, StainWriter},
    film_paint::FilmPaint,
    material::extension::StainedMaterial,
    outline::Outline,
};
use crate::{
    appearance::{FilmAppearance, shading::StainPart},
    mesh_reader::SlotAttributes,
};

/// Backs and metal of a film.
#[derive(Default)]
pub(super) struct PartHandles {
    /// Parts of each primitive of the prop.
    pub slots: Vec<SlotParts>,
    /// Whether the materials must follow a change of the coating.
    pub outdated: bool,
}

/// Backs and metal of one primitive, as far as they have been spawned.
#[derive(Default)]
pub(super) struct SlotParts {
    pub backs: Option<PartHandle>,
    pub metal: Option<PartHandle>,
    /// Outline of the primitive; `None` while it has no material.
    pub outline: Option<Outline>,
    /// Whether the parts must follow a change of the outline.
    pub outdated: bool,
}

/// Entity that draws a part, and its assets.
pub(super) struct PartHandle {
    pub entity: Entity,
    pub mesh: Handle<Mesh>,
    pub material: PartMaterial,
    /// Attributes of the prop that its mesh has.
    pub attributes: SlotAttributes,
    /// Stains as the mesh shows them.
    pub canvas: StainCanvas,
    /// Whether the mesh shows the part, and not a stand-in for one without triangles.
    pub shown: bool,
}

/// Material of a part.
pub(super) enum PartMaterial {
    /// Material that draws the stains in detail.
    Stained(Handle<StainedMaterial>),
    /// Material that draws the stains as vertex colours, where no other is available or the coating asks for it.
    Plain(Handle<StandardMaterial>),
}

impl PartHandles {
    /// Brings the stains that are drawn up to date with the appearance, for parts that have been spawned.
    pub fn follow_stains(&mut self, appearance: &FilmAppearance, paint: &FilmPaint, edge: f32, repainted: bool) {
        for (slot, parts) in self.slots.iter_mut().enumerate() {
            let backs = (&mut parts.backs, appearance.backs(slot), appearance.back_changes(slot));
            let metal = (&mut parts.metal, appearance.metal(slot), appearance.metal_changes(slot));
            for (kind, (handle, part, changes)) in [(StainPart::Back, backs), (StainPart::Metal, metal)] {
                if let (Some(handle), Some(part), Some(changes)) = (handle, part, changes) {
                    let carrier = handle.canvas.carrier();
                    handle.canvas.follow(part, StainWriter { part: kind, paint, carrier, edge }, changes, repainted);
                }
            }
        }
    }

    /// Takes everything that the meshes show as void, as when the film is shown at another level.
    pub fn forget(&mut self) {
        for part in self.slots.iter_mut().flat_map(|slot| [&mut slot.backs, &mut slot.metal]).flatten() {
            part.canvas.forget();
            part.shown = false;
        }
    }

    /// Returns whether `entity` draws one of the parts.
    pub fn contains(&self, entity: Entity) -> bool {
        self.entities().any(|part| part == entity)
    }

    /// Returns the entities that draw the parts.
    pub fn entities(&self) -> impl Iterator<Item = Entity> {
        self.slots.iter().flat_map(|slot| [&slot.backs, &slot.metal]).flatten().map(|part| part.entity)
    }
}
