//! When to look at which vertex or edge again.

/// No place in the queue.
const NONE: u32 = u32::MAX;

/// What predictions rest on: forces change at these rates, and these settings judge them. Others make all void.
pub(super) type Basis = [f64; 5];

/// Elements of a film that may do something one day, each with a step before which it will not: the earliest that could
/// be predicted. A step then looks only at those that are due, judges each exactly, and puts off what did nothing.
///
/// So that results do not depend on predictions, these may be too early but never too late.
#[derive(Clone, Debug, Default)]
pub(super) struct EventQueue {
    /// Steps counted.
    step: u32,
    /// A binary heap of steps and elements, the earliest first. Each element is in it once at most.
    queue: Vec<(u32, u32)>,
    /// Place of each element in `queue`.
    places: Vec<u32>,
    basis: Option<Basis>,
    /// Room for what is due.
    due: Vec<u32>,
    /// How many elements were due so far.
    #[cfg(test)]
    pub looks: u64,
}

impl EventQueue {
    /// Counts a step.
    pub fn advance(&mut self) {
        self.step = self.step.saturating_add(1);
    }

    /// Whether predictions for this many elements on this basis are at hand.
    pub fn rests_on(&self, basis: Basis, elements: usize) -> bool {
        self.basis == Some(basis) && self.places.len() == elements && self.step < u32::MAX
    }

    /// Begins anew on a new basis: everything in `all` is due now.
    pub fn restart(&mut self, basis: Basis, elements: usize, all: impl Iterator<Item = u32>) -> Vec<u32> {
        self.step = 0;
        self.queue.clear();
        self.places.clear();
        self.places.resize(elements, NONE);
        self.basis = Some(basis);
        let mut due = core::mem::take(&mut self.due);
        due.clear();
        due.extend(all);
        due
    }

    /// Takes out all that is due. To be given back, for its room.
    pub fn take_due(&mut self) -> Vec<u32> {
        let mut due = core::mem::take(&mut self.due);
        due.clear();
        while let Some(&(step, element)) = self.queue.first()
            && step <= self.step
        {
            self.remove_first();
            due.push(element);
        }
        due
    }

    /// Takes back the room of [`EventQueue::take_due`] or [`EventQueue::restart`].
    pub fn give_back(&mut self, due: Vec<u32>) {
        #[cfg(test)]
        {
            self.looks += due.len() as u64;
        }
        self.due = due;
    }

    /// Looks at `element` next time, whatever was predicted. Nothing to do before the first predictions.
    pub fn touch(&mut self, element: u32) {
        self.put(element, 0);
    }

    /// Looks at `element` again after so many steps, at the next at the earliest; not at all if they are more than can
    /// be counted.
    pub fn put_off(&mut self, element: u32, steps: f64) {
        // Also for NaN: what cannot be predicted is looked at in every step.
        let steps = if steps > 1.0 { steps.ceil() } else { 1.0 };
        let step = f64::from(self.step) + steps;
        if step < f64::from(u32::MAX) {
            self.put(element, step as u32);
        }
    }

    fn put(&mut self, element: u32, step: u32) {
        let Some(&place) = self.places.get(element as usize) else { return };
        let place = if place == NONE {
            self.queue.push((step, element));
            self.queue.len() - 1
        } else {
            self.queue[place as usize].0 = step;
            place as usize
        };
        let place = self.sift_up(place, (step, element));
        self.sift_down(place, (step, element));
    }

    fn remove_first(&mut self) {
        let Some(last) = self.queue.pop() else { return };
        if let Some(&(_, first)) = self.queue.first() {
            self.places[first as usize] = NONE;
            self.sift_down(0, last);
        } else {
            self.places[last.1 as usize] = NONE;
        }
    }

    /// Moves `entry` from `place` towards the front, as far as it goes. Gives where it is then.
    fn sift_up(&mut self, mut place: usize, entry: (u32, u32)) -> usize {
        while place > 0 {
            let parent = (place - 1) / 2;
            if self.queue[parent] <= entry {
                break;
            }
            self.set(place, self.queue[parent]);
            place = parent;
        }
        self.set(place, entry);
        place
    }

    /// Moves `entry` from `place` away from the front, as far as it goes.
    fn sift_down(&mut self, mut place: usize, entry: (u32, u32)) {
        loop {
            let child = 2 * place + 1;
            let Some(&left) = self.queue.get(child) else { break };
            let (child, first) = match self.queue.get(child + 1) {
                Some(&right) if right < left => (child + 1, right),
                _ => (child, left),
            };
            if entry <= first {
                break;
            }
            self.set(place, first);
            place = child;
        }
        self.set(place, entry);
    }

    fn set(&mut self, place: usize, entry: (u32, u32)) {
        self.queue[place] = entry;
        self.places[entry.1 as usize] = place as u32;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Against a list that is searched.
        #[test]
        fn what_is_due_is_given_once_and_in_time(
            events in prop::collection::vec((0u32..20, prop_oneof![Just(None), (0u32..15).prop_map(Some)], any::<bool>()), 1..300)
        ) {
            let mut queue = EventQueue::default();
            queue.restart([0.0; 5], 20, 0..0);
            let (mut step, mut expected) = (0, [None; 20]);
            for (element, steps, advance) in events {
                match steps {
                    Some(steps) => {
                        queue.put_off(element, f64::from(steps) - 0.5);
                        expected[element as usize] = Some(step + steps.max(1));
                    }
                    None => {
                        queue.touch(element);
                        expected[element as usize] = Some(0);
                    }
                }
                if advance {
                    step += 1;
                    queue.advance();
                }
                let mut due = queue.take_due();
                due.sort_unstable();
                let now: Vec<u32> = (0..20).filter(|&e| expected[e as usize].is_some_and(|at| at <= step)).collect();
                prop_assert_eq!(&due, &now);
                for e in now {
                    expected[e as usize] = None;
                }
                queue.give_back(due);
                prop_assert_eq!(queue.queue.len(), expected.iter().flatten().count());
            }
        }
    }

    #[test]
    fn what_never_comes_takes_no_room_and_what_is_unknown_comes_next() {
        let mut queue = EventQueue::default();
        queue.touch(3);
        assert!(queue.take_due().is_empty(), "nothing is predicted yet");
        queue.restart([0.0; 5], 4, 0..0);
        queue.put_off(0, f64::INFINITY);
        queue.put_off(1, 1e10);
        assert!(queue.queue.is_empty());
        queue.put_off(2, f64::NAN);
        queue.put_off(3, -5.0);
        assert!(queue.take_due().is_empty());
        queue.advance();
        assert_eq!(queue.take_due(), [2, 3]);
    }
}
