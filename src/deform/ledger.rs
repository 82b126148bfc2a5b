//! The ledger of a film's constraints: which half-edge carries which.

pub mod saved;

use crate::film::{HalfEdgeId, words::Words};

/// Stands for no constraint, in place of its lane.
const NONE: u32 = u32::MAX;
/// Stands for a constraint that nothing moves, in place of its lane.
const PARKED: u32 = u32::MAX - 1;

/// Constraints of one kind, by the half-edge that carries them. Those that anything can move lie in a lane of the
/// packed solver; the others are parked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Carriers {
    /// Lane of the constraint that each half-edge carries, or [`NONE`], or [`PARKED`].
    lanes: Vec<u32>,
    count: usize,
}

impl Carriers {
    fn new(half_edges: usize) -> Self {
        Self { lanes: vec![NONE; half_edges], count: 0 }
    }

    /// Returns the number of constraints.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Returns whether `h` carries a constraint.
    #[inline]
    pub fn has(&self, h: HalfEdgeId) -> bool {
        self.lanes[h.index()] != NONE
    }

    /// Returns whether `h` carries a constraint that is parked.
    #[inline]
    pub fn is_parked(&self, h: HalfEdgeId) -> bool {
        self.lanes[h.index()] == PARKED
    }

    /// Returns the lane of the constraint that `h` carries, unless there is none or it is parked.
    #[inline]
    pub fn lane(&self, h: HalfEdgeId) -> Option<u32> {
        let lane = self.lanes[h.index()];
        (lane < PARKED).then_some(lane)
    }

    /// Returns the half-edges that carry a constraint, in order.
    pub fn iter(&self) -> impl Iterator<Item = HalfEdgeId> + '_ {
        self.lanes.iter().enumerate().filter(|(_, lane)| **lane != NONE).map(|(h, _)| HalfEdgeId::new(h))
    }

    /// Notes that the constraint of `h` lies in `lane`.
    #[inline]
    fn put(&mut self, h: HalfEdgeId, lane: u32) {
        self.lanes[h.index()] = lane;
    }

    /// Notes that the constraint of `h` is parked.
    fn park(&mut self, h: HalfEdgeId) {
        self.lanes[h.index()] = PARKED;
    }

    /// Adds a constraint, parked.
    fn add(&mut self, h: HalfEdgeId) {
        self.park(h);
        self.count += 1;
    }

    /// Removes the constraint of `h`. Returns whether there was one, and the lane that it leaves empty.
    fn remove(&mut self, h: HalfEdgeId) -> (bool, Option<u32>) {
        let lane = self.lane(h);
        let had = self.has(h);
        self.lanes[h.index()] = NONE;
        self.count -= usize::from(had);
        (had, lane)
    }
}

/// Constraints that a film has. Nothing is kept of one but its lane and, for a bend, its angles: all else follows
/// from the film.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ledger {
    lengths: Carriers,
    bends: Carriers,
    /// Angle at which the bend that each half-edge carries began, and its target when it was parked, in radians.
    angles: Vec<[f32; 2]>,
    /// Share of what the settings say by which the target at each half-edge narrows. Empty while all are 1.
    shares: Vec<f32>,
    /// Number of changes of which constraints there are and what they refer to.
    revision: u64,
}

impl Ledger {
    /// Makes the ledger of a film without constraints.
    pub fn new(half_edges: usize) -> Self {
        Self {
            lengths: Carriers::new(half_edges),
            bends: Carriers::new(half_edges),
            angles: vec![[0.0; 2]; half_edges],
            shares: Vec::new(),
            revision: 0,
        }
    }

    /// Returns the length constraints.
    #[inline]
    pub fn lengths(&self) -> &Carriers {
        &self.lengths
    }

    /// Returns the bend constraints.
    #[inline]
    pub fn bends(&self) -> &Carriers {
        &self.bends
    }

    /// Returns a number that is another one after every change of which constraints there are or what they refer to.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Notes that the constraints refer to other vertices.
    pub fn touch(&mut self) {
        self.revision += 1;
    }

