//! Keeps the binding of an edge, which decays without being updated in every step (VC 5.2).

use bevy_math::ops;

/// Binding of an edge. It decays by the factor `exp(-rate age)` for each of the edge's two faces that has a torn edge.
///
/// The decay that is common to all edges, the sum of rate times age, is counted once for the whole film and passed to
/// the methods; an edge stores its force and the film's decay at the time when that force held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Binding {
    /// Force when the film's decay was `since`.
    force: f32,
    /// Decay of the film at which `force` held.
    since: f32,
    /// Number of the edge's two faces that have a torn edge; 0 once the edge itself has torn.
    torn_faces: u8,
}

impl Binding {
    /// Creates a binding that does not decay yet.
    pub fn new(force: f32) -> Self {
        Self { force, since: 0.0, torn_faces: 0 }
    }

    /// Returns the force at the film's decay `decay`.
    #[inline]
    pub fn force(&self, decay: f64) -> f32 {
        if self.torn_faces == 0 {
            return self.force;
        }
        self.force * ops::exp(-f32::from(self.torn_faces) * (decay as f32 - self.since))
    }

    /// Returns how many times the film's decay counts for this edge: the number of its faces that have a torn edge.
    #[inline]
    pub fn torn_faces(&self) -> u8 {
        self.torn_faces
    }

    /// Sets the force that holds at the film's decay `decay`.
    pub fn set_force(&mut self, force: f32, decay: f64) {
        (self.force, self.since) = (force, decay as f32);
    }

    /// Sets how many of the edge's faces have a torn edge from the film's decay `decay` on. Set 0 for an edge that has
    /// torn itself: it keeps the binding that it had.
    pub fn set_torn_faces(&mut self, faces: u8, decay: f64) {
        self.set_force(self.force(decay), decay);
        self.torn_faces = faces;
    }
}
