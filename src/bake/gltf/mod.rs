//! Reads glTF 2.0: .glb and .gltf, with buffers in the file, at a relative path or in data URIs.
//!
//! All that is read is checked: nothing in a file can make this panic. The document is kept as the JSON it is, so that
//! what ageing does not change, and extensions nobody here knows, survive. The scene's meshes are moved into scene
//! space. Skinned and morphed meshes are taken in their bind pose, with a warning.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

mod accessor;
mod cache;
mod container;
mod coordinates;
mod document;
mod error;
mod extensions;
mod images;
mod instances;
mod mesh;
mod references;
mod scene;

#[cfg(test)]
mod tests;

use std::path::Path;

pub use error::GltfError;

use super::{
    error::BakeError,
    images::Images,
    model::{MaterialLibrary, Model},
    warning::BakeWarning,
};
use crate::files;
use container::Container;

/// Reads a file, and those beside it that it refers to.
///
/// # Errors
/// [`BakeError::Read`] or [`BakeError::Gltf`].
pub fn read_file(path: &Path, images: Images) -> Result<Model, BakeError> {
    let bytes = files::read(path).map_err(|source| BakeError::Read { path: path.into(), source })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    read(&bytes, Some(folder), images).map_err(|source| BakeError::Gltf { path: path.into(), source })
}

/// Reads the bytes of a .glb or .gltf file; files it refers to are looked up in `folder`.
pub fn read(bytes: &[u8], folder: Option<&Path>, images: Images) -> Result<Model, GltfError> {
    let container = Container::open(bytes, folder)?;
    let document = &container.document;
    let mut model = Model { copyright: document.asset.copyright.clone(), ..Model::default() };
    model.materials = MaterialLibrary {
        materials: document.materials.clone(),
        textures: document.textures.clone(),
        samplers: document.samplers.clone(),
        images: Vec::new(),
        extensions_used: document.extensions_used.clone(),
        extensions_required: document.extensions_required.clone(),
    };
    let dangling = references::drop_dangling(&mut model.materials, document.images.len());
    if dangling > 0 {
        model.warnings.push(BakeWarning::DanglingTextures { count: dangling });
    }
    scene::read_meshes(&container, &mut model)?;
    if images == Images::Load {
        // What is not written need not be sound.
        references::check(&container)?;
        model.materials.images = images::read(&container, &mut model.warnings)?;
    }
    model.files = container.files();
    model.carried = container.into_carried();
    Ok(model)
}
