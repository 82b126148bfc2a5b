//! Turns one part of a prop into a primitive.

use std::borrow::Cow;

use bevy_math::{Mat2, Vec3};

use super::{
    Base, Cover, Primitive, Textures,
    bare::Bare,
    colors,
    finish::Finish,
    frames, kept,
    sheet::{Ground, Patch, Stains},
    unwrap::Unwrapped,
};
use crate::{
    appearance::{FilmAppearance, MeshPart, shading::PrimerShading},
    bake::{
        coat::Prop,
        model::{MaterialLibrary, Slot},
    },
};

/// A material that cannot be read.
pub struct Unreadable {
    /// Name of the material; empty if it has none.
    pub material: String,
    /// Why it cannot be read.
    pub cause: String,
}

/// A part and what it is made of.
pub struct Face<'a> {
    pub part: &'a MeshPart,
    /// The slot of the prop's surface; `None` for backs and metal.
    pub slot: Option<usize>,
    pub base: Base,
    /// Attributes of the prop's own.
    has: Slot,
    /// The prop's own shading, where there is one that can be read; of backs and metal the one whose mask holds.
    finish: Option<Finish>,
    /// Material of the prop whose mask holds for backs or metal.
    mask: Option<usize>,
    /// Whether textures that go on as they are use first, or second coordinates.
    kept: [bool; 2],
}

impl<'a> Face<'a> {
    /// All parts of a prop that have triangles: fronts, backs, metal.
    pub fn all(prop: &Prop, appearance: &'a FilmAppearance, bare: &'a Bare) -> Vec<Self> {
        let fronts = prop.slots.iter().enumerate().filter_map(|(i, &has)| {
            Some(Self {
                part: appearance.front(i)?,
                slot: Some(i),
                base: Base::Own(has.material),
                has,
                finish: None,
                mask: None,
                kept: [false; 2],
            })
        });
        let bare = bare.parts().iter().map(|bare| Self {
            part: &bare.part,
            slot: None,
            base: bare.base,
            has: bare.has,
            finish: None,
            mask: bare.mask,
            kept: [false; 2],
        });
        fronts.chain(bare).filter(|face| !face.part.is_empty()).collect()
    }

    /// Reads the prop's own shading.
    pub fn read_finish(&mut self, library: &MaterialLibrary, textures: &mut Textures) -> Result<(), Unreadable> {
        let Base::Own(material) = self.base else {
            // The paint's own warning is enough.
            self.finish = self.mask.and_then(|mask| Finish::new(library, textures, Some(mask)).ok());
            return Ok(());
        };
        if let Some(material) = material.and_then(|m| library.materials.get(m)) {
            self.kept = kept::sets(&kept::without_baked(material));
        }
        let finish = Finish::new(library, textures, material).map_err(|cause| {
            let name = material.and_then(|m| library.materials.get(m)?["name"].as_str());
            Unreadable { material: name.unwrap_or_default().into(), cause }
        })?;
        self.finish = Some(finish);
        Ok(())
    }

    /// Whether textures that go on use both sets of coordinates: of these only the first can be kept beside new ones.
    pub fn needs_both_sets(&self) -> bool {
        self.kept == [true, true]
    }

    /// Whether stains can be drawn on it.
    pub fn is_readable(&self) -> bool {
        self.ground().is_some()
    }

