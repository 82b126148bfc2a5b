//! The history of a film.

use super::{
    conditions::Conditions,
    event::{Event, LogEntry},
    past::Past,
};
use crate::{settings::CoatingSettings, sim::FilmState, snapshot::SnapshotError, stain::Environment};

/// Memory for the keyframes of a history, unless another is [set](History::set_keyframe_bytes): 16 MiB.
pub const DEFAULT_KEYFRAME_BYTES: usize = 16 << 20;

/// A film with its past: it steps on, and goes to any step that it has taken, or will take, with the same bits.
///
/// The film is changed through the history alone: by [`step`](Self::step), [`record`](Self::record) and
/// [`seek`](Self::seek). An event in the past makes another future: what was logged after it is forgotten.
///
/// ```
/// use bevy_coating::{
///     history::{Event, History},
///     remesh::sample,
///     settings::CoatingSettings,
///     sim::FilmState,
///     stain::Environment,
/// };
/// use bevy_math::Vec3;
///
/// let settings = CoatingSettings::default();
/// let piece = sample::plate(200, 7)?;
/// let film = FilmState::new(&piece.film, &settings, 7, 100).ok_or("no film")?;
/// let mut history = History::new(film, settings, Environment::default())?;
/// history.seek(40)?;
/// history.record(Event::Environment(Environment { rain: Vec3::NEG_Y, ..Environment::default() }));
/// history.seek(100)?;
/// let old = history.film().digest();
///
/// history.seek(20)?;
/// assert_eq!(history.film().clock.age(), 0.2);
/// history.seek(100)?;
/// assert_eq!(history.film().digest(), old, "it rained again from age 0.4 on");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct History {
    pub(crate) film: FilmState,
    pub(crate) now: Conditions,
    pub(crate) past: Past,
}

impl History {
    /// Begins the history of `film` where it is now, fresh or not.
    ///
    /// # Errors
    /// [`SnapshotError::Unsaveable`] if public fields of the film were changed so that it is none any more.
    pub fn new(
        mut film: FilmState,
        settings: CoatingSettings,
        environment: Environment,
    ) -> Result<Self, SnapshotError> {
        let now = Conditions { settings, environment };
        let past = Past::new(&mut film, &now, DEFAULT_KEYFRAME_BYTES)?;
        Ok(Self { film, now, past })
    }

    /// Sets the memory for keyframes, in bytes. More memory makes [`seek`](Self::seek) faster. The first keyframe stays
    /// whatever the memory, unless the log takes more than this, too: then the history begins at a later one.
    pub fn set_keyframe_bytes(&mut self, bytes: usize) {
        self.past.set_keyframe_bytes(bytes);
    }

    /// Returns the film as it is now.
    pub fn film(&self) -> &FilmState {
        &self.film
    }

    /// Returns the film as it is now, without its past.
    pub fn into_film(self) -> FilmState {
        self.film
    }

    /// Returns the settings of the next step.
    pub fn settings(&self) -> &CoatingSettings {
        &self.now.settings
    }

    /// Returns the environment of the next step.
    pub fn environment(&self) -> &Environment {
        &self.now.environment
    }

    /// Returns all events, in the order in which they happened, also those after the present step.
    pub fn log(&self) -> &[LogEntry] {
        self.past.log()
    }

