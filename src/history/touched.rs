//! Codes which elements of a film were touched, and the forces that they were given.

use std::collections::BTreeMap;

use crate::coding::{Coder, Differences, Odds};

/// Elements of one kind that were touched. A brush touches about the same ones at each of its places, in the same
/// order; and neighbours on a film have numbers near each other.
#[derive(Default)]
pub(super) struct Touched {
    /// Element that came after each one the last time, and the force that it was given.
    known: BTreeMap<u32, Known>,
    last: Option<u32>,
    force: f32,
    is_next: Odds,
    ids: Differences,
    /// Forces of elements that were touched before, and of others.
    forces: [Differences; 2],
}

#[derive(Clone, Copy, Default)]
struct Known {
    next: Option<u32>,
    force: Option<f32>,
}

impl Touched {
    /// Codes the next element, and the force that it is given.
    pub fn code<C: Coder>(&mut self, id: &mut u32, force: Option<&mut f32>, coder: &mut C) {
        let next = self.last.and_then(|last| self.known.get(&last)?.next);
        let is_next = next.is_some() && coder.bit(&mut self.is_next, next == Some(*id));
        match next {
            Some(next) if is_next => *id = next,
            _ => coder.word(&mut self.ids, id, self.last.map_or(0, |last| last.wrapping_add(1))),
        }
        if let Some(last) = self.last {
            self.known.entry(last).or_default().next = Some(*id);
        }
        self.last = Some(*id);
        if let Some(force) = force {
            let known = self.known.entry(*id).or_default();
            let [again, new] = &mut self.forces;
            let forces = if known.force.is_some() { again } else { new };
            coder.float(forces, force, known.force.unwrap_or(self.force));
            (known.force, self.force) = (Some(*force), *force);
        }
    }
}
