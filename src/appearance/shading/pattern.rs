//! Places a prop's stain patterns: their direction, their offset and their finest detail.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::ReflectDefault;
use std::f32::consts::FRAC_PI_4;

use bevy_math::{Vec3, ops};

use super::noise::{Grain, Octave, grain, hash, is_too_fine, mix, smoothstep};

/// Placement of a prop's stain patterns: the direction of streaks, an offset, and the size of the finest detail.
///
/// The default has no streaks, no offset and full detail.
///
/// ```
/// use bevy_coating::appearance::shading::StainPattern;
/// use bevy_math::Vec3;
///
/// let pattern = StainPattern::new(7, Vec3::NEG_Y * 3.0);
/// assert_eq!(pattern.streaks, Vec3::NEG_Y, "only the direction counts");
/// assert_ne!(pattern.offset, StainPattern::new(8, Vec3::NEG_Y).offset, "each seed has patterns of its own");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub struct StainPattern {
    /// Direction in which stains have run, in the film's space: of unit length, or zero if nothing has run yet.
    pub streaks: Vec3,
    /// Shift of the patterns, in metres, so that props with different seeds differ.
    pub offset: Vec3,
    /// Size of the pixel, texel or vertex that is shaded, in metres: detail finer than it is averaged. 0 or more; 0,
    /// the default, keeps all detail.
    pub footprint: f32,
}

impl StainPattern {
    /// Returns the patterns of a prop with `seed` on which stains have run along `streaks`, a vector of any length or
    /// zero. The offset is at most 4 metres along each axis.
    pub fn new(seed: u64, streaks: Vec3) -> Self {
        let (low, high) = (seed as u32, (seed >> 32) as u32);
        // Small, so that fine grains keep their precision.
        let shift = |k| (hash(low, high, k) >> 8) as f32 / 16_777_216.0 * 8.0 - 4.0;
        Self { streaks: streaks.normalize_or_zero(), offset: Vec3::new(shift(1), shift(2), shift(3)), footprint: 0.0 }
    }

    /// Sets the [`footprint`](Self::footprint): detail finer than this many metres is averaged.
    ///
    /// ```
    /// use bevy_coating::appearance::shading::{FilmShading, StainPattern, StainSample};
    /// use bevy_math::Vec3;
    ///
    /// let shading = FilmShading::default();
    /// let pattern = StainPattern::new(7, Vec3::NEG_Y).with_footprint(0.5);
    /// let at = |rest| shading.metal(&StainSample { corrosion: 0.5, rest, ..StainSample::default() }, &pattern);
    /// assert_eq!(at(Vec3::ZERO), at(Vec3::X), "half a metre of rust looks the same everywhere");
    /// ```
    pub fn with_footprint(self, footprint: f32) -> Self {
        Self { footprint, ..self }
    }

    /// Returns a pattern of round grains at `rest`.
    pub(super) fn grain(&self, rest: Vec3, octaves: [Octave; 3]) -> Grain {
        let p = rest + self.offset;
        grain(octaves, self.footprint, |size| p / size)
    }

    /// Returns a pattern of grains at `rest` that are `stretch` times as long down the surface as they are wide.
    ///
    /// `normal` is the normal of the surface. If it is zero (not known) grains are long on upright surfaces only.
    pub(super) fn streak(&self, rest: Vec3, normal: Vec3, octaves: [Octave; 3], stretch: f32) -> Grain {
        if is_too_fine(octaves, self.footprint) {
            return Grain::EVEN;
        }
        let p = rest + self.offset;
        let down = self.streaks;
        let outwards = normal - down * down.dot(normal);
        let flat = outwards.length_squared() < 1e-4 || down == Vec3::ZERO;
        if flat {
            let along = down * down.dot(p);
            let across = p - along;
            return grain(octaves, self.footprint, |size| across / size + along / (size * stretch));
        }
        // The coordinate across the streaks must not change down the surface. So it is measured along a level line, on
        // one of eight upright planes, and blended where a surface faces between two of them.
        let (x, y) = level_axes(down);
        let turn = ops::atan2(outwards.dot(y), outwards.dot(x)) / FRAC_PI_4;
        let facing = |plane: f32| {
            let (sin, cos) = (ops::sin(plane * FRAC_PI_4), ops::cos(plane * FRAC_PI_4));
            let level = down.cross(x * cos + y * sin);
            let across = level * level.dot(p);
            let along = p - across;
            grain(octaves, self.footprint, |size| across / size + along / (size * stretch))
        };
        let plane = turn.floor();
        let share = smoothstep(0.25, 0.75, turn - plane);
        if share <= 0.0 {
            facing(plane)
        } else if share >= 1.0 {
            facing(plane + 1.0)
        } else {
            let (a, b) = (facing(plane), facing(plane + 1.0));
            Grain { value: mix(a.value, b.value, share), kept: mix(a.kept, b.kept, share) }
        }
    }

    /// Returns a pattern of level lines `stretch` times as long as they are wide, like the marks of brushing.
    pub(super) fn brushed(&self, rest: Vec3, octaves: [Octave; 3], stretch: f32) -> Grain {
        let p = rest + self.offset;
        let up = if self.streaks == Vec3::ZERO { Vec3::Y } else { self.streaks };
        let across = up * up.dot(p);
        let along = p - across;
        grain(octaves, self.footprint, |size| across / size + along / (size * stretch))
    }
}

/// Returns two unit vectors at right angles to `down` and each other.
fn level_axes(down: Vec3) -> (Vec3, Vec3) {
    let aside = if down.x.abs() < 0.8 { Vec3::X } else { Vec3::Z };
    let x = (aside - down * down.dot(aside)).normalize();
    (x, down.cross(x))
}
