//! Reads Wavefront OBJ: vertices, faces of any size and shape, materials with their colours and images, and normals,
//! texture coordinates and vertex colours where they are given. The whole file is one surface.
//!
//! Crates for this take whatever index a file holds on trust, cut every face like a convex one, or do not say in which
//! line a fault is (ARCHITECTURE.md), so the few statements that matter are read here.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

mod error;
mod materials;
mod mtl;
mod normals;
mod polygon;
mod reader;
mod words;

use std::path::Path;

use super::{error::BakeError, images::Images, model::Model};
use crate::files;
use reader::Reader;

pub use error::ObjError;

/// Reads a file, and those beside it that it refers to; its mesh has the file's name.
///
/// # Errors
/// [`BakeError::Read`] or [`BakeError::Obj`].
pub fn read_file(path: &Path, images: Images) -> Result<Model, BakeError> {
    let bytes = files::read(path).map_err(|source| BakeError::Read { path: path.into(), source })?;
    let name = path.file_stem().map_or("model".into(), |stem| stem.to_string_lossy());
    let folder = path.parent().unwrap_or(Path::new(""));
    read(&bytes, &name, Some(folder), images).map_err(|source| BakeError::Obj { path: path.into(), source })
}

/// Reads the bytes of a file; `name` is its mesh's. Files it refers to are looked up in `folder`.
pub fn read(bytes: &[u8], name: &str, folder: Option<&Path>, images: Images) -> Result<Model, ObjError> {
    let mut reader = Reader::default();
    reader.read(bytes)?;
    Ok(reader.finish(name.into(), folder, images))
}

#[cfg(test)]
mod tests {
    use bevy_math::{Vec2, Vec3};

    use super::*;

    fn read(text: &str) -> Result<Model, ObjError> {
        super::read(text.as_bytes(), "test", None, Images::Load)
    }

    #[test]
    fn polygons_negative_indices_and_continued_lines() {
        let model = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 \\\n -2 -1 # quad\n").unwrap();
        let surface = &model.meshes[0].surface;
        assert_eq!(surface.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert!(surface.normals.iter().all(|&n| n == Vec3::Z));
    }

    #[test]
    fn corners_may_lack_texture_coordinates_or_normals() {
        let model = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.25 0.75\nvn 0 0 -1\nf 1/1 2//1 3\n").unwrap();
        let surface = &model.meshes[0].surface;
        assert_eq!(surface.uvs, [Vec2::new(0.25, 0.25), Vec2::ZERO, Vec2::ZERO]);
        assert_eq!(surface.normals, [Vec3::Z, Vec3::NEG_Z, Vec3::Z]);
    }

    #[test]
    fn bad_indices_name_their_line() {
        let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n";
        for face in ["f 1 2 4", "f 0 1 2", "f -4 1 2", "f 1/2 2 3", "f 1/-9223372036854775808 2 3", "f 1 2", "f 1 2 x"]
        {
            let error = read(&format!("{vertices}{face}\n")).unwrap_err().to_string();
            assert!(error.starts_with("line 5: "), "{face}: {error}");
        }
    }

    #[test]
    fn a_right_angle_is_a_crease() {
        let model = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 -1\nf 1 2 3\nf 2 1 4\n").unwrap();
        assert_eq!(model.meshes[0].surface.normals[..3], [Vec3::Z; 3]);
    }
}
