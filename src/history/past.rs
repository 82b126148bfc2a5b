//! Keeps what is known of a film's past, without the film itself.

use std::sync::Arc;

use super::{
    conditions::Conditions,
    event::{Event, LogEntry},
    keyframes::{Keyframe, Keyframes},
    recent::Recent,
};
use crate::{
    coding::Damage,
    film::FilmMesh,
    sim::{FilmState, FreshFilm},
    snapshot::{MeshName, SnapshotError},
};

/// Past of a film: where it began, what acted on it since, and keyframes on the way.
///
/// Clones share what is large, so that one can be sent to another thread while the film goes on.
#[derive(Clone, Debug)]
pub(crate) struct Past {
    fresh: Arc<FreshFilm>,
    /// Conditions at the first keyframe.
    first: Arc<Conditions>,
    log: Arc<Vec<LogEntry>>,
    /// Memory of the log, in bytes.
    log_bytes: usize,
    /// Entries at the end of the log that others may still take the place of.
    recent: Recent,
    keyframes: Keyframes,
}

impl Past {
    /// Begins the past of `film`, which is under `conditions`, where it is now, with at most `bytes` of keyframes.
    ///
    /// # Errors
    /// [`SnapshotError::Unsaveable`] if public fields of the film were changed so that it is none any more.
    pub fn new(film: &mut FilmState, conditions: &Conditions, bytes: usize) -> Result<Self, SnapshotError> {
        let rest = film.mesh.at_rest().map_err(|_| SnapshotError::Unsaveable { part: "its mesh" })?;
        let mut fresh = FreshFilm::new(rest);
        let first = write(&mut fresh, film)?;
        Ok(Self {
            fresh: Arc::new(fresh),
            first: Arc::new(conditions.clone()),
            log: Arc::default(),
            log_bytes: 0,
            recent: Recent::default(),
            keyframes: Keyframes::new(first, bytes),
        })
    }

    /// Makes a past on `mesh` that was recorded, without its log, and the film at its beginning. `first` is the state
    /// there, from outside, and `conditions` are those there.
    ///
    /// # Errors
    /// [`Damage`] if the state is none of a film of this mesh.
    pub fn again(
        mesh: &FilmMesh,
        first: &[u8],
        conditions: &Conditions,
        bytes: usize,
    ) -> Result<(Self, FilmState), Damage> {
        let mut fresh = FreshFilm::new(mesh.at_rest().map_err(|_| Damage("its mesh"))?);
        let film = fresh.read(first, true)?;
        let first = Keyframe { step: film.clock.steps, state: first.into() };
        let past = Self {
            fresh: Arc::new(fresh),
            first: Arc::new(conditions.clone()),
            log: Arc::default(),
            log_bytes: 0,
            recent: Recent::default(),
            keyframes: Keyframes::new(first, bytes),
        };
        Ok((past, film))
    }

    /// Puts `log` in the place of the log. Its steps must not fall, and not lie before the first keyframe.
    pub fn set_log(&mut self, log: Vec<LogEntry>) {
        self.log_bytes = log.iter().map(LogEntry::bytes).sum();
        self.log = Arc::new(log);
        self.recent = Recent::default();
    }

    /// Returns the memory of the log, in bytes.
    pub fn log_bytes(&self) -> usize {
        self.log_bytes
    }

    /// Returns the conditions at the first keyframe.
    pub fn first_conditions(&self) -> &Conditions {
        &self.first
    }

    /// Returns the name of the film's mesh.
    pub fn mesh_name(&self) -> MeshName {
        MeshName::of(&self.fresh.mesh)
    }

    /// Returns all events, in the order in which they happened.
    pub fn log(&self) -> &[LogEntry] {
        &self.log
    }

    /// Returns the events at `step`.
    pub fn events_at(&self, step: u64) -> impl Iterator<Item = &Event> {
        let first = self.log.partition_point(|entry| entry.step < step);
        self.log.iter().skip(first).take_while(move |entry| entry.step == step).map(|entry| &entry.event)
    }

    /// Returns the keyframes.
    pub fn keyframes(&self) -> &Keyframes {
        &self.keyframes
    }

    /// Sets the memory for keyframes, in bytes.
    pub fn set_keyframe_bytes(&mut self, bytes: usize) {
        self.keyframes.set_budget(bytes);
    }

    /// Logs an event that happens at `step`. What was logged after that is forgotten, and so is what this event
    /// overwrites: one of its kind that touched the same before any step was taken. Where the log takes more memory
    /// than keyframes may, the past begins later: at a keyframe that covers what came before.
    pub fn record(&mut self, step: u64, event: Event) {
        self.forget_after(step);
        let log = Arc::make_mut(&mut self.log);
        let place = self.recent.place_of(step, &event, log.len(), &self.fresh.mesh.topology);
        let entry = LogEntry { step, event };
        self.log_bytes += entry.bytes();
        match log.get_mut(place) {
            Some(old) => self.log_bytes -= std::mem::replace(old, entry).bytes(),
            None => log.push(entry),
        }
        while self.log_bytes > self.keyframes.budget() && self.begin_later() {}
    }

