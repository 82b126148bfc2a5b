//! Finds the event that a new one overwrites.

use std::collections::BTreeMap;

use super::event::Event;
use crate::film::Topology;

/// Entries of a log that a later event at the same step may overwrite. They end with a tear, a cut or a touch: what
/// these do depends on what was before them.
#[derive(Clone, Debug, Default)]
pub struct Recent {
    step: u64,
    /// Place in the log of the entry that set each thing.
    places: BTreeMap<Thing, usize>,
}

/// What an event sets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Thing {
    Settings,
    Environment,
    Quality,
    Exposure,
    Adhesion(u32),
    Contraction(u32),
    /// Binding of the edge that this half-edge stands for.
    Binding(u32),
}

impl Recent {
    /// Returns the place of `event`, which happens at `step`, in a log of so many entries: that of the entry that it
    /// overwrites, or the end.
    pub fn place_of(&mut self, step: u64, event: &Event, entries: usize, topology: &Topology) -> usize {
        if self.step != step {
            *self = Self { step, places: BTreeMap::new() };
        }
        let thing = match event {
            Event::Settings(_) => Thing::Settings,
            Event::Environment(_) => Thing::Environment,
            Event::Quality(_) => Thing::Quality,
            Event::Exposure(_) => Thing::Exposure,
            Event::Adhesion(v, _) => Thing::Adhesion(v.0),
            Event::Contraction(f, _) => Thing::Contraction(f.0),
            Event::Binding(h, _) if h.index() < topology.half_edge_count() => Thing::Binding(topology.edge(*h).0),
            Event::Binding(..) | Event::TearEdge(_) | Event::StripFace(_) | Event::Touch(..) => {
                self.places.clear();
                return entries;
            }
        };
        *self.places.entry(thing).or_insert(entries)
    }
}
