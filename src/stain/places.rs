//! Lists the places where connectivity has changed.

use crate::film::VertexId;

/// Places to be brought up to date, each once.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Places {
    list: Vec<VertexId>,
    /// Whether each original vertex is in the list.
    listed: Vec<bool>,
}

impl Places {
    /// Adds a place, unless it is in the list.
    pub fn touch(&mut self, original: VertexId) {
        if self.listed.len() <= original.index() {
            self.listed.resize(original.index() + 1, false);
        }
        if !std::mem::replace(&mut self.listed[original.index()], true) {
            self.list.push(original);
        }
    }

    /// Calls `act` with each place, in the order in which they were first added, and forgets them.
    pub fn take(&mut self, mut act: impl FnMut(VertexId)) {
        for original in self.list.drain(..) {
            self.listed[original.index()] = false;
            act(original);
        }
    }
}