    /// Forgets the time before the second keyframe. Returns whether there is one.
    fn begin_later(&mut self) -> bool {
        let Some(step) = self.keyframes.shift() else { return false };
        self.first = Arc::new(self.conditions_before(step));
        let forgotten = self.log.partition_point(|entry| entry.step < step);
        let forgotten = Arc::make_mut(&mut self.log).drain(..forgotten);
        self.log_bytes -= forgotten.map(|entry| entry.bytes()).sum::<usize>();
        self.recent = Recent::default();
        true
    }

    /// Returns the number of the last stroke in the log that touched the film.
    pub fn last_stroke(&self) -> Option<u32> {
        self.log.iter().rev().find_map(|entry| match entry.event {
            Event::Touch(_, stroke) => Some(stroke),
            _ => None,
        })
    }

    /// Takes the touches of `stroke` out of the log, and returns them. What came after them stays in the log, but has
    /// to be gone through again: keyframes after the first of them are forgotten.
    pub fn take_stroke(&mut self, stroke: u32) -> Vec<LogEntry> {
        let is_of_it = |entry: &LogEntry| matches!(entry.event, Event::Touch(_, of) if of == stroke);
        let taken: Vec<LogEntry> = self.log.iter().filter(|entry| is_of_it(entry)).cloned().collect();
        if let Some(first) = taken.first() {
            self.keyframes.truncate(first.step);
            let mut log = self.log.to_vec();
            log.retain(|entry| !is_of_it(entry));
            self.set_log(log);
        }
        taken
    }

    /// Puts touches back that were taken out of the log, each after what happened at its step. Those that lie before
    /// the past begins are left out.
    pub fn put_stroke(&mut self, entries: &[LogEntry]) {
        let begin = self.keyframes.steps().next().unwrap_or(0);
        let mut log = self.log.to_vec();
        for entry in entries.iter().filter(|entry| entry.step >= begin) {
            self.keyframes.truncate(entry.step);
            log.insert(log.partition_point(|other| other.step <= entry.step), entry.clone());
        }
        self.set_log(log);
    }

    /// Forgets what is known of the time after `step`.
    pub fn forget_after(&mut self, step: u64) {
        if self.log.last().is_some_and(|last| last.step > step) {
            let kept = self.log.partition_point(|entry| entry.step <= step);
            let forgotten = Arc::make_mut(&mut self.log).drain(kept..);
            self.log_bytes -= forgotten.map(|entry| entry.bytes()).sum::<usize>();
        }
        self.keyframes.truncate(step);
    }

    /// Returns the state of `film` as a keyframe.
    ///
    /// # Errors
    /// [`SnapshotError::Unsaveable`] if the film cannot be saved.
    pub fn keyframe_of(&mut self, film: &mut FilmState) -> Result<Keyframe, SnapshotError> {
        write(Arc::make_mut(&mut self.fresh), film)
    }

    /// Adds a keyframe that lies after all others.
    pub fn push(&mut self, keyframe: Keyframe) {
        self.keyframes.push(keyframe);
    }

    /// Returns whether the way to `step` leads over a keyframe for a film that is at `now`.
    pub fn leads_back(&self, now: u64, step: u64) -> bool {
        self.keyframes.before(step).is_some_and(|keyframe| step < now || keyframe.step > now)
    }

    /// Makes the film of the last keyframe at or before `step`, before the events there, and its conditions. `None` if
    /// there is no keyframe.
    ///
    /// # Errors
    /// [`SnapshotError::Inconsistent`] if the keyframe is none of this film.
    pub fn restore(&mut self, step: u64) -> Result<Option<(FilmState, Conditions)>, SnapshotError> {
        let Some(saved) = self.keyframes.before(step) else { return Ok(None) };
        let film = Arc::make_mut(&mut self.fresh).read(&saved.state, false);
        let film = film.map_err(|Damage(part)| SnapshotError::Inconsistent { part })?;
        let conditions = self.conditions_before(film.clock.steps);
        Ok(Some((film, conditions)))
    }

    /// Returns the conditions before the events at `step`.
    fn conditions_before(&self, step: u64) -> Conditions {
        let mut conditions = Conditions::clone(&self.first);
        for entry in self.log.iter().take_while(|entry| entry.step < step) {
            conditions.follow(&entry.event);
        }
        conditions
    }
}

fn write(fresh: &mut FreshFilm, film: &mut FilmState) -> Result<Keyframe, SnapshotError> {
    let state = fresh.write(film).map_err(|Damage(part)| SnapshotError::Unsaveable { part })?;
    Ok(Keyframe { step: film.clock.steps, state: state.into() })
}