    /// Returns the steps at which there are keyframes, in order.
    pub fn keyframe_steps(&self) -> impl Iterator<Item = u64> + '_ {
        self.past.keyframes().steps()
    }

    /// Returns the memory that keyframes take, in bytes.
    pub fn keyframe_bytes(&self) -> usize {
        self.past.keyframes().bytes()
    }

    /// Takes one step, with the events that were logged after it, if any were.
    ///
    /// # Errors
    /// [`SnapshotError::Unsaveable`] if a keyframe is due and the film cannot be saved; the step is taken then.
    pub fn step(&mut self) -> Result<(), SnapshotError> {
        self.film.step(&self.now.settings, &self.now.environment);
        let step = self.film.clock.steps;
        // Before the events at this step: they are applied after the keyframe is restored.
        let saved = if self.past.keyframes().is_due(step) {
            self.past.keyframe_of(&mut self.film).map(|saved| self.past.push(saved))
        } else {
            Ok(())
        };
        self.replay_events();
        saved
    }

    /// Lets `event` happen now, before the next step. What was logged after this step is forgotten, and with it the
    /// future that was. Returns whether the event changed anything; if not, it is not logged and nothing is forgotten.
    ///
    /// The log keeps one event of each kind for each thing and step: a later one takes the place of the earlier, unless
    /// an edge was torn or a face cut out in between.
    pub fn record(&mut self, event: Event) -> bool {
        let changes = self.now.apply(&mut self.film, &event);
        if changes {
            self.past.record(self.film.clock.steps, event);
        }
        changes
    }

    /// Takes back the last stroke that touched the film, as if it had never been, and returns whether there was one.
    /// All else that happened since happens again. [`redo`](Self::redo) takes what this returns.
    ///
    /// # Errors
    /// [`SnapshotError::Unsaveable`] if a keyframe is due and the film cannot be saved. The film is somewhere on the
    /// way then.
    ///
    /// ```
    /// use bevy_coating::{
    ///     film::FaceId,
    ///     history::{Event, History},
    ///     remesh::sample,
    ///     settings::CoatingSettings,
    ///     sim::FilmState,
    ///     stain::Environment,
    ///     touch::{Effect, Site, Touch},
    /// };
    /// use bevy_math::Vec3;
    ///
    /// let settings = CoatingSettings::default();
    /// let piece = sample::plate(200, 7)?;
    /// let film = FilmState::new(&piece.film, &settings, 7, 100).ok_or("no film")?;
    /// let mut history = History::new(film, settings, Environment::default())?;
    /// history.seek(30)?;
    /// let before = history.film().digest();
    /// let touch = Touch::new(Site::new(FaceId(90), Vec3::ONE), 0.2, Effect::Strip);
    /// assert!(history.record(Event::Touch(touch, 1)));
    /// let after = history.film().digest();
    ///
    /// let stroke = history.undo()?.ok_or("there was a stroke")?;
    /// assert_eq!(history.film().digest(), before);
    /// history.redo(&stroke)?;
    /// assert_eq!(history.film().digest(), after);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn undo(&mut self) -> Result<Option<Vec<LogEntry>>, SnapshotError> {
        let Some(stroke) = self.past.last_stroke() else { return Ok(None) };
        let taken = self.past.take_stroke(stroke);
        self.go_through_again()?;
        Ok(Some(taken))
    }

    /// Lets a stroke that was taken back happen again, where it happened.
    ///
    /// # Errors
    /// [`SnapshotError::Unsaveable`] if a keyframe is due and the film cannot be saved. The film is somewhere on the
    /// way then.
    pub fn redo(&mut self, stroke: &[LogEntry]) -> Result<(), SnapshotError> {
        self.past.put_stroke(stroke);
        self.go_through_again()
    }

    /// Comes to the present step again, along the log as it is now.
    fn go_through_again(&mut self) -> Result<(), SnapshotError> {
        let step = self.film.clock.steps;
        self.film.clock.steps = u64::MAX;
        self.seek(step)
    }

    /// Goes to `step`, counted as by the film's clock: back, forward, or farther than ever. Before the step at which
    /// the history begins there is nothing; it goes there then.
    ///
    /// # Errors
    /// [`SnapshotError::Unsaveable`] if a keyframe is due and the film cannot be saved. The film is somewhere on the
    /// way then.
    pub fn seek(&mut self, step: u64) -> Result<(), SnapshotError> {
        self.jump(step)?;
        while self.film.clock.steps < step {
            self.step()?;
        }
        Ok(())
    }

    /// Goes to the last keyframe at or before `step`, if the film is not nearer already.
    pub(crate) fn jump(&mut self, step: u64) -> Result<(), SnapshotError> {
        if self.past.leads_back(self.film.clock.steps, step)
            && let Some((film, now)) = self.past.restore(step)?
        {
            let scratch = std::mem::take(&mut self.film.scratch);
            (self.film, self.now) = (FilmState { scratch, ..film }, now);
            self.replay_events();
        }
        Ok(())
    }

    /// Lets the events that were logged at this step happen again.
    fn replay_events(&mut self) {
        for event in self.past.events_at(self.film.clock.steps) {
            self.now.apply(&mut self.film, event);
        }
    }
}
