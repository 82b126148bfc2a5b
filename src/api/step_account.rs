//! Keeps account of the steps of one film: what the clock and requests owe it, and what it has taken.

/// Account of the steps of one film.
///
/// Within a frame time runs from 0 to 1. The steps that fall due in it are a function of that time, so the frame can be
/// ended early: what all films have taken by then, they have taken in the ratio of their speeds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct StepAccount {
    /// Steps that the clock owed the film before this frame: a fraction of a step, or more if the film had to wait.
    owed: f64,
    /// Steps that a unit of age is worth to the film; 0 while time does not pass for it.
    speed: f64,
    /// Steps that the whole time of this frame is worth to the film.
    gain: f64,
    /// Steps that were requested and not taken yet.
    requested: u64,
    /// Most steps that the film may still take, which the target decides.
    left: u64,
    /// Whether the film takes the steps that the clock owes it.
    runs: bool,
    /// Whether the film takes requested steps.
    obeys: bool,
    /// Steps taken in this frame.
    taken: u64,
}

impl StepAccount {
    /// Begins a frame in which a unit of age is worth `speed` steps and the film may take `left` steps at most. Either
    /// the clock or the film may stand still.
    ///
    /// Steps beyond `left` are not owed any more, so that ageing does not leap when the target is raised later. A film
    /// that stands still keeps what it is owed.
    pub fn begin(&mut self, speed: f64, left: u64, clock_runs: bool, film_runs: bool) {
        self.runs = clock_runs && film_runs && speed > 0.0;
        self.obeys = film_runs;
        self.speed = if self.runs && left > 0 { speed } else { 0.0 };
        self.gain = 0.0;
        self.left = left;
        self.taken = 0;
        self.forget_beyond_target();
    }

    /// Requests `steps` more steps, unless the film stands still.
    pub fn request(&mut self, steps: u64) {
        if self.obeys {
            self.requested = self.requested.saturating_add(steps);
            self.forget_beyond_target();
        }
    }

    /// Returns the most age that a frame may have if the film is to take no more than `max_steps` steps in it. Half of
    /// them are for requested steps, if there are any.
    pub fn most_age(&self, max_steps: f64) -> f64 {
        let room = if self.requested > 0 { 0.5 * max_steps } else { max_steps };
        if self.speed > 0.0 { room / self.speed } else { f64::INFINITY }
    }

    /// Returns the steps that the film has to catch up with; 0 if time does not pass for it.
    pub fn backlog(&self) -> f64 {
        if self.speed > 0.0 && self.is_behind() { self.owed } else { 0.0 }
    }

    /// Returns whether the film is owed whole steps from earlier frames.
    pub fn is_behind(&self) -> bool {
        self.owed >= 1.0
    }

    /// Returns whether time passes for the film in this frame.
    pub fn is_ageing(&self) -> bool {
        self.speed > 0.0
    }

    /// Gives the film this frame's `age`.
    pub fn give(&mut self, age: f64) {
        // An infinite age is given only where every speed is 0.
        self.gain = if self.speed > 0.0 { age * self.speed } else { 0.0 };
    }

    /// Returns how many steps the clock wants the film to have taken at `time` in this frame.
    pub fn due_to_clock(&self, time: f64) -> u64 {
        // The conversion rounds down and saturates.
        if self.runs { ((self.owed + self.gain * time) as u64).min(self.left) } else { 0 }
    }

    /// Returns how many steps the film may have taken at `time` in this frame, requested ones included.
    pub fn due(&self, time: f64) -> u64 {
        let requested = if self.obeys { self.requested } else { 0 };
        self.due_to_clock(time).saturating_add(requested).min(self.left)
    }

    /// Takes a step if one is due at `time`, and returns whether it was.
    pub fn take(&mut self, time: f64) -> bool {
        let is_due = self.taken < self.due(time);
        self.taken += u64::from(is_due);
        is_due
    }

    /// Returns the number of steps taken in this frame.
    pub fn taken(&self) -> u64 {
        self.taken
    }

    /// Ends the frame at `time`. Steps that were taken count as the clock's first, then as requested ones.
    pub fn end(&mut self, time: f64) {
        let of_clock = self.taken.min(self.due_to_clock(time));
        self.owed += self.gain * time - of_clock as f64;
        self.requested = self.requested.saturating_sub(self.taken - of_clock);
        self.left -= self.taken.min(self.left);
        self.gain = 0.0;
        self.forget_beyond_target();
    }

    /// Forgets the steps that the target forbids.
    fn forget_beyond_target(&mut self) {
        self.owed = self.owed.min(self.left as f64);
        self.requested = self.requested.min(self.left);
    }
}
