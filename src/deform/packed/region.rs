//! Packs of one region of a film: constraints that lie near each other, so that their points stay in the cache.

pub mod saved;

use super::{
    level::{Kernels, SimdLevel},
    pack::{BendPack, BendTargets, LANES, LengthPack},
    point::PointOffset,
    points::{Motion, Points},
    slots::{Blocked, Slots},
};
use crate::film::words::Words;

/// Bend constraint, as a lane holds it. Lengths are in the points' unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BendLane {
    /// Vertices p1, p2, p3, p4.
    pub vertices: [u32; 4],
    /// Rest altitude over rest median of each wing.
    pub skews: [f32; 2],
    /// Square of each wing's median at rest.
    pub medians: [f32; 2],
    /// Angle at which it began, in radians.
    pub start: f32,
    /// Target angle now, in radians.
    pub target: f32,
    /// Share of what the settings say by which the target narrows.
    pub share: f32,
}

/// Length constraint, as a lane holds it. Lengths are in the points' unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthLane {
    /// The two vertices.
    pub vertices: [u32; 2],
    /// Rest length.
    pub rest: f32,
}

/// Packs of bends and lengths of one region. Owners are half-edges.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Region {
    bends: Vec<BendPack>,
    targets: Vec<BendTargets>,
    /// Whether any target of a pack may still narrow.
    narrowing: Vec<bool>,
    bend_slots: Slots,
    lengths: Vec<LengthPack>,
    length_slots: Slots,
}

impl Region {
    /// Returns the number of bends and of lengths.
    pub fn counts(&self) -> [usize; 2] {
        [self.bend_slots.live(), self.length_slots.live()]
    }

    /// Adds a bend to a pack that is not blocked. Returns its lane.
    pub fn add_bend(&mut self, owner: u32, bend: &BendLane, blocked: &Blocked, points: &Points) -> u32 {
        let (lane, begun) = self.bend_slots.claim(owner, blocked);
        if begun {
            self.bends.push(BendPack::NULL);
            self.targets.push(BendTargets::NULL);
            self.narrowing.push(true);
        }
        self.put_bend(lane, bend, points);
        lane
    }

    /// Writes a bend into a lane.
    fn put_bend(&mut self, lane: u32, bend: &BendLane, points: &Points) {
        let (pack, slot) = split(lane);
        for i in 0..2 {
            self.bends[pack].medians[i][slot] = bend.medians[i];
            self.targets[pack].skews[i][slot] = bend.skews[i];
        }
        self.targets[pack].starts[slot] = bend.start;
        self.targets[pack].targets[slot] = bend.target;
        self.targets[pack].shares[slot] = bend.share;
        // Its folds are found when the targets narrow next.
        self.narrowing[pack] = true;
        self.move_bend(lane, bend.vertices, points);
    }

    /// Adds a length to a pack that is not blocked. Returns its lane.
    pub fn add_length(&mut self, owner: u32, length: &LengthLane, blocked: &Blocked, points: &Points) -> u32 {
        let (lane, begun) = self.length_slots.claim(owner, blocked);
        if begun {
            self.lengths.push(LengthPack::NULL);
        }
        self.put_length(lane, length, points);
        lane
    }

    /// Writes a length into a lane.
    fn put_length(&mut self, lane: u32, length: &LengthLane, points: &Points) {
        let (pack, slot) = split(lane);
        self.lengths[pack].rest[slot] = length.rest;
        self.move_length(lane, length.vertices, points);
    }

    /// Sets the share by which the target of the bend in `lane` narrows.
    pub fn set_share(&mut self, lane: u32, share: f32) {
        let (pack, slot) = split(lane);
        self.targets[pack].shares[slot] = share;
        self.narrowing[pack] = true;
    }

    /// Makes a bend refer to other vertices.
    pub fn move_bend(&mut self, lane: u32, vertices: [u32; 4], points: &Points) {
        let (pack, slot) = split(lane);
        for (i, v) in vertices.into_iter().enumerate() {
            self.bends[pack].points[i][slot] = points.offset(v);
        }
    }

    /// Makes a length refer to other vertices.
    pub fn move_length(&mut self, lane: u32, vertices: [u32; 2], points: &Points) {
        let (pack, slot) = split(lane);
        for (i, v) in vertices.into_iter().enumerate() {
            self.lengths[pack].points[i][slot] = points.offset(v);
        }
    }

