//! Keeps the state of one film's shelter: its last cast and the one under way.

use std::sync::Arc;

use bevy::{
    ecs::component::Component,
    math::{Affine3A, Vec3},
    tasks::{Task, futures::check_ready},
};

use super::key::{CastKey, falls};
use crate::{
    api::shelter::Shelter,
    stain::{Environment, Exposure, StainFields, exposure::ExposedSurface},
};

/// Number of successive frames with movement after which a film no longer waits for the movement to end.
pub(super) const RESTLESS: u32 = 8;

/// Shelter of one film, on the film's entity.
#[derive(Component, Debug, Default)]
#[component(clone_behavior = Ignore)]
pub(crate) struct FilmShelter {
    /// Choice of the coating.
    pub choice: Shelter,
    /// Surface of the film at rest; made when it is first needed.
    pub surface: Option<Arc<ExposedSurface>>,
    /// Conditions for which the film's exposure was cast.
    pub cast: Option<CastKey>,
    /// Cast under way and its conditions. Dropping it cancels the cast.
    pub under_way: Option<(Task<Cast>, CastKey)>,
    /// Place and weather at the last check.
    pub seen: Option<Seen>,
    /// Whether something that may shelter the film has moved, come or gone since.
    pub touched: bool,
    /// Number of successive frames in which `seen` changed, or the film was touched.
    pub restless: u32,
    /// Whether the exposure, or the cast under way, is for `seen`.
    pub settled: bool,
    /// Whether a cast is needed but could not be begun yet.
    pub overdue: bool,
    /// Number of frames for which the film has waited for its turn to begin a cast; 0 while it needs none.
    pub waited: u32,
}

/// Result of a cast.
#[derive(Debug)]
pub(crate) struct Cast {
    pub exposure: Exposure,
    /// Surface from which rays were cast.
    pub surface: Arc<ExposedSurface>,
}

/// Exact inputs of a cast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Seen {
    /// Transform of the film.
    pub place: Affine3A,
    /// Directions of rain and sun in the film's space.
    pub falls: [Vec3; 2],
}

impl FilmShelter {
    /// Returns the shelter of a film whose exposure was cast for `key` while it was built.
    pub fn of_built(surface: Arc<ExposedSurface>, key: CastKey) -> Self {
        Self { surface: Some(surface), cast: Some(key), ..Self::default() }
    }

    /// Sets the choice of the coating. A new choice discards the casts so far.
    pub fn choose(&mut self, choice: Shelter) {
        if self.choice != choice {
            *self = Self { choice, ..Self::default() };
        }
    }

    /// Writes the result of a finished cast to `stains`.
    pub fn finish(&mut self, stains: &mut StainFields) {
        let Some((task, _)) = &mut self.under_way else { return };
        let Some(Cast { exposure, surface }) = check_ready(task) else { return };
        stains.exposure = exposure;
        self.surface = Some(surface);
        self.cast = self.under_way.take().map(|(_, key)| key);
    }

    /// Returns whether the film must wait for a cast before it steps under `environment`.
    ///
    /// While things move all the time the exposure is never quite up to date. Then each finished cast serves the steps
    /// of one frame, so that the film goes on ageing.
    pub fn holds_back(&self, environment: &Environment) -> bool {
        let falls = falls(environment);
        if self.choice != Shelter::Scene || falls == [Vec3::ZERO; 2] {
            return false;
        }
        let is_known = |cast: &CastKey| cast.covers(falls) && (self.restless >= RESTLESS || cast.faces(falls));
        self.under_way.is_some() || self.overdue || !self.cast.as_ref().is_some_and(is_known)
    }
}
