//! Queues the elements of a film by the step in which an event at them is due.

/// Place of an element that is not in the queue.
const NONE: u32 = u32::MAX;

/// Numbers that predictions depend on: the rates at which forces change, and the settings that judge them. As soon as
/// one of them changes, all predictions are void.
pub(super) type Basis = [f64; 5];

/// A step in which an element is to be judged. Events are ordered by step, then by element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Event {
    step: u32,
    element: u32,
}

/// Events that may happen at the elements (vertices or edges) of a film, ordered by the step in which they are due: the
/// earliest step in which the event can happen as far as it can be predicted.
///
/// A step judges only the elements that are due, each exactly, and schedules those again at which nothing happened. A
/// prediction may be too early but never too late, so results do not depend on predictions.
#[derive(Clone, Debug, Default)]
pub(super) struct EventQueue {
    /// Number of the current step, counted from the last restart.
    step: u32,
    /// Binary heap with the earliest event first. Each element is in it at most once.
    heap: Vec<Event>,
    /// Place of each element in `heap`; `NONE` for an element that is not in it.
    places: Vec<u32>,
    /// Numbers that the events were predicted with; `None` before the first prediction.
    basis: Option<Basis>,
    /// Buffer of the elements that are due.
    due: Vec<u32>,
    /// Number of elements that have been due so far.
    #[cfg(test)]
    pub judged: u64,
}

impl EventQueue {
    /// Begins the next step.
    pub fn advance(&mut self) {
        self.step = self.step.saturating_add(1);
    }

    /// Returns whether the queue holds predictions for `elements` elements that were made with `basis`.
    pub fn is_valid(&self, basis: Basis, elements: usize) -> bool {
        self.basis == Some(basis) && self.places.len() == elements && self.step < u32::MAX
    }

    /// Voids all predictions: all elements are due in any case when due elements are taken next.
    pub fn void(&mut self) {
        self.basis = None;
    }

    /// Empties the queue, for predictions with a new basis, and returns the elements of `all` as due. The list is to be
    /// returned by [`EventQueue::give_back`].
    pub fn restart(&mut self, basis: Basis, elements: usize, all: impl Iterator<Item = u32>) -> Vec<u32> {
        self.step = 0;
        self.heap.clear();
        self.places.clear();
        self.places.resize(elements, NONE);
        self.basis = Some(basis);
        let mut due = core::mem::take(&mut self.due);
        due.clear();
        due.extend(all);
        due
    }

    /// Removes all elements that are due from the queue and returns them. The list is to be returned by
    /// [`EventQueue::give_back`].
    pub fn take_due(&mut self) -> Vec<u32> {
        let mut due = core::mem::take(&mut self.due);
        due.clear();
        while let Some(&Event { step, element }) = self.heap.first()
            && step <= self.step
        {
            self.remove_first();
            due.push(element);
        }
        due
    }

    /// Takes back the list of [`EventQueue::take_due`] or [`EventQueue::restart`], whose memory the next step uses.
    pub fn give_back(&mut self, due: Vec<u32>) {
        #[cfg(test)]
        {
            self.judged += due.len() as u64;
        }
        self.due = due;
    }

    /// Makes `element` due the next time that due elements are taken, whatever was predicted. Does nothing before the
    /// first prediction: then all elements are due in any case.
    pub fn make_due(&mut self, element: u32) {
        self.put(Event { step: 0, element });
    }

    /// Makes `element` due after `steps` steps, rounded up, but not before the next one. An element whose step is too
    /// large to be counted is not queued.
    pub fn schedule(&mut self, element: u32, steps: f64) {
        // NaN counts as 1: an element whose event cannot be predicted is judged in every step.
        let steps = if steps > 1.0 { steps.ceil() } else { 1.0 };
        let step = f64::from(self.step) + steps;
        if step < f64::from(u32::MAX) {
            self.put(Event { step: step as u32, element });
        }
    }

    /// Queues `event`, in place of an event at the same element.
    fn put(&mut self, event: Event) {
        let Some(&place) = self.places.get(event.element as usize) else { return };
        let place = if place == NONE {
            self.heap.push(event);
            self.heap.len() - 1
        } else {
            self.heap[place as usize].step = event.step;
            place as usize
        };
        let place = self.sift_up(place, event);
        self.sift_down(place, event);
    }

    fn remove_first(&mut self) {
        let Some(last) = self.heap.pop() else { return };
        if let Some(first) = self.heap.first() {
            self.places[first.element as usize] = NONE;
            self.sift_down(0, last);
        } else {
            self.places[last.element as usize] = NONE;
        }
    }

    /// Moves `event` from `place` towards the front until no later event is before it. Returns its new place.
    fn sift_up(&mut self, mut place: usize, event: Event) -> usize {
        while place > 0 {
            let parent = (place - 1) / 2;
            if self.heap[parent] <= event {
                break;
            }
            self.set(place, self.heap[parent]);
            place = parent;
        }
        self.set(place, event);
        place
    }

    /// Moves `event` from `place` towards the end until no earlier event is after it.
    fn sift_down(&mut self, mut place: usize, event: Event) {
        loop {
            let child = 2 * place + 1;
            let Some(&left) = self.heap.get(child) else { break };
            let (child, first) = match self.heap.get(child + 1) {
                Some(&right) if right < left => (child + 1, right),
                _ => (child, left),
            };
            if event <= first {
                break;
            }
            self.set(place, first);
            place = child;
        }
        self.set(place, event);
    }

    fn set(&mut self, place: usize, event: Event) {
        self.heap[place] = event;
        self.places[event.element as usize] = place as u32;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Compares the queue with a list that is searched.
        #[test]
        fn each_element_is_due_once_and_in_its_step(
            events in prop::collection::vec(
                (0u32..20, prop_oneof![Just(None), (0u32..15).prop_map(Some)], any::<bool>()),
                1..300,
            )
        ) {
            let mut queue = EventQueue::default();
            queue.restart([0.0; 5], 20, 0..0);
            let (mut step, mut expected) = (0, [None; 20]);
            for (element, steps, advance) in events {
                match steps {
                    Some(steps) => {
                        queue.schedule(element, f64::from(steps) - 0.5);
                        expected[element as usize] = Some(step + steps.max(1));
                    }
                    None => {
                        queue.make_due(element);
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
                prop_assert_eq!(queue.heap.len(), expected.iter().flatten().count());
            }
        }
    }

    #[test]
    fn events_that_never_come_are_not_queued_and_unpredictable_ones_are_due_next() {
        let mut queue = EventQueue::default();
        queue.make_due(3);
        assert!(queue.take_due().is_empty(), "nothing is predicted yet");
        queue.restart([0.0; 5], 4, 0..0);
        queue.schedule(0, f64::INFINITY);
        queue.schedule(1, 1e10);
        assert!(queue.heap.is_empty());
        queue.schedule(2, f64::NAN);
        queue.schedule(3, -5.0);
        assert!(queue.take_due().is_empty());
        queue.advance();
        assert_eq!(queue.take_due(), [2, 3]);
    }
}
