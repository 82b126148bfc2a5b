//! What shelters one film.

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
/// Frames in a row in which something moved after which a film no longer waits for it to come to rest.
pub(super) const RESTLESS: u32 = 8;

/// What shelters one film: on its entity.
#[derive(Component, Debug, Default)]
pub(crate) struct FilmShelter {
    /// What the coating asks for.
    pub choice: Shelter,
    /// The film at rest; made when it is first needed.
    pub surface: Option<Arc<ExposedSurface>>,
    /// What the film's exposure was cast for.
    pub cast: Option<CastKey>,
    /// The cast under way and what it is for. Dropping it calls it off.
    pub under_way: Option<(Task<Exposure>, CastKey)>,
    /// What was looked at last.
    pub seen: Option<Seen>,
    /// Frames in a row in which that changed.
    pub restless: u32,
    /// Whether the exposure, or the cast under way, is that of what was looked at last.
    pub settled: bool,
    /// Whether a cast is needed that could not be begun yet.
    pub overdue: bool,
}

/// All that goes into a cast, exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Seen {
    pub revision: u64,
    pub place: Affine3A,
    pub falls: [Vec3; 2],
}

impl FilmShelter {
    /// That of a film whose exposure was cast for `key` when it was built.
    pub fn of_built(surface: Arc<ExposedSurface>, key: CastKey) -> Self {
        Self { surface: Some(surface), cast: Some(key), ..Self::default() }
    }

    /// Forgets all that was cast when the coating asks for something else.
    pub fn choose(&mut self, choice: Shelter) {
        if self.choice != choice {
            *self = Self { choice, ..Self::default() };
        }
    }

    /// Takes over a finished cast.
    pub fn finish(&mut self, stains: &mut StainFields) {
        let Some((task, _)) = &mut self.under_way else { return };
        let Some(exposure) = check_ready(task) else { return };
        stains.exposure = exposure;
        self.cast = self.under_way.take().map(|(_, key)| key);
    }

    /// Whether the film must wait before it steps under `environment`.
    ///
    /// What moves all the time is never quite up to date: then each cast is good for the steps of one frame, so that
    /// the film goes on.
    pub fn holds_back(&self, environment: &Environment) -> bool {
        let falls = falls(environment);
        if self.choice != Shelter::Scene || falls == [Vec3::ZERO; 2] {
            return false;
        }
        let is_known = |cast: &CastKey| cast.covers(falls) && (self.restless >= RESTLESS || cast.faces(falls));
        self.under_way.is_some() || self.overdue || !self.cast.as_ref().is_some_and(is_known)
    }
}
