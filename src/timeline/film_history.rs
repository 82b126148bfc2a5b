//! Defines [`FilmHistory`], the past of one film.

use std::sync::Arc;

use bevy::{
    ecs::component::Component,
    tasks::{Task, futures::check_ready},
};

use crate::{
    api::film_pace::FilmPace,
    deform::SolverQuality,
    history::{Conditions, Event, History, Keyframe, LogEntry, Past},
    settings::CoatingSettings,
    sim::FilmClock,
    snapshot::SnapshotError,
    stain::Exposure,
};

/// Past of a film, on the entity of the film. The plugin puts it there where the coating has a
/// [`CoatingHistory`](crate::CoatingHistory).
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{FilmHistory, prelude::*};
///
/// /// Prints how far back each film can go.
/// fn print_pasts(films: Query<(&FilmHistory, &FilmClock)>) {
///     for (history, clock) in &films {
///         info!("from age {} to {}, now {}", history.first_age(clock), history.last_age(clock), clock.age());
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, print_pasts);
/// app.update();
/// ```
#[derive(Component, Debug)]
#[component(clone_behavior = Ignore)]
pub struct FilmHistory {
    pub(super) past: Past,
    /// Conditions of the next step, as they are logged.
    pub(super) now: Conditions,
    /// The settings among them, as the film's pace has them.
    settings: Arc<CoatingSettings>,
    quality: SolverQuality,
    exposure: Exposure,
    /// Farthest step that the film has come to since something was changed.
    last: u64,
    /// Strokes that were taken back, the last one at the end, with their numbers.
    undone: Vec<(u32, Vec<LogEntry>)>,
    /// Whether the log says another past than the film has had, so that it has to be gone through again.
    rewritten: bool,
    /// Keyframe that is being written.
    writing: Option<Task<Result<Keyframe, SnapshotError>>>,
}

impl FilmHistory {
    /// Begins with a `history`, and returns the film.
    pub(crate) fn of(history: History) -> (Self, crate::sim::FilmState) {
        let History { film, now, past } = history;
        (Self::new(past, now, film.quality, film.stains.exposure.clone(), film.clock.steps), film)
    }

    /// Makes the history of a film that is at `step` under these conditions.
    pub(super) fn new(past: Past, now: Conditions, quality: SolverQuality, exposure: Exposure, step: u64) -> Self {
        let last = past.keyframes().last_step().max(past.log().last().map_or(0, |entry| entry.step)).max(step);
        let (settings, undone) = (Arc::new(now.settings.clone()), Vec::new());
        Self { settings, past, now, quality, exposure, last, undone, rewritten: false, writing: None }
    }

    /// Returns the history of a copy of the film.
    pub(crate) fn copy(&self) -> Self {
        Self {
            past: self.past.clone(),
            now: self.now.clone(),
            settings: self.settings.clone(),
            quality: self.quality,
            exposure: self.exposure.clone(),
            last: self.last,
            undone: Vec::new(),
            rewritten: self.rewritten,
            writing: None,
        }
    }

    /// Returns the age at which the history begins. `clock` is the film's.
    pub fn first_age(&self, clock: &FilmClock) -> f64 {
        let first = self.past.keyframes().steps().next().unwrap_or(clock.steps);
        FilmClock { steps: first, ..*clock }.age()
    }

    /// Returns the greatest age that the film has come to: more than its age now if it has gone back, until something
    /// changes what comes. `clock` is the film's.
    pub fn last_age(&self, clock: &FilmClock) -> f64 {
        FilmClock { steps: self.last.max(clock.steps), ..*clock }.age()
    }

    /// Returns the events that were logged, in the order in which they happened, also those that lie ahead of a film
    /// that has gone back.
    pub fn log(&self) -> &[LogEntry] {
        self.past.log()
    }

    /// Returns the memory that the kept states take, in bytes.
    pub fn keyframe_bytes(&self) -> usize {
        self.past.keyframes().bytes()
    }

    /// Sets the memory for kept states, in bytes.
    pub(super) fn set_keyframe_bytes(&mut self, bytes: usize) {
        if self.past.keyframes().budget() != bytes {
            self.past.set_keyframe_bytes(bytes);
        }
    }

