//! Names what is aged, a file or a test piece of the paper, and reads it.

use std::{
    ffi::OsStr,
    fmt,
    path::{Path, PathBuf},
};

use super::{
    error::BakeError,
    gltf::{self, GltfError},
    images::Images,
    limits::MAX_TRIANGLES,
    model::{Model, ModelMesh, Slot},
    obj::{self, ObjError},
};
use crate::remesh::sample;

/// Shape of a test piece of the paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TestPiece {
    /// A unit square.
    Plate,
    /// A quarter of a cylinder.
    Curved,
    /// A disk of radius 1.
    Disk,
}

impl TestPiece {
    /// All shapes.
    const ALL: [Self; 3] = [Self::Plate, Self::Curved, Self::Disk];

    /// Returns the name that [`Input::parse`] knows it by.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plate => "plate",
            Self::Curved => "curved",
            Self::Disk => "disk",
        }
    }

    /// Returns the fewest triangles it can have.
    pub fn least_triangles(self) -> u32 {
        match self {
            Self::Disk => 6,
            Self::Plate | Self::Curved => 2,
        }
    }
}

/// A model to be aged: a file, or a test piece of the paper.
///
/// ```
/// use bevy_coating::bake::{Images, Input, TestPiece};
///
/// let input = Input::parse("plate:200".as_ref())?;
/// assert_eq!(input, Input::Piece(TestPiece::Plate, 200));
/// let model = input.read(0, Images::Skip)?;
/// assert_eq!(model.meshes[0].surface.triangles.len(), 200);
///
/// assert_eq!(Input::parse("hydrant.glb".as_ref())?, Input::File("hydrant.glb".into()));
/// assert!(Input::parse("disk:3".as_ref()).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Input {
    /// A .glb, .gltf or .obj file.
    File(PathBuf),
    /// A test piece of exactly so many triangles.
    Piece(TestPiece, u32),
}

/// The number of triangles of a test piece is no number, or out of its range.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{count}` is no number of triangles from {least} to {MAX_TRIANGLES}")]
pub struct InputError {
    /// Text in the place of the number.
    pub count: String,
    /// Fewest triangles that the test piece can have.
    pub least: u32,
}

impl Input {
    /// Reads `plate:N`, `curved:N` or `disk:N` as a test piece of N triangles, and everything else as the path of a
    /// file.
    ///
    /// # Errors
    /// [`InputError`] for a test piece whose number of triangles makes no sense.
    pub fn parse(text: &OsStr) -> Result<Self, InputError> {
        let piece = text.to_str().and_then(|text| text.split_once(':')).and_then(|(name, count)| {
            let piece = TestPiece::ALL.into_iter().find(|piece| piece.name() == name)?;
            Some((piece, count))
        });
        let Some((piece, count)) = piece else {
            return Ok(Self::File(text.into()));
        };
        let least = piece.least_triangles();
        match count.parse() {
            Ok(n) if (least..=MAX_TRIANGLES).contains(&n) => Ok(Self::Piece(piece, n)),
            _ => Err(InputError { count: count.into(), least }),
        }
    }

    /// Reads the file, or makes the test piece that `seed` draws.
    ///
    /// # Errors
    /// [`BakeError`] if the file cannot be read, is damaged, or holds no triangles, or if no test piece has so many
    /// triangles.
    pub fn read(&self, seed: u64, images: Images) -> Result<Model, BakeError> {
        let mut model = match self {
            Self::File(path) => {
                let extension = path.extension().and_then(OsStr::to_str).map(str::to_ascii_lowercase);
                match extension.as_deref() {
                    Some("glb" | "gltf") => gltf::read_file(path, images)?,
                    Some("obj") => obj::read_file(path, images)?,
                    _ if !path.exists() => {
                        let source = std::io::ErrorKind::NotFound.into();
                        return Err(BakeError::Read { path: path.clone(), source });
                    }
                    _ => return Err(BakeError::UnknownFormat { path: path.clone() }),
                }
            }
            Self::Piece(piece, triangles) => make_piece(*piece, *triangles, seed, &self.to_string())?,
        };
        model.origin = self.to_string();
        if let Self::File(path) = self {
            model.files.push(path.clone());
        }
        if model.meshes.iter().all(|mesh| mesh.surface.triangles.is_empty()) {
            return Err(BakeError::Empty { origin: model.origin });
        }
        Ok(model)
    }
}