    /// Returns the bend in `lane`.
    pub fn bend(&self, lane: u32, points: &Points) -> BendLane {
        let (pack, slot) = split(lane);
        let (bends, targets) = (&self.bends[pack], &self.targets[pack]);
        BendLane {
            vertices: [0, 1, 2, 3].map(|i| points.vertex(bends.points[i][slot]) as u32),
            skews: [0, 1].map(|i| targets.skews[i][slot]),
            medians: [0, 1].map(|i| bends.medians[i][slot]),
            start: targets.starts[slot],
            target: targets.targets[slot],
            share: targets.shares[slot],
        }
    }

    /// Returns the length in `lane`.
    pub fn length(&self, lane: u32, points: &Points) -> LengthLane {
        let (pack, slot) = split(lane);
        let lengths = &self.lengths[pack];
        LengthLane { vertices: [0, 1].map(|i| points.vertex(lengths.points[i][slot]) as u32), rest: lengths.rest[slot] }
    }

    /// Takes a bend out of its lane and returns it.
    pub fn remove_bend(&mut self, lane: u32, points: &Points) -> BendLane {
        let bend = self.bend(lane, points);
        let (pack, slot) = split(lane);
        let (bends, targets) = (&mut self.bends[pack], &mut self.targets[pack]);
        for i in 0..4 {
            bends.points[i][slot] = PointOffset::NULL;
        }
        for i in 0..2 {
            bends.medians[i][slot] = 0.0;
            bends.folds[i][slot] = 0.0;
            targets.skews[i][slot] = 0.0;
        }
        targets.starts[slot] = 0.0;
        targets.targets[slot] = 0.0;
        targets.shares[slot] = 1.0;
        self.bend_slots.release(lane);
        bend
    }

    /// Takes a length out of its lane and returns it.
    pub fn remove_length(&mut self, lane: u32, points: &Points) -> LengthLane {
        let length = self.length(lane, points);
        let (pack, slot) = split(lane);
        for i in 0..2 {
            self.lengths[pack].points[i][slot] = PointOffset::NULL;
        }
        self.lengths[pack].rest[slot] = 0.0;
        self.length_slots.release(lane);
        length
    }

    /// Returns whether no vertex that the bend in `lane` refers to is awake.
    pub fn bend_is_still(&self, lane: u32, points: &Points) -> bool {
        let (pack, slot) = split(lane);
        self.bends[pack].points.iter().all(|p| points.motion_at(p[slot]) != Motion::Awake)
    }

    /// Returns whether no vertex that the length in `lane` refers to is awake.
    pub fn length_is_still(&self, lane: u32, points: &Points) -> bool {
        let (pack, slot) = split(lane);
        self.lengths[pack].points.iter().all(|p| points.motion_at(p[slot]) != Motion::Awake)
    }

    /// Narrows all targets by `step`, down to `limit` below where they began (radians).
    pub fn narrow(&mut self, level: SimdLevel, step: f32, limit: f32) {
        if !self.narrowing.contains(&true) {
            return;
        }
        let kernels = Kernels::of(level);
        for ((bends, targets), narrowing) in self.bends.iter_mut().zip(&mut self.targets).zip(&mut self.narrowing) {
            if *narrowing {
                // SAFETY: kernels are those of this CPU; no indices are followed.
                *narrowing = unsafe { (kernels.narrow)(bends, targets, step, limit) };
            }
        }
    }

    /// Has all targets looked at when they narrow next, as the settings have changed.
    pub fn restart_narrowing(&mut self) {
        self.narrowing.fill(true);
    }

    /// Projects every bend in turn.
    pub fn sweep_bends(&self, points: &mut Points, kernels: &Kernels) {
        // SAFETY: kernels are those of this CPU, and only offsets of points went into packs; their number never
        // falls.
        unsafe { (kernels.sweep_bends)(points.now_mut().as_mut_ptr(), &self.bends) }
    }

    /// Projects every length in turn.
    pub fn sweep_lengths(&self, points: &mut Points, kernels: &Kernels) {
        // SAFETY: as above.
        unsafe { (kernels.sweep_lengths)(points.now_mut().as_mut_ptr(), &self.lengths) }
    }

    /// Appends all packs, in the order in which they are solved.
    pub fn write_state(&self, to: &mut Words) {
        let Self { bends, targets, narrowing, bend_slots, lengths, length_slots } = self;
        for BendPack { points, folds, medians } in bends {
            to.list(points.as_flattened().iter().map(|offset| offset.index() as u32));
            to.floats(folds.as_flattened().iter().chain(medians.as_flattened()));
        }
        for BendTargets { skews, starts, targets, shares } in targets {
            to.floats(skews.as_flattened().iter().chain(starts).chain(targets));
            // All are 1 by the paper's rules.
            if shares.iter().any(|&share| share != 1.0) {
                to.floats(shares);
            }
        }
        to.flags(narrowing);
        for LengthPack { points, rest } in lengths {
            to.list(points.as_flattened().iter().map(|offset| offset.index() as u32));
            to.floats(rest);
        }
        bend_slots.write_state(to);
        length_slots.write_state(to);
    }

