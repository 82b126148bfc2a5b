//! Draws the initial forces of a film from its seed, and draws them again when settings change.
//!
//! Initial forces are functions of seed, settings and place. What became of them since is stored apart from them, so
//! that it stays when they are drawn again: the adhesion that a wet vertex lost, the share of the contraction that a
//! face kept, the share of its binding that an edge kept.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{adhesion::adhesion_field, forces::FilmForces};
use crate::{
    film::{FilmMesh, Topology},
    settings::{AdhesionSettings, CoatingSettings, TearingSettings},
};

/// Stream of the random numbers that choose weak edges. It keeps them independent of those that draw adhesion.
const WEAK_EDGE_STREAM: u64 = 1;

/// Seed and settings that the initial forces of a film were drawn with.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Drawn {
    /// Seed of the film.
    pub seed: u64,
    /// Bits of the settings that the adhesion was drawn with.
    adhesion: [u32; 4],
    /// Bits of the settings that the binding was drawn with.
    binding: [u32; 3],
    /// Initial contraction of every face.
    pub contraction: f32,
}

impl Drawn {
    /// Returns what is drawn with `seed` and `settings`.
    pub fn new(seed: u64, settings: &CoatingSettings) -> Self {
        let CoatingSettings { adhesion, tearing, .. } = settings;
        Self {
            seed,
            adhesion: [
                adhesion.mean.to_bits(),
                adhesion.deviation.to_bits(),
                adhesion.octaves,
                adhesion.frequency.to_bits(),
            ],
            binding: [tearing.binding, tearing.weak_probability, tearing.weak_factor].map(f32::to_bits),
            contraction: tearing.contraction,
        }
    }

    /// Returns all numbers of this, for the digest.
    pub fn numbers(&self) -> [u32; 10] {
        let [a, b, c, d] = self.adhesion;
        let [e, f, g] = self.binding;
        [self.seed as u32, (self.seed >> 32) as u32, a, b, c, d, e, f, g, self.contraction.to_bits()]
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
    fn renew(&mut self, drawn: f32) {
        if self.share == 1.0 && self.base == self.drawn {
            *self = Self::new(drawn);
        }
    }
}

impl FilmForces {
    /// Makes the initial forces those that `settings` give, if they are not: adhesion (mean, deviation, octaves and
    /// frequency), contraction, binding and weak edges.
    ///
    /// They are drawn again with the film's seed. What was lost since stays lost: the adhesion that wore off, the share
    /// of its contraction that a face beside a crack gave up, and the share of its binding that an edge there lost. So
    /// a film follows as if it had had these settings and the same cracks from the start; what has torn stays torn, and
    /// what has separated stays separated. Forces that were set by hand stay as they are. Changing settings and changing
    /// them back leaves every bit as it was.
    ///
    /// [`age_forces`](super::age_forces) calls this in every step. Where nothing has changed it takes no time; otherwise
    /// the time is proportional to the size of the film (about a millisecond for 5,000 faces).
    ///
    /// ```
    /// use bevy_coating::{
    ///     film::{FilmMesh, VertexId},
    ///     fracture::FilmForces,
    ///     settings::CoatingSettings,
    /// };
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let mut settings = CoatingSettings::default();
    /// let mut forces = FilmForces::new(&mesh, &settings, 7);
    /// let before = forces.clone();
    /// forces.set_adhesion(VertexId(2), f32::INFINITY); // a rivet
    ///
    /// settings.adhesion.mean += 1.0;
    /// forces.follow_settings(&mesh, &settings);
    /// assert!((forces.adhesion(VertexId(0)) - before.adhesion(VertexId(0)) - 1.0).abs() < 1e-6);
    /// assert_eq!(forces.adhesion(VertexId(2)), f32::INFINITY, "set by hand");
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn follow_settings(&mut self, mesh: &FilmMesh, settings: &CoatingSettings) {
        let drawn = Drawn::new(self.drawn.seed, settings);
        if drawn == self.drawn {
            return;
        }
        let before = std::mem::replace(&mut self.drawn, drawn);
        if before.adhesion != self.drawn.adhesion {
            self.draw_adhesion(mesh, &settings.adhesion);
        }
        if before.binding != self.drawn.binding {
            self.draw_bindings(&mesh.topology, &settings.tearing);
        }
        let contraction = self.drawn.contraction;
        self.contractions.iter_mut().for_each(|face| face.renew(contraction));
        self.predictions.void_events();
    }

    /// Draws the initial adhesion of every vertex but those whose adhesion was set by hand. A duplicate gets that of its
    /// original, whose place it has.
    pub(super) fn draw_adhesion(&mut self, mesh: &FilmMesh, settings: &AdhesionSettings) {
        let field = adhesion_field(&mesh.geometry.rest_positions, settings, self.drawn.seed);
        for ((adhesion, drawn), by_hand) in self.adhesion_drawn.iter_mut().zip(field).zip(&self.adhesion_by_hand) {
            if !by_hand {
                *adhesion = drawn;
            }
        }
    }

    /// Draws the initial binding of every edge but those that have torn or whose binding was set by hand.
    pub(super) fn draw_bindings(&mut self, topology: &Topology, settings: &TearingSettings) {
        let mut rng = ChaCha8Rng::seed_from_u64(self.drawn.seed);
        rng.set_stream(WEAK_EDGE_STREAM);
        let weak = settings.binding * settings.weak_factor;
        for h in topology.all_edges() {
            // Border edges never tear, so no number is drawn for them.
            let is_weak = topology.rest_twin(h).is_some() && rng.random::<f32>() < settings.weak_probability;
            if !topology.is_torn(h) {
                self.bindings[h.index()].redraw(if is_weak { weak } else { settings.binding });
            }
        }
    }
}
