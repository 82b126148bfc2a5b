//! What spares a step the look at the whole film.

use super::event_queue::{Basis, EventQueue};
use crate::film::FilmPieces;

/// By how much forces change in a step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rates {
    /// Adhesion that is lost everywhere.
    pub fall: f64,
    /// Adhesion that is lost on top of that where it is wet; 0 while all is dry.
    pub wet_fall: f64,
    /// Contraction that is gained.
    pub growth: f64,
    /// Decay of binding, for each face with a torn edge: the exponent.
    pub decay: f64,
}

/// What the stages know beyond the forces themselves: when to look at what again, and which faces hang together. All of
/// it can be found again by a look at the whole film, and nothing that happens depends on how it was found; so any two
/// are equal.
#[derive(Clone, Debug, Default)]
pub(super) struct Predictions {
    pub rates: Rates,
    /// Of attached vertices.
    pub separations: EventQueue,
    /// Of edges whose ends have separated, by lower half-edge.
    pub tears: EventQueue,
    pub pieces: FilmPieces,
}

impl PartialEq for Predictions {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Predictions {
    /// Counts a step in which forces change by `rates`.
    pub fn advance(&mut self, rates: Rates) {
        self.rates = rates;
        self.separations.advance();
        self.tears.advance();
    }

    /// Basis of predicted separations.
    pub fn basis_of_separations(&self, gain: f32, gamma: f32) -> Basis {
        let Rates { fall, wet_fall, growth, .. } = self.rates;
        [fall, wet_fall, growth, f64::from(gain), f64::from(gamma)]
    }

    /// Basis of predicted tears.
    pub fn basis_of_tears(&self, alpha: f32, beta: f32) -> Basis {
        [self.rates.growth, self.rates.decay, f64::from(alpha), f64::from(beta), 0.0]
    }
}