    /// Adds a length constraint to `h`, which has none; it is parked.
    pub fn add_length(&mut self, h: HalfEdgeId) {
        self.lengths.add(h);
        self.revision += 1;
    }

    /// Adds a bend constraint to `h`, which has none, with the angle at which it began and its target (radians); it is
    /// parked.
    pub fn add_bend(&mut self, h: HalfEdgeId, angles: [f32; 2]) {
        self.angles[h.index()] = angles;
        self.bends.add(h);
        self.revision += 1;
    }

    /// Removes the length constraint of `h`, if any. Returns the lane that it leaves empty.
    pub fn remove_length(&mut self, h: HalfEdgeId) -> Option<u32> {
        let (had, lane) = self.lengths.remove(h);
        self.revision += u64::from(had);
        lane
    }

    /// Removes the bend constraint of `h`, if any. Returns the lane that it leaves empty.
    pub fn remove_bend(&mut self, h: HalfEdgeId) -> Option<u32> {
        let (had, lane) = self.bends.remove(h);
        self.revision += u64::from(had);
        lane
    }

    /// Notes that the length constraint of `h` lies in `lane`.
    pub fn put_length(&mut self, h: HalfEdgeId, lane: u32) {
        self.lengths.put(h, lane);
    }

    /// Notes that the bend constraint of `h` lies in `lane`.
    pub fn put_bend(&mut self, h: HalfEdgeId, lane: u32) {
        self.bends.put(h, lane);
    }

    /// Parks the length constraint of `h`.
    pub fn park_length(&mut self, h: HalfEdgeId) {
        self.lengths.park(h);
    }

    /// Parks the bend constraint of `h` until it gets another lane at once: its target is not kept.
    pub fn lift_bend(&mut self, h: HalfEdgeId) {
        self.bends.park(h);
    }

    /// Parks the bend constraint of `h` with its target, in radians.
    pub fn park_bend(&mut self, h: HalfEdgeId, target: f32) {
        self.angles[h.index()][1] = target;
        self.bends.park(h);
    }

    /// Returns the angle at which the bend of `h` began, in radians.
    pub fn start(&self, h: HalfEdgeId) -> f32 {
        self.angles[h.index()][0]
    }

    /// Returns the share of what the settings say by which the target at `h` narrows.
    pub fn share(&self, h: HalfEdgeId) -> f32 {
        self.shares.get(h.index()).copied().unwrap_or(1.0)
    }

    /// Sets the share of what the settings say by which the target at `h` narrows.
    pub fn set_share(&mut self, h: HalfEdgeId, share: f32) {
        self.shares.resize(self.angles.len(), 1.0);
        self.shares[h.index()] = share;
    }

    /// Appends all that decides what becomes of the constraints.
    pub fn write_state(&self, to: &mut Words) {
        // The revision only tells the plain solver when to look.
        let Self { lengths, bends, angles, shares, revision: _ } = self;
        for Carriers { lanes, count: _ } in [lengths, bends] {
            to.list(lanes.iter().copied());
        }
        to.floats(angles.as_flattened());
        if !shares.is_empty() {
            to.floats(shares);
        }
    }

    /// Returns the target of the bend of `h` when it was parked, in radians.
    pub fn parked_target(&self, h: HalfEdgeId) -> f32 {
        self.angles[h.index()][1]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::words::assert_each_counts;

    #[test]
    fn every_field_of_the_ledger_counts() {
        let changes: [fn(&mut Ledger); 7] = [
            |ledger| ledger.add_length(HalfEdgeId(1)),
            |ledger| ledger.put_length(HalfEdgeId(1), 7),
            |ledger| ledger.put_bend(HalfEdgeId(1), 7),
            |ledger| ledger.angles[1][0] = 0.5,
            |ledger| ledger.park_bend(HalfEdgeId(1), 0.5),
            |ledger| ledger.angles[2][1] = 0.5,
            |ledger| ledger.set_share(HalfEdgeId(1), 0.5),
        ];
        assert_each_counts(&Ledger::new(3), Ledger::write_state, &changes);
    }
}
