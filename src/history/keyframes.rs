//! Keyframes: states of a film on its way, within a budget of memory.

use std::sync::Arc;

/// Least number of steps between two keyframes: to write or restore one takes about as long as so many steps.
const LEAST_PACE: u64 = 10;

/// State of a film after so many steps.
#[derive(Clone, Debug)]
pub struct Keyframe {
    pub step: u64,
    pub state: Arc<[u8]>,
}

/// Keyframes in the order of their steps. The first is where the history begins.
#[derive(Clone, Debug)]
pub struct Keyframes {
    list: Vec<Keyframe>,
    bytes: usize,
    budget: usize,
}

impl Keyframes {
    /// Begins with `first`.
    pub fn new(first: Keyframe, budget: usize) -> Self {
        Self { bytes: first.state.len(), list: vec![first], budget }
    }

    /// Sets the budget, in bytes, and thins the keyframes as it asks.
    pub fn set_budget(&mut self, budget: usize) {
        self.budget = budget;
        self.thin();
    }

    /// Returns the number of bytes of all keyframes.
    pub fn bytes(&self) -> usize {
        self.bytes
    }

    /// Returns the first keyframe, where the history begins.
    pub fn first(&self) -> Option<&Keyframe> {
        self.list.first()
    }

    /// Returns the step of the last keyframe.
    #[cfg(feature = "plugin")]
    pub fn last_step(&self) -> u64 {
        self.list.last().map_or(0, |last| last.step)
    }

    /// Returns the steps of all keyframes, in order.
    pub fn steps(&self) -> impl Iterator<Item = u64> + '_ {
        self.list.iter().map(|keyframe| keyframe.step)
    }

    /// Returns the last keyframe at or before `step`; the first one if there is none.
    pub fn before(&self, step: u64) -> Option<&Keyframe> {
        let after = self.list.partition_point(|keyframe| keyframe.step <= step);
        self.list.get(after.saturating_sub(1))
    }

    /// Returns whether a film that has come to `step`, farther than ever, is to leave a keyframe there: so many steps
    /// after the last one that all together the budget lasts for the way so far.
    pub fn is_due(&self, step: u64) -> bool {
        let (Some(first), Some(last)) = (self.list.first(), self.list.last()) else { return false };
        // States grow with age, so the last one is the best guess of the next.
        let room = (self.budget / last.state.len().max(1)).max(1) as u64;
        let pace = step.saturating_sub(first.step).div_ceil(room).max(LEAST_PACE);
        step >= last.step.saturating_add(pace)
    }

    /// Appends a keyframe that lies after all others.
    pub fn push(&mut self, keyframe: Keyframe) {
        if self.list.last().is_none_or(|last| last.step < keyframe.step) {
            self.bytes += keyframe.state.len();
            self.list.push(keyframe);
            self.thin();
        }
    }

    /// Gives up the first keyframe, if there is another to begin with, and returns the step of that one.
    pub fn shift(&mut self) -> Option<u64> {
        let next = self.list.get(1)?.step;
        self.bytes -= self.list.remove(0).state.len();
        Some(next)
    }

    /// Returns the budget, in bytes.
    pub fn budget(&self) -> usize {
        self.budget
    }

    /// Forgets the keyframes after `step`.
    pub fn truncate(&mut self, step: u64) {
        // The first stays.
        let kept = self.list.partition_point(|keyframe| keyframe.step <= step).max(1);
        self.bytes -= self.list.drain(kept..).map(|keyframe| keyframe.state.len()).sum::<usize>();
    }

    /// Gives up keyframes until the rest are within the budget: always the one without which the gap is smallest, so
    /// that gaps are about even.
    fn thin(&mut self) {
        while self.bytes > self.budget && self.list.len() > 1 {
            let gaps = self.list.windows(3).filter_map(|three| Some(three.last()?.step - three.first()?.step));
            // With two left there is no gap between others.
            let least = gaps.enumerate().min_by_key(|&(i, gap)| (gap, i)).map_or(1, |(i, _)| i + 1);
            self.bytes -= self.list.remove(least).state.len();
        }
    }
}
