//! Checks the material of a mesh before it is coated.

use bevy::{
    asset::{AssetId, Assets},
    ecs::world::{EntityRef, World},
    pbr::{MeshMaterial3d, StandardMaterial},
    prelude::AlphaMode,
};

use super::dress::CoatedMaterial;
use crate::api::{
    assets::{Waited, loaded},
    error::CoatingFault,
};

/// Returns the prop's own standard material on `entity`.
pub(crate) fn material_of(entity: EntityRef) -> Option<AssetId<StandardMaterial>> {
    let own = entity.get::<MeshMaterial3d<StandardMaterial>>().map(|own| own.0.id());
    own.or(entity.get::<CoatedMaterial>().map(|own| own.0.id()))
}

/// Returns why one looks through the mesh of `entity`: [`CoatingFault::AlphaBlended`] or
/// [`CoatingFault::Transmissive`]. `Some(None)` for meshes that are opaque or have no standard material, `None` while
/// the material is being loaded.
///
/// # Errors
/// [`CoatingFault::MaterialNotLoaded`] if loading failed.
pub(crate) fn transparency_of(world: &World, entity: EntityRef) -> Waited<Option<CoatingFault>> {
    let worn = entity.contains::<CoatedMaterial>();
    let Some(MeshMaterial3d(handle)) = entity.get::<MeshMaterial3d<StandardMaterial>>() else {
        // The film of an entity with a stained material was taken off in this frame: it gets its own back at its end.
        return Ok((!worn).then_some(None));
    };
    if !world.contains_resource::<Assets<StandardMaterial>>() {
        return Ok(Some(None));
    }
    let Some(material) = loaded(world, handle, CoatingFault::MaterialNotLoaded)? else { return Ok(None) };
    Ok(Some(match material.alpha_mode {
        AlphaMode::Opaque | AlphaMode::Mask(_) | AlphaMode::AlphaToCoverage if material.specular_transmission > 0.0 => {
            Some(CoatingFault::Transmissive)
        }
        AlphaMode::Opaque | AlphaMode::Mask(_) | AlphaMode::AlphaToCoverage => None,
        _ => Some(CoatingFault::AlphaBlended),
    }))
}
