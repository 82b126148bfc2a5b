//! Reads glTF 2.0: .glb and .gltf, with buffers in the file, at a relative path or in data URIs.
//!
//! Only what ageing needs is read, and all of it is checked: nothing in a file can make this panic. Materials are kept
//! as the JSON they are, so that extensions nobody here knows survive. The scene's meshes are moved into scene
//! space. Skinned and morphed meshes are taken in their bind pose, with a warning.

mod accessor;
mod container;
mod document;
mod error;
mod images;
mod mesh;
mod scene;

#[cfg(test)]
mod tests;

use std::path::Path;

pub use error::GltfError;

use super::{
    error::BakeError,
    files,
    images::Images,
    model::{MaterialLibrary, Model},
};
use container::Container;

/// Extensions that may be required because they change nothing that is read here, or are read.
const KNOWN_EXTENSIONS: [&str; 2] = ["KHR_texture_transform", "KHR_mesh_quantization"];

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
    for name in &document.extensions_required {
        let known = KNOWN_EXTENSIONS.contains(&name.as_str())
            || name.starts_with("KHR_materials_")
            || name.starts_with("KHR_texture_")
            || name.starts_with("EXT_texture_");
        if !known {
            return Err(GltfError::Extension(name.clone()));
        }
    }
    scene::read_meshes(&container, &mut model)?;
    model.materials = MaterialLibrary {
        materials: document.materials.clone(),
        textures: document.textures.clone(),
        samplers: document.samplers.clone(),
        images: match images {
            Images::Load => images::read(&container, &mut model.warnings)?,
            Images::Skip => Vec::new(),
        },
        extensions_used: document.extensions_used.clone(),
        extensions_required: document.extensions_required.clone(),
    };
    model.files = container.files();
    Ok(model)
}