    /// Returns the pack of bends to be given up, if bends fill too few lanes.
    pub fn sparse_bends(&self) -> Option<usize> {
        sparse(&self.bend_slots)
    }

    /// Returns the pack of lengths to be given up, if lengths fill too few lanes.
    pub fn sparse_lengths(&self) -> Option<usize> {
        sparse(&self.length_slots)
    }

    /// Removes a pack of bends. Puts what it held and the owners into `taken`, and calls `moved` with the owner and the
    /// new lane of each bend of the pack that takes its number.
    pub fn dissolve_bends(
        &mut self,
        pack: usize,
        points: &Points,
        taken: &mut Vec<(u32, BendLane)>,
        mut moved: impl FnMut(u32, u32),
    ) {
        let first = (pack * LANES) as u32;
        taken.clear();
        taken.extend(self.bend_slots.owners(pack).map(|(slot, owner)| (owner, self.bend(first + slot as u32, points))));
        for slot in 0..LANES as u32 {
            if self.bend_slots.is_used(first + slot) {
                self.bend_slots.release(first + slot);
            }
        }
        self.bend_slots.remove(pack);
        self.bends.swap_remove(pack);
        self.targets.swap_remove(pack);
        self.narrowing.swap_remove(pack);
        if pack < self.bends.len() {
            self.bend_slots.owners(pack).for_each(|(slot, owner)| moved(owner, first + slot as u32));
        }
    }

    /// Removes a pack of lengths, as [`dissolve_bends`](Self::dissolve_bends) does one of bends.
    pub fn dissolve_lengths(
        &mut self,
        pack: usize,
        points: &Points,
        taken: &mut Vec<(u32, LengthLane)>,
        mut moved: impl FnMut(u32, u32),
    ) {
        let first = (pack * LANES) as u32;
        taken.clear();
        taken.extend(
            self.length_slots.owners(pack).map(|(slot, owner)| (owner, self.length(first + slot as u32, points))),
        );
        for slot in 0..LANES as u32 {
            if self.length_slots.is_used(first + slot) {
                self.length_slots.release(first + slot);
            }
        }
        self.length_slots.remove(pack);
        self.lengths.swap_remove(pack);
        if pack < self.lengths.len() {
            self.length_slots.owners(pack).for_each(|(slot, owner)| moved(owner, first + slot as u32));
        }
    }
}

/// Returns the pack to be given up, if any: packs are given up one at a time while fewer than five of eight lanes are
/// used.
fn sparse(slots: &Slots) -> Option<usize> {
    let packs = slots.packs();
    let dense = slots.live() * 8 >= packs * LANES * 5;
    let (pack, used) = slots.emptiest().filter(|_| !dense)?;
    // A few packs are needed whatever the number of constraints, as neighbours may not share one.
    (used == 0 || packs > 32).then_some(pack)
}

/// Returns the pack and the slot of a lane.
fn split(lane: u32) -> (usize, usize) {
    (lane as usize / LANES, lane as usize % LANES)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::words::assert_each_counts;

    #[test]
    fn every_field_of_packs_counts() {
        let mut region = Region::default();
        let (points, mut blocked) = (Points::default(), Blocked::default());
        blocked.next();
        let bend = BendLane {
            vertices: [0, 1, 2, 3],
            skews: [0.9; 2],
            medians: [0.8; 2],
            start: 3.0,
            target: 3.0,
            share: 1.0,
        };
        region.add_bend(1, &bend, &blocked, &points);
        region.add_length(2, &LengthLane { vertices: [0, 1], rest: 1.0 }, &blocked, &points);
        let changes: [fn(&mut Region); 12] = [
            |region| region.bends[0].points[2][0] = PointOffset::new(1),
            |region| region.bends[0].folds[1][0] = 0.5,
            |region| region.bends[0].medians[1][0] = 0.5,
            |region| region.targets[0].skews[1][0] = 0.5,
            |region| region.targets[0].starts[0] = 0.5,
            |region| region.targets[0].targets[0] = 0.5,
            |region| region.targets[0].shares[0] = 0.5,
            |region| region.narrowing[0] = false,
            |region| region.lengths[0].points[1][0] = PointOffset::new(1),
            |region| region.lengths[0].rest[0] = 0.5,
            |region| region.bend_slots = Slots::default(),
            |region| region.length_slots.release(0),
        ];
        assert_each_counts(&region, Region::write_state, &changes);
    }
}
