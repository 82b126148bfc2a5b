//! The resolution that is asked of the films of a coating.

use std::ops::RangeInclusive;

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::ReflectDefault;

use super::target::FilmTarget;
use crate::surface::BuildError;

/// Mean edge of a film by default, in grains.
pub const DEFAULT_GRAIN_SHARE: f32 = 0.7;
/// Highest number of triangles of all films of a coating together, by default.
pub const DEFAULT_MAX_TRIANGLES: u32 = 16_000;
/// Range of the mean edge in grains.
pub const GRAIN_SHARES: RangeInclusive<f32> = 0.1..=2.0;

/// Resolution of the films of a coating: the size of their triangles.
///
/// ```
/// use bevy_coating::remesh::FilmResolution;
///
/// assert_eq!(FilmResolution::default(), FilmResolution::Grain { share: 0.7, max_triangles: 16_000 });
/// assert!(FilmResolution::Grain { share: 5.0, max_triangles: 16_000 }.validate().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Debug, Default, Clone, PartialEq),
    type_path = "bevy_coating::remesh"
)]
pub enum FilmResolution {
    /// Remesh to a mean edge of a share of the grain, [`ScaleSettings::grain`](crate::settings::ScaleSettings::grain),
    /// as long as there are not too many triangles. The default.
    Grain {
        /// Mean edge over the grain: 0.1 to 2, default 0.7. Cracks run along edges, so they are rounder on shorter
        /// ones, and all of it costs more. Props so small that their films would have fewer than 1,000 triangles
        /// together get shorter edges, down to 0.1 grains, to keep their shape.
        share: f32,
        /// Highest number of triangles of all films of the coating together, at least 4, default 16,000. Where they
        /// would need more, they share this number by area, and their edges are longer.
        max_triangles: u32,
    },
    /// Remesh to about this number of triangles, at least 4, which all films of the coating share by area. Creases and
    /// seams may need more; the film then has a warning.
    Triangles(u32),
    /// Remesh each film to about this edge length, in metres, finite and above 0.
    EdgeLength(f32),
    /// Keep the triangles of the surface. They are only cleaned.
    Keep,
}

impl Default for FilmResolution {
    fn default() -> Self {
        Self::Grain { share: DEFAULT_GRAIN_SHARE, max_triangles: DEFAULT_MAX_TRIANGLES }
    }
}

impl FilmResolution {
    /// Checks the numbers against their ranges.
    ///
    /// # Errors
    /// [`BuildError::Resolution`] for one that is NaN or out of its range.
    pub fn validate(self) -> Result<(), BuildError> {
        match self {
            Self::Grain { share, .. } if !GRAIN_SHARES.contains(&share) => {
                Err(BuildError::Resolution { found: format!("mean edge of {share} grains"), range: "0.1 to 2 grains" })
            }
            Self::Grain { max_triangles: count, .. } | Self::Triangles(count) => {
                FilmTarget::Triangles(count).validate()
            }
            Self::EdgeLength(length) => FilmTarget::EdgeLength(length).validate(),
            Self::Keep => Ok(()),
        }
    }

    /// Returns whether the films of one coating share a number of triangles, so that each depends on the areas of all.
    pub fn is_shared(self) -> bool {
        matches!(self, Self::Grain { .. } | Self::Triangles(_))
    }
}
