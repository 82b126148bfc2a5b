//! Keeps the binding of an edge, which decays without being updated in every step (VC 5.2).

use bevy_math::ops;

/// Binding of an edge. It decays by the factor `exp(-rate age)` for each of the edge's two faces that has a torn edge.
///
/// The decay that is common to all edges, the sum of rate times age, is counted once for the whole film and passed to
/// the methods; an edge stores the share of its binding that is left and the film's decay at the time when that held.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Binding {
    /// Force before any decay: drawn with the film's seed, or set by hand.
    pub(super) drawn: f32,
    /// Share of it that was left when the film's decay was `since`.
    pub(super) share: f32,
    /// Decay of the film at which `share` held.
    pub(super) since: f32,
    /// Number of the edge's two faces that have a torn edge; 0 once the edge itself has torn.
    pub(super) torn_faces: u8,
    /// Whether the force was set by hand, so that it does not follow settings.
    pub(super) by_hand: bool,
    /// Whether torn edges beside it make it decay.
    pub(super) decays: bool,
}

impl Binding {
    /// Creates a binding that does not decay yet.
    pub fn new(force: f32) -> Self {
        Self { drawn: force, share: 1.0, since: 0.0, torn_faces: 0, by_hand: false, decays: true }
    }

    /// Returns the force at the film's decay `decay`.
    #[inline]
    pub fn force(&self, decay: f64) -> f32 {
        let force = self.drawn * self.share;
        // An infinite force holds for ever, also where the share has vanished.
        if self.torn_faces == 0 || self.drawn == f32::INFINITY {
            return if self.drawn == f32::INFINITY { self.drawn } else { force };
        }
        force * self.decay_factor(decay)
    }

    #[inline]
    fn decay_factor(&self, decay: f64) -> f32 {
        ops::exp(-f32::from(self.torn_faces) * (decay as f32 - self.since))
    }

    /// Returns whether any force tears the edge. An infinite binding is set by hand and holds for ever.
    #[inline]
    pub fn may_tear(&self) -> bool {
        self.drawn < f32::INFINITY
    }

    /// Returns how many times the film's decay counts for this edge: the number of its faces that have a torn edge.
    #[inline]
    pub fn torn_faces(&self) -> u8 {
        self.torn_faces
    }

    /// Sets the force that holds at the film's decay `decay`, by hand.
    pub fn set_force(&mut self, force: f32, decay: f64) {
        *self = Self { drawn: force, share: 1.0, since: decay as f32, by_hand: true, ..*self };
    }

    /// Multiplies the force by `factor`, now and whatever is drawn later.
    pub fn scale(&mut self, factor: f32) {
        self.share *= factor;
    }

    /// Sets the force before any decay, unless it was set by hand.
    pub fn redraw(&mut self, force: f32) {
        if !self.by_hand {
            self.drawn = force;
        }
    }

    /// Returns whether torn edges beside this make it decay.
    pub fn decays(&self) -> bool {
        self.decays
    }

    /// Sets whether torn edges beside this make it decay from now on.
    pub fn set_decays(&mut self, decays: bool) {
        self.decays = decays;
    }

    /// Sets how many of the edge's faces have a torn edge from the film's decay `decay` on. Set 0 for an edge that has
    /// torn itself: it keeps the binding that it had.
    pub fn set_torn_faces(&mut self, faces: u8, decay: f64) {
        if self.torn_faces > 0 {
            self.share *= self.decay_factor(decay);
        }
        (self.since, self.torn_faces) = (decay as f32, faces);
    }

    /// Returns all numbers of this, for the digest.
    pub fn numbers(&self) -> [u32; 4] {
        let flags = u32::from(self.torn_faces) | u32::from(self.by_hand) << 8 | u32::from(!self.decays) << 9;
        [self.drawn.to_bits(), self.share.to_bits(), self.since.to_bits(), flags]
    }
}
