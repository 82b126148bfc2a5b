//! How stained surfaces look: from fields to colour, roughness, metalness and relief. The same on the CPU, for baked
//! models, as in the shader (`src/display/material/shading.wgsl`), which a test holds together.
//!
//! | surface | function | what it shows |
//! |---|---|---|
//! | paint | [`FilmShading::film`] | the prop's own look under run-off, dust and water |
//! | backs of flakes | [`FilmShading::back`] | primer into which rust creeps, and the same stains |
//! | bare metal | [`FilmShading::metal`] | steel, first rust, layered rust, and the same stains |
//!
//! Fields give how much there is at a vertex; noise in metres gives the detail below the mesh's resolution. What
//! covers a place is the field held against the noise, so that stains break up instead of fading like fog, while
//! their mean over some area stays that of the field.

mod film;
mod metal;
mod noise;
mod pattern;
mod settings;
#[cfg(test)]
mod tests;

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::ReflectDefault;
use bevy_math::Vec3;

pub use pattern::StainPattern;
pub use settings::{FilmShading, MetalShading, PrimerShading, StainShading};

/// What a place of a surface looks like: the inputs of a physically based material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceShading {
    /// Linear base colour.
    pub base_color: Vec3,
    /// 0 dielectric to 1 metal.
    pub metallic: f32,
    /// Perceptual roughness, 0 to 1.
    pub roughness: f32,
    /// Reflectance at normal incidence as Bevy's `StandardMaterial` has it: 0.5 is 4 %.
    pub reflectance: f32,
    /// Relief in metres above the surface, for normals.
    pub height: f32,
}

/// What is known of a place's stains; interpolated from [`MeshPart::stains`](super::MeshPart::stains) and
/// [`MeshPart::rest`](super::MeshPart::rest).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StainSample {
    /// Layers of rust.
    pub rust: f32,
    /// Dust, 0 to 1.
    pub dust: f32,
    /// Moisture, 0 to 1.
    pub moisture: f32,
    /// How far the metal there has rusted, 0 to 1.
    pub corrosion: f32,
    /// The place at rest, in the film's space.
    pub rest: Vec3,
    /// Unit normal of the surface there, at rest; zero if it is not known.
    pub normal: Vec3,
}

impl StainSample {
    /// The sample of one vertex of a shown part: its stains, its place at rest and its normal there.
    pub fn new([rust, dust, moisture, corrosion]: [f32; 4], rest: Vec3, normal: Vec3) -> Self {
        Self { rust, dust, moisture, corrosion, rest, normal }
    }
}

/// What kind of surface is stained.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "plugin", derive(bevy::reflect::Reflect), reflect(Default, Debug, Clone, PartialEq))]
pub enum StainPart {
    /// The front of the paint.
    #[default]
    Film,
    /// The back of the paint.
    Back,
    /// Bare metal.
    Metal,
}

impl FilmShading {
    /// The look of `part`: [`film`](Self::film), [`back`](Self::back) or [`metal`](Self::metal), which needs no `base`.
    pub fn part(&self, part: StainPart, base: SurfaceShading, s: &StainSample, p: &StainPattern) -> SurfaceShading {
        match part {
            StainPart::Film => self.film(base, s, p),
            StainPart::Back => self.back(base, s, p),
            StainPart::Metal => self.metal(s, p),
        }
    }
}
