//! Keeps what the initial forces of a film were drawn with, and the contraction of a face apart from it.

use crate::{
    film::{Geometry, Grain},
    settings::CoatingSettings,
};

/// Seed and settings that the initial forces of a film were drawn with.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Drawn {
    /// Seed of the film.
    pub seed: u64,
    /// Bits of the settings that the adhesion was drawn with.
    pub adhesion: [u32; 4],
    /// Bits of the settings that the binding was drawn with.
    pub binding: [u32; 3],
    /// Initial contraction of every face.
    pub contraction: f32,
    /// Grain of the film, if it has one.
    pub grain: Option<Grain>,
}

impl Drawn {
    /// Returns what is drawn with `seed` and `settings`.
    pub fn new(seed: u64, geometry: &Geometry, settings: &CoatingSettings) -> Self {
        let CoatingSettings { adhesion, tearing, scale, .. } = settings;
        let grain = scale.grain_of(geometry);
        Self {
            seed,
            adhesion: [
                adhesion.mean.to_bits(),
                adhesion.deviation.to_bits(),
                adhesion.octaves,
                if grain.is_some() { adhesion.wavelength } else { adhesion.frequency }.to_bits(),
            ],
            binding: [tearing.binding, tearing.weak_probability, tearing.weak_factor].map(f32::to_bits),
            contraction: tearing.contraction,
            grain,
        }
    }

    /// Returns all numbers of this, for the digest.
    pub fn numbers(&self) -> impl Iterator<Item = u32> {
        let [a, b, c, d] = self.adhesion;
        let [e, f, g] = self.binding;
        let numbers = [self.seed as u32, (self.seed >> 32) as u32, a, b, c, d, e, f, g, self.contraction.to_bits()];
        numbers.into_iter().chain(self.grain.map(|grain| grain.length.to_bits()))
    }
}

/// Contraction of a face, but for what all faces have gained in common.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contraction {
    /// Contraction minus what all faces have gained, for the initial contraction `drawn`.
    pub base: f32,
    /// Share of the initial contraction that the face still has: it loses some with each torn edge. 0 for a contraction
    /// set by hand.
    pub share: f32,
    /// Initial contraction for which `base` holds.
    pub drawn: f32,
}

impl Contraction {
    /// Contraction of a fresh face.
    pub fn new(drawn: f32) -> Self {
        Self { base: drawn, share: 1.0, drawn }
    }

    /// Returns the contraction minus what all faces have gained, for the initial contraction `drawn`.
    #[inline]
    pub fn less_gained(&self, drawn: f32) -> f32 {
        self.base + self.share * (drawn - self.drawn)
    }

    /// Makes this follow another initial contraction where nothing has become of it yet, so that no rounding error is
    /// left.
    pub fn renew(&mut self, drawn: f32) {
        if self.share == 1.0 && self.base == self.drawn {
            *self = Self::new(drawn);
        }
    }
}
