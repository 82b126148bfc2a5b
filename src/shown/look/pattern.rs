//! Where on its patterns a surface lies.

use bevy_math::Vec3;

use super::noise::{Grain, Octave, grain, hash};

/// How a prop's patterns lie: along what they run and which part of them it shows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
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

    /// A pattern of grains that are `stretch` times as long along the streaks as they are wide. The wider an octave,
    /// the more of it is spread along.
    pub(super) fn streak(&self, rest: Vec3, octaves: [Octave; 3], stretch: f32) -> Grain {
        let p = rest + self.offset;
        let along = self.streaks * self.streaks.dot(p);
        let across = p - along;
        grain(octaves, self.footprint, |size| across / size + along / (size * stretch))
    }

    /// A pattern of lines `stretch` times as long as they are wide, in two directions that no prop is aligned with.
    pub(super) fn scratches(&self, rest: Vec3, octaves: [Octave; 3], stretch: f32) -> Grain {
        let p = rest + self.offset;
        let direction = Vec3::new(0.796, 0.243, 0.554);
        let along = direction * direction.dot(p);
        let across = p - along;
        grain(octaves, self.footprint, |size| across / size + along / (size * stretch))
    }
}