    /// The primitive without stains.
    pub fn untouched(&self) -> Primitive<'a> {
        let part = match (self.slot, self.part.colors.is_empty()) {
            (None, false) => Cow::Owned(MeshPart { colors: self.white(), ..self.part.clone() }),
            _ => Cow::Borrowed(self.part),
        };
        self.primitive(part, self.has, Cover::Plain)
    }

    fn primitive<'b>(&self, part: Cow<'b, MeshPart>, has: Slot, cover: Cover) -> Primitive<'b> {
        Primitive { part, has, base: self.base, cover, slot: self.slot, mask: self.mask }
    }

    /// White with the prop's own alpha.
    fn white(&self) -> Vec<[f32; 4]> {
        self.part.colors.iter().map(|&[_, _, _, alpha]| [1.0, 1.0, 1.0, alpha]).collect()
    }

    /// The primitive with stains in its vertex colours. `footprint` is the distance of vertices, in metres.
    pub fn colored(&self, stains: &Stains, footprint: f32) -> Primitive<'a> {
        let bare = match self.ground() {
            Some(Ground::Back(primer)) => {
                colors::bare(self.part, stains, footprint, |s, p| stains.shading.back(primer, s, p))
            }
            Some(Ground::Metal) => colors::bare(self.part, stains, footprint, |s, p| stains.shading.metal(s, p)),
            Some(Ground::Film(finish)) => {
                let colors = colors::film(self.part, finish, stains, footprint);
                let part = Cow::Owned(MeshPart { colors, ..self.part.clone() });
                let cover = if finish.is_textured() { Cover::Plain } else { Cover::Colors(None) };
                return self.primitive(part, Slot { colors: true, ..self.has }, cover);
            }
            _ => return self.untouched(),
        };
        let mut colors = bare.colors;
        colors.iter_mut().zip(&self.part.colors).for_each(|(color, own)| color[3] = own[3]);
        let part = Cow::Owned(MeshPart { colors, ..self.part.clone() });
        let cover = Cover::Colors(Some([bare.metallic, bare.roughness]));
        self.primitive(part, Slot { colors: true, ..self.has }, cover)
    }

    fn ground(&self) -> Option<Ground<'_>> {
        Some(match self.base {
            Base::Own(_) => Ground::Film(self.finish.as_ref()?),
            Base::Primer => Ground::Back(PrimerShading::default().surface()),
            Base::Metal => Ground::Metal,
        })
    }

    /// Splits the part for texture coordinates of our own.
    pub fn laid_out(&'a self, unwrapped: Unwrapped) -> Option<LaidOut<'a>> {
        let part = unwrapped.split(self.part);
        let tangents = frames::tangents(&part, &unwrapped.uvs, &part.indices);
        let own = self.own_tangents(self.part);
        let own: Vec<[f32; 4]> = unwrapped.sources.iter().filter_map(|&v| own.get(v as usize).copied()).collect();
        let Unwrapped { uvs, charts, .. } = unwrapped;
        Some(LaidOut {
            face: self,
            ground: self.ground()?,
            part: Cow::Owned(part),
            uvs,
            charts,
            tangents,
            own,
            moved: true,
        })
    }

    /// Takes the prop's own texture coordinates.
    pub fn in_place(&'a self, charts: Vec<u32>) -> Option<LaidOut<'a>> {
        let tangents = match self.has.tangents {
            true => self.part.tangents.clone(),
            false => frames::tangents(self.part, &self.part.uvs, &self.part.indices),
        };
        Some(LaidOut {
            face: self,
            ground: self.ground()?,
            part: Cow::Borrowed(self.part),
            uvs: self.part.uvs.clone(),
            charts,
            tangents,
            own: Vec::new(),
            moved: false,
        })
    }

    /// Tangents of the prop's own normal texture; empty if it has none.
    fn own_tangents(&self, part: &MeshPart) -> Vec<[f32; 4]> {
        let Some(finish) = self.finish.as_ref().filter(|finish| self.slot.is_some() && finish.has_relief()) else {
            return Vec::new();
        };
        let uvs = if finish.relief_set() == 0 { &part.uvs } else { &part.uvs_1 };
        match self.has.tangents {
            true => part.tangents.clone(),
            // Without coordinates there are no directions.
            false if uvs.len() < part.positions.len() => Vec::new(),
            false => frames::tangents(part, uvs, &part.indices),
        }
    }
}

/// A part with its place in a texture.
pub struct LaidOut<'a> {
    face: &'a Face<'a>,
    ground: Ground<'a>,
    /// With the prop's own coordinates.
    part: Cow<'a, MeshPart>,
    uvs: Vec<[f32; 2]>,
    charts: Vec<u32>,
    tangents: Vec<[f32; 4]>,
    /// Tangents of the prop's own normal texture; empty: there is none, or it lies the same.
    own: Vec<[f32; 4]>,
    moved: bool,
}

impl<'a> LaidOut<'a> {
    /// Returns the patch that is drawn of it.
    pub fn patch(&self) -> Patch<'_> {
        let turn = |(i, &own): (usize, &[f32; 4])| -> Mat2 {
            frames::turn(Vec3::from(self.part.normals[i]), own, self.tangents[i])
        };
        Patch {
            ground: self.ground,
            mask: self.face.finish.as_ref().filter(|_| self.face.mask.is_some()),
            part: &self.part,
            uvs: &self.uvs,
            charts: &self.charts,
            turns: self.own.iter().enumerate().map(turn).collect(),
        }
    }

    /// The primitive, with the textures of `sheet`. Its colours are in them.
    pub fn primitive<'b>(self, sheet: usize) -> Primitive<'b> {
        let mut part = self.part.into_owned();
        let has = self.face.has;
        // The prop's other textures go on as they were. What used first coordinates finds them in the second ones.
        let [first, second] = self.face.kept;
        let moved = self.moved && first;
        if moved {
            part.uvs_1 = std::mem::take(&mut part.uvs);
        }
        part.uvs = self.uvs;
        part.tangents = self.tangents;
        let has = Slot { uvs: true, tangents: true, colors: false, uvs_1: moved || second && has.uvs_1, ..has };
        let cover = Cover::Textures { sheet, moved };
        self.face.primitive(Cow::Owned(part), has, cover)
    }
}
