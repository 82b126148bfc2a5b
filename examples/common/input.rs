//! What is aged: a file, or a test piece of the paper.

use std::{ffi::OsStr, fmt, path::PathBuf};

use bevy_coating::remesh::sample;

use super::{BakeError, MAX_TRIANGLES, Model, ModelMesh, Slot, gltf, obj};

/// A test piece of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Generator {
    /// A unit square.
    Plate,
    /// A quarter of a cylinder.
    Curved,
    /// A disk of radius 1.
    Disk,
}

/// What is aged.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Input {
    /// A .glb, .gltf or .obj file.
    File(PathBuf),
    /// A test piece of exactly so many triangles.
    Piece(Generator, u32),
}

impl Input {
    /// Reads `plate:N`, `curved:N`, `disk:N`; all else is the path of a file.
    ///
    /// # Errors
    /// A message, for a test piece whose number of triangles makes no sense.
    pub fn parse(text: &OsStr) -> Result<Self, String> {
        let piece = text.to_str().and_then(|text| text.split_once(':')).and_then(|(name, count)| {
            Some((
                match name {
                    "plate" => Generator::Plate,
                    "curved" => Generator::Curved,
                    "disk" => Generator::Disk,
                    _ => return None,
                },
                count,
            ))
        });
        let Some((generator, count)) = piece else {
            return Ok(Self::File(text.into()));
        };
        let least = if generator == Generator::Disk { 6 } else { 2 };
        match count.parse() {
            Ok(n) if (least..=MAX_TRIANGLES).contains(&n) => Ok(Self::Piece(generator, n)),
            _ => Err(format!("`{count}` is no number of triangles from {least} to {MAX_TRIANGLES}")),
        }
    }
}

impl fmt::Display for Input {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path) => path.display().fmt(f),
            Self::Piece(Generator::Plate, n) => write!(f, "plate:{n}"),
            Self::Piece(Generator::Curved, n) => write!(f, "curved:{n}"),
            Self::Piece(Generator::Disk, n) => write!(f, "disk:{n}"),
        }
    }
}

/// Reads a model, or makes a test piece. `seed` draws the test piece; `images` asks for texture images too,
/// which only writing the aged model needs.
///
/// # Errors
/// [`BakeError`] if the file cannot be read, is damaged, or holds no triangles.
pub fn read(input: &Input, seed: u64, images: bool) -> Result<Model, BakeError> {
    let mut model = match input {
        Input::File(path) => {
            let extension = path.extension().and_then(OsStr::to_str).map(str::to_ascii_lowercase);
            match extension.as_deref() {
                Some("glb" | "gltf") => gltf::read(path, images)?,
                Some("obj") => obj::read(path)?,
                _ if !path.exists() => {
                    let source = std::io::ErrorKind::NotFound.into();
                    return Err(BakeError::Read { path: path.clone(), source });
                }
                _ => return Err(BakeError::UnknownFormat { path: path.clone() }),
            }
        }
        Input::Piece(generator, triangles) => piece(*generator, *triangles, seed, &input.to_string())?,
    };
    model.origin = input.to_string();
    if model.meshes.iter().all(|mesh| mesh.surface.triangles.is_empty()) {
        return Err(BakeError::Empty { origin: model.origin });
    }
    Ok(model)
}

fn piece(generator: Generator, triangles: u32, seed: u64, origin: &str) -> Result<Model, BakeError> {
    let name = origin.split(':').next().unwrap_or(origin).to_owned();
    let piece = match generator {
        Generator::Plate => sample::plate(triangles, seed),
        Generator::Curved => sample::curved_plate(triangles, seed),
        Generator::Disk => sample::disk(triangles, seed),
    }
    .map_err(|source| BakeError::Build { origin: origin.into(), mesh: name.clone(), source })?;
    let mut model = Model::default();
    let material = Some(model.materials.add_plain_paint());
    let slots = vec![Slot { material, uvs: !piece.surface.uvs.is_empty(), ..Slot::default() }];
    model.meshes.push(ModelMesh {
        name,
        surface: piece.surface,
        slots,
        film: Some(piece.film),
        ..ModelMesh::default()
    });
    Ok(model)
}