    /// Logs `event`, which happens to the film at `step`.
    pub(crate) fn record(&mut self, step: u64, event: Event) {
        self.now.follow(&event);
        if matches!(event, Event::Touch(..)) {
            self.undone.clear();
        }
        self.past.record(step, event);
        self.last = step;
        // A keyframe of the future that was. One of the present is missed only.
        self.writing = None;
    }

    /// Logs the conditions of the step after `step` where they are others than before.
    pub(super) fn note(&mut self, step: u64, pace: &FilmPace, exposure: &Exposure) {
        if !Arc::ptr_eq(&self.settings, &pace.settings) {
            self.settings = pace.settings.clone();
        }
        if *self.settings != self.now.settings {
            self.record(step, Event::Settings(Box::new(CoatingSettings::clone(&pace.settings))));
        }
        if pace.environment != self.now.environment {
            self.record(step, Event::Environment(pace.environment));
        }
        if pace.quality != self.quality {
            self.quality = pace.quality;
            self.record(step, Event::Quality(pace.quality));
        }
        if *exposure != self.exposure {
            self.exposure.clone_from(exposure);
            self.record(step, Event::Exposure(exposure.clone()));
        }
    }

    /// Takes over how far the film has been with the history `other`, from which this one comes, and what was taken
    /// back in it.
    pub(super) fn has_been_at(&mut self, other: &mut Self) {
        self.last = self.last.max(other.last);
        self.undone = std::mem::take(&mut other.undone);
    }

    /// Returns the number of the last stroke that touched the film.
    pub fn last_stroke(&self) -> Option<u32> {
        self.past.last_stroke()
    }

    /// Returns the number of the stroke that was taken back last.
    pub fn last_undone(&self) -> Option<u32> {
        self.undone.last().map(|&(stroke, _)| stroke)
    }

    /// Takes back the last stroke if it is `stroke`. The film follows at once in the background.
    pub(crate) fn undo(&mut self, stroke: u32) {
        if self.past.last_stroke() == Some(stroke) {
            let taken = self.past.take_stroke(stroke);
            self.undone.push((stroke, taken));
            (self.rewritten, self.writing) = (true, None);
        }
    }

    /// Lets the stroke happen again that was taken back last, if it is `stroke`.
    pub(crate) fn redo(&mut self, stroke: u32) {
        if let Some((_, taken)) = self.undone.pop_if(|(undone, _)| *undone == stroke) {
            self.past.put_stroke(&taken);
            (self.rewritten, self.writing) = (true, None);
        }
    }

    /// Returns whether the film has to go through its log again.
    pub(super) fn is_rewritten(&self) -> bool {
        self.rewritten
    }

    /// Returns whether a film at `step` is as far as it has ever been.
    pub(super) fn is_new(&self, step: u64) -> bool {
        step >= self.last
    }

    /// Takes over the conditions that are logged at `step`, which the film has come to, and returns the edits there.
    pub(super) fn arrive(&mut self, step: u64) -> Vec<Event> {
        self.last = self.last.max(step);
        let mut edits = Vec::new();
        for event in self.past.events_at(step) {
            match event {
                Event::Settings(_) | Event::Environment(_) => {
                    self.now.follow(event);
                }
                Event::Quality(quality) => self.quality = *quality,
                Event::Exposure(exposure) => self.exposure.clone_from(exposure),
                edit => edits.push(edit.clone()),
            }
        }
        edits
    }

    /// Takes the keyframe that has been written, and returns whether one is to be begun at `step`.
    pub(super) fn is_due(&mut self, step: u64) -> bool {
        if let Some(written) = self.writing.as_mut().and_then(check_ready) {
            self.writing = None;
            match written {
                Ok(keyframe) => self.past.push(keyframe),
                Err(error) => bevy::log::warn!("a state of a film is not kept: {error}"),
            }
        }
        self.writing.is_none() && self.past.keyframes().is_due(step)
    }

    /// Begins to write a keyframe.
    pub(super) fn write(&mut self, task: Task<Result<Keyframe, SnapshotError>>) {
        self.writing = Some(task);
    }
}
