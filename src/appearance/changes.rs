//! The signal that tells display what changed on a film.

#[cfg(feature = "plugin")]
use bevy::{ecs::component::Component, reflect::prelude::*};

use crate::{film::FilmChanges, stain::StainFields};

/// Changes of a film since its appearance was last brought up to date.
///
/// Stepping [records](Self::record) every step, display [takes](Self::take) the sum. A system that edits a film by
/// itself sets what it changed; one that replaces the film's state as a whole calls [`restart`](Self::restart).
///
/// ```
/// use bevy_coating::{appearance::DisplayChanges, film::FilmChanges, stain::StainFields};
///
/// let mut changes = DisplayChanges::default();
/// changes.record(&FilmChanges { moved: true, ..FilmChanges::default() }, &StainFields::default());
/// assert!(changes.take().moved);
/// assert!(changes.is_empty());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(
    feature = "plugin",
    derive(Component, Reflect),
    component(clone_behavior = Ignore),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance"
)]
pub struct DisplayChanges {
    /// Whether vertices may have moved.
    pub moved: bool,
    /// Whether edges tore or faces were removed: corners follow other vertices, and triangles are gone.
    pub topology: bool,
    /// Whether vertices separated or were attached again, or faces were removed: other backs and other parts of the
    /// metal can be seen.
    pub exposure: bool,
    /// Whether stains look different.
    pub stains: bool,
    /// Number of times that the film's state was replaced as a whole, as when it goes back in time. An appearance of
    /// another epoch is made from nothing, so that a state that was seen before is never taken for standing still.
    pub epoch: u32,
    /// [`StainFields::revision`] that was recorded last.
    stains_revision: u32,
}

impl DisplayChanges {
    /// Returns the signal that everything changed, in the first epoch.
    pub fn everything() -> Self {
        Self { moved: true, topology: true, exposure: true, stains: true, ..Self::default() }
    }

    /// Returns the signal that everything changed, in epoch `epoch`.
    pub(super) fn everything_in(epoch: u32) -> Self {
        Self { epoch, ..Self::everything() }
    }

    /// Adds what the last step changed.
    pub fn record(&mut self, step: &FilmChanges, stains: &StainFields) {
        self.moved |= step.moved;
        self.topology |= !(step.torn.is_empty() && step.removed.is_empty());
        self.exposure |= !(step.separated.is_empty() && step.attached.is_empty() && step.removed.is_empty());
        self.stains |= self.stains_revision != stains.revision;
        self.stains_revision = stains.revision;
    }

    /// Returns the changes and begins again with none, in the same epoch.
    pub fn take(&mut self) -> Self {
        let taken = *self;
        *self = Self { epoch: self.epoch, stains_revision: self.stains_revision, ..Self::default() };
        taken
    }

    /// Returns whether nothing changed.
    pub fn is_empty(&self) -> bool {
        !(self.moved || self.topology || self.exposure || self.stains)
    }

    /// Marks everything as changed, in the same epoch. What has not changed after all is not shown again.
    pub fn mark_everything(&mut self) {
        (self.moved, self.topology, self.exposure, self.stains) = (true, true, true, true);
    }

    /// Begins another epoch, in which everything has changed.
    pub fn restart(&mut self) {
        *self = Self { epoch: self.epoch.wrapping_add(1), ..Self::everything() };
    }
}
