//! Checks the material of a mesh before it is coated.

use bevy::{
    asset::Assets,
    ecs::world::{EntityRef, World},
    pbr::{MeshMaterial3d, StandardMaterial},
    prelude::AlphaMode,
};

use super::dress::CoatedMaterial;
use crate::api::{assets::loaded, error::CoatingFault};

/// Returns whether the material of `entity` has loaded, and refuses blended materials. Meshes without a standard
/// material are ready.
///
/// # Errors
/// [`CoatingFault::AlphaBlended`], or [`CoatingFault::MaterialNotLoaded`] if loading failed.
pub(crate) fn is_material_ready(world: &World, entity: EntityRef) -> Result<bool, CoatingFault> {
    // The film of the entity was taken off in this frame; it gets its own material back at the frame's end.
    if entity.contains::<CoatedMaterial>() {
        return Ok(false);
    }
    let Some(MeshMaterial3d(handle)) = entity.get::<MeshMaterial3d<StandardMaterial>>() else { return Ok(true) };
    if !world.contains_resource::<Assets<StandardMaterial>>() {
        return Ok(true);
    }
    let Some(material) = loaded(world, handle, CoatingFault::MaterialNotLoaded)? else { return Ok(false) };
    match material.alpha_mode {
        AlphaMode::Opaque | AlphaMode::Mask(_) | AlphaMode::AlphaToCoverage => Ok(true),
        _ => Err(CoatingFault::AlphaBlended),
    }
}
