//! Keeps what lets a step judge only a few elements of the film: predicted events and connected pieces.

use super::event_queue::{Basis, EventQueue};
use crate::film::FilmPieces;

/// Change of the forces in one step.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Rates {
    /// Adhesion that every vertex loses.
    pub adhesion_loss: f64,
    /// Adhesion that a wet vertex loses in addition; 0 while the whole film is dry.
    pub wet_adhesion_loss: f64,
    /// Contraction that every face gains.
    pub contraction_growth: f64,
    /// Exponent by which the binding of an edge decays, for each of its faces that has a torn edge.
    pub binding_decay: f64,
}

/// Predicted events and connected pieces of a film.
///
/// They only save work: all of this can be computed from the film and its forces again, and no result depends on it.
/// Therefore any two values compare as equal, so that films are compared by their state alone.
#[derive(Clone, Debug, Default)]
pub(super) struct Predictions {
    /// Change of the forces in the last step.
    pub rates: Rates,
    /// Predicted separations; the elements are vertices.
    pub separations: EventQueue,
    /// Predicted tears; the elements are the lower half-edges of edges.
    pub tears: EventQueue,
    /// Connected pieces of the film.
    pub pieces: FilmPieces,
}

impl PartialEq for Predictions {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Predictions {
    /// Begins the next step, in which forces change by `rates`.
    pub fn advance(&mut self, rates: Rates) {
        self.rates = rates;
        self.separations.advance();
        self.tears.advance();
    }

    /// Voids all predicted events, as the forces are others now: the next step judges every vertex and every edge.
    pub fn void_events(&mut self) {
        self.separations.void();
        self.tears.void();
    }

    /// Returns the numbers that predicted separations depend on.
    pub fn separation_basis(&self, gain: f32, gamma: f32) -> Basis {
        let Rates { adhesion_loss, wet_adhesion_loss, contraction_growth, .. } = self.rates;
        [adhesion_loss, wet_adhesion_loss, contraction_growth, f64::from(gain), f64::from(gamma)]
    }

    /// Returns the numbers that predicted tears depend on.
    pub fn tear_basis(&self, alpha: f32, beta: f32) -> Basis {
        [self.rates.contraction_growth, self.rates.binding_decay, f64::from(alpha), f64::from(beta), 0.0]
    }
}
