//! Draws stains on aged models. glTF has no fields and no shaders of ours, so what the game's material computes is
//! written into textures, or coarsely into vertex colours.
//!
//! ```text
//! FilmAppearance --unique?--> the prop's texture coordinates --+
//!      |                                                  +--coverage--> shading, relief --dilate--> PNG
//!      +---charts--unwrap--pack--> coordinates of our own +
//! ```
//!
//! Everything is laid out as it is at rest, so a model's textures lie the same at any age of its flakes.

mod bare;
mod boxes;
mod charts;
mod colors;
mod coverage;
mod dilate;
mod encode;
mod face;
mod finish;
mod frames;
mod kept;
mod layout;
mod pack;
mod sets;
mod sheet;
#[cfg(test)]
mod tests;
mod texture;
mod unique;
mod unwrap;

use std::borrow::Cow;

use super::{
    coat::Prop,
    model::{MaterialLibrary, Slot},
    stain_output::StainOutput,
    warning::BakeWarning,
};
use crate::{
    appearance::{
        FilmAppearance, MeshPart,
        shading::{FilmShading, StainPattern},
    },
    sim::FilmState,
};
use face::{Face, Unreadable};
use layout::textured;
use sheet::Stains;

pub use bare::Bare;
pub use encode::{Encoded, white_with_alpha};
pub use finish::Textures;
pub use kept::{move_to_second, without_baked};
pub use texture::{MAX_TEXELS, Texture};

/// A mesh primitive to be written.
pub struct Primitive<'a> {
    pub part: Cow<'a, MeshPart>,
    /// The attributes that are to be written.
    pub has: Slot,
    pub base: Base,
    pub cover: Cover,
    /// Slot of the prop; `None` for backs and metal.
    pub slot: Option<usize>,
    /// Material of the prop whose alpha mask holds for backs or metal.
    pub mask: Option<usize>,
}

/// Stuff that a primitive's material is derived from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Base {
    /// A material of the prop; `None`: the format's default.
    Own(Option<usize>),
    Primer,
    Metal,
}

impl Base {
    /// The material of the prop that it is.
    pub fn own(self) -> Option<usize> {
        if let Self::Own(own) = self { own } else { None }
    }
}

/// Change of a primitive's material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cover {
    /// It stays as it is.
    Plain,
    /// It has the textures of a sheet.
    Textures {
        /// Index into the prop's sheets.
        sheet: usize,
        /// Whether the prop's own first texture coordinates are the second ones now.
        moved: bool,
    },
    /// It is white, and vertex colours are the colour. With mean metalness and roughness.
    Colors(Option<[f32; 2]>),
}

/// One prop with its stains.
#[derive(Default)]
pub struct Dressed<'a> {
    pub primitives: Vec<Primitive<'a>>,
    pub sheets: Vec<Encoded>,
    pub warnings: Vec<BakeWarning>,
}

/// Makes the primitives of a prop. `textures` keeps the images that were decoded.
pub fn dress<'a>(
    prop: &Prop,
    film: &FilmState,
    (appearance, bare): (&'a FilmAppearance, &'a Bare),
    library: &MaterialLibrary,
    textures: &mut Textures,
    output: StainOutput,
) -> Dressed<'a> {
    let mut dressed = Dressed::default();
    let mut faces = Face::all(prop, appearance, bare);
    if output == StainOutput::None {
        dressed.primitives.extend(faces.iter().map(Face::untouched));
        return dressed;
    }
    for face in &mut faces {
        if let Err(Unreadable { material, cause }) = face.read_finish(library, textures) {
            let mesh = prop.name.clone();
            dressed.warnings.push(BakeWarning::MaterialUnreadable { mesh, material, cause });
        }
    }
    let shading = FilmShading::default();
    let stains = Stains { shading: &shading, pattern: StainPattern::new(prop.seed, film.stains.streaks) };
    match output {
        StainOutput::Textures(size) => textured(&mut dressed, &faces, prop, film, &stains, size),
        _ => {
            let footprint = film.mesh.geometry.mean_edge;
            dressed.primitives.extend(faces.iter().map(|face| face.colored(&stains, footprint)));
        }
    }
    dressed
}
