//! Chooses the shading function of each kind of surface.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::ReflectDefault;

use super::{pattern::StainPattern, sample::StainSample, settings::FilmShading, surface::SurfaceShading};

/// Kind of a stained surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub enum StainPart {
    /// The front of the paint.
    #[default]
    Film,
    /// The back of the paint, on flakes that have curled.
    Back,
    /// The bare metal.
    Metal,
}

impl FilmShading {
    /// Returns the shading of a place on `part`: [`film`](Self::film), [`back`](Self::back) or [`metal`](Self::metal).
    ///
    /// `base` is the shading of the clean surface; metal does not use it.
    ///
    /// ```
    /// use bevy_coating::appearance::shading::{FilmShading, StainPart, StainPattern, StainSample};
    /// use bevy_math::Vec3;
    ///
    /// let (shading, pattern) = (FilmShading::default(), StainPattern::new(7, Vec3::NEG_Y));
    /// let (clean, primer) = (StainSample::default(), shading.primer.surface());
    /// assert_eq!(shading.part(StainPart::Back, primer, &clean, &pattern), primer);
    /// assert_eq!(shading.part(StainPart::Metal, primer, &clean, &pattern), shading.metal(&clean, &pattern));
    /// ```
    pub fn part(&self, part: StainPart, base: SurfaceShading, s: &StainSample, p: &StainPattern) -> SurfaceShading {
        match part {
            StainPart::Film => self.film(base, s, p),
            StainPart::Back => self.back(base, s, p),
            StainPart::Metal => self.metal(s, p),
        }
    }
}