impl fmt::Display for Input {
    /// Writes the text that [`Input::parse`] reads.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(path) => path.display().fmt(f),
            Self::Piece(piece, triangles) => write!(f, "{}:{triangles}", piece.name()),
        }
    }
}

impl Model {
    /// Reads a model from the bytes of a .glb or .gltf file. Buffers and images that are files of their own are looked
    /// up relative to `folder`. Without a folder, or with an address that is no relative path, buffers are refused and
    /// images left where they are, with a warning.
    ///
    /// ```
    /// use bevy_coating::bake::{Images, Model};
    ///
    /// let mut positions = Vec::new();
    /// for x in [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0] {
    ///     positions.extend(x.to_le_bytes());
    /// }
    /// # use base64::{Engine, engine::general_purpose::STANDARD};
    /// # let base64 = STANDARD.encode(&positions);
    /// let json = format!(
    ///     r#"{{
    ///         "asset": {{ "version": "2.0" }},
    ///         "nodes": [{{ "name": "shard", "mesh": 0 }}],
    ///         "meshes": [{{ "primitives": [{{ "attributes": {{ "POSITION": 0 }} }}] }}],
    ///         "accessors": [{{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" }}],
    ///         "bufferViews": [{{ "buffer": 0, "byteLength": 36 }}],
    ///         "buffers": [{{ "byteLength": 36, "uri": "data:;base64,{base64}" }}]
    ///     }}"#
    /// );
    /// let model = Model::from_gltf(json.as_bytes(), None, Images::Load)?;
    /// assert_eq!(model.meshes[0].name, "shard");
    /// assert_eq!(model.meshes[0].surface.triangles.len(), 1);
    /// assert!(Model::from_gltf(b"no model", None, Images::Load).is_err());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`GltfError`] if the bytes are no usable glTF 2.0.
    pub fn from_gltf(bytes: &[u8], folder: Option<&Path>, images: Images) -> Result<Self, GltfError> {
        gltf::read(bytes, folder, images)
    }

    /// Reads a model from the bytes of an .obj file: one mesh called `name`. Its .mtl files and their images are looked
    /// up relative to `folder`; without a folder its materials are plain paint of their names, with a warning.
    ///
    /// ```
    /// use bevy_coating::bake::{Images, Model};
    ///
    /// let text = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\n";
    /// let model = Model::from_obj(text, "square", None, Images::Load)?;
    /// assert_eq!(model.materials.materials[0]["name"], "red");
    /// assert_eq!(model.meshes[0].surface.triangles, [[0, 1, 2], [0, 2, 3]]);
    /// # Ok::<(), bevy_coating::bake::ObjError>(())
    /// ```
    ///
    /// # Errors
    /// [`ObjError`] if the bytes are no usable OBJ.
    pub fn from_obj(bytes: &[u8], name: &str, folder: Option<&Path>, images: Images) -> Result<Self, ObjError> {
        obj::read(bytes, name, folder, images)
    }
}

fn make_piece(piece: TestPiece, triangles: u32, seed: u64, origin: &str) -> Result<Model, BakeError> {
    let name = piece.name().to_owned();
    let made = match piece {
        TestPiece::Plate => sample::plate(triangles, seed),
        TestPiece::Curved => sample::curved_plate(triangles, seed),
        TestPiece::Disk => sample::disk(triangles, seed),
    }
    .map_err(|source| BakeError::Build { origin: origin.into(), mesh: name.clone(), source })?;
    let mut model = Model::default();
    let material = Some(model.materials.add_plain_paint());
    let slots = vec![Slot { material, uvs: !made.surface.uvs.is_empty(), ..Slot::default() }];
    model.meshes.push(ModelMesh { name, surface: made.surface, slots, film: Some(made.film), ..ModelMesh::default() });
    Ok(model)
}
