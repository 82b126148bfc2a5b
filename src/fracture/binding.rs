//! Binding of an edge, and how it decays without being visited (VC 5.2).

use bevy_math::ops;

/// Binding of an edge. The more of its two faces have a torn edge, the faster it decays: by `exp(-rate age)` for each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Binding {
    /// Force when the film's decay was at `since`.
    force: f32,
    /// Decay of the film so far, the sum of rate times age, at which `force` held.
    since: f32,
    /// How many of the edge's two faces have a torn edge, while it is bound.
    torn_faces: u8,
}

impl Binding {
    /// A binding that does not decay.
    pub fn new(force: f32) -> Self {
        Self { force, since: 0.0, torn_faces: 0 }
    }

    /// Force when the film's decay is at `decay`.
    #[inline]
    pub fn force(&self, decay: f64) -> f32 {
        if self.torn_faces == 0 {
            return self.force;
        }
        self.force * ops::exp(-f32::from(self.torn_faces) * (decay as f32 - self.since))
    }

    /// How many of the edge's faces have a torn edge: decay in that of the film.
    #[inline]
    pub fn torn_faces(&self) -> u8 {
        self.torn_faces
    }

    /// Sets the force, at the given decay of the film.
    pub fn set_force(&mut self, force: f32, decay: f64) {
        (self.force, self.since) = (force, decay as f32);
    }

    /// Sets how many of the edge's faces have a torn edge from the given decay of the film on. 0 also for an edge that
    /// has torn itself: it keeps its last binding.
    pub fn set_torn_faces(&mut self, faces: u8, decay: f64) {
        self.set_force(self.force(decay), decay);
        self.torn_faces = faces;
    }
}
