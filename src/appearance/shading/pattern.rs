//! Where on its patterns a surface lies.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::ReflectDefault;
use std::f32::consts::FRAC_PI_4;

use bevy_math::{Vec3, ops};

use super::noise::{Grain, Octave, grain, hash, mix, smoothstep};

/// How a prop's patterns lie: along what they run and which part of them it shows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance::shading"
)]
pub struct StainPattern {
    /// Direction in which stains ran, in the film's space: unit, or zero where nothing has run.
    pub streaks: Vec3,
    /// Metres by which the patterns are shifted, so that props do not look alike.
    pub offset: Vec3,
    /// Size in metres of what is shown at once: a pixel or texel. Detail below it is averaged. 0, the default, for
    /// a point.
    pub footprint: f32,
}

impl StainPattern {
    /// The patterns of a prop with `seed`, on which stains ran along `streaks`: of any length.
    pub fn new(seed: u64, streaks: Vec3) -> Self {
        let (low, high) = (seed as u32, (seed >> 32) as u32);
        // Small enough for fine grains to keep their precision.
        let shift = |k| (hash(low, high, k) >> 8) as f32 / 16_777_216.0 * 8.0 - 4.0;
        Self { streaks: streaks.normalize_or_zero(), offset: Vec3::new(shift(1), shift(2), shift(3)), footprint: 0.0 }
    }

    /// Averages detail below `footprint` metres.
    pub fn with_footprint(self, footprint: f32) -> Self {
        Self { footprint, ..self }
    }

    /// A pattern of round grains at `rest`.
    pub(super) fn grain(&self, rest: Vec3, octaves: [Octave; 3]) -> Grain {
        let p = rest + self.offset;
        grain(octaves, self.footprint, |size| p / size)
    }

    /// A pattern of grains that are `stretch` times as long down the surface at `rest` as they are wide. `normal` is
    /// that of the surface; zero if it is not known, then grains are long on upright surfaces only.
    pub(super) fn streak(&self, rest: Vec3, normal: Vec3, octaves: [Octave; 3], stretch: f32) -> Grain {
        let p = rest + self.offset;
        let down = self.streaks;
        let outwards = normal - down * down.dot(normal);
        let flat = outwards.length_squared() < 1e-4 || down == Vec3::ZERO;
        if flat {
            let along = down * down.dot(p);
            let across = p - along;
            return grain(octaves, self.footprint, |size| across / size + along / (size * stretch));
        }
        // What is across must not change down the surface. So it is measured level along the surface, on one of eight
        // upright planes, and blended where a surface faces between two of them.
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

    /// A pattern of level lines `stretch` times as long as they are wide, as brushing leaves them.
    pub(super) fn brushed(&self, rest: Vec3, octaves: [Octave; 3], stretch: f32) -> Grain {
        let p = rest + self.offset;
        let up = if self.streaks == Vec3::ZERO { Vec3::Y } else { self.streaks };
        let across = up * up.dot(p);
        let along = p - across;
        grain(octaves, self.footprint, |size| across / size + along / (size * stretch))
    }
}

/// Two axes at right angles to `down` and each other.
fn level_axes(down: Vec3) -> (Vec3, Vec3) {
    let aside = if down.x.abs() < 0.8 { Vec3::X } else { Vec3::Z };
    let x = (aside - down * down.dot(aside)).normalize();
    (x, down.cross(x))
}
