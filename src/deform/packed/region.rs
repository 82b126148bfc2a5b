//! Packs of one region of a film: constraints that lie near each other, so that their points stay in the cache.

use super::{
    level::Kernels,
    pack::{BendPack, BendTargets, LANES, LengthPack},
    points::{Motion, PointOffset, Points},
    slots::{Blocked, Slots},
};
use crate::deform::SimdLevel;

/// A bend constraint, as a lane holds it. Lengths are in the points' unit.
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
}

/// A length constraint, as a lane holds it. Lengths are in the points' unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthLane {
    /// The two vertices.
    pub vertices: [u32; 2],
    /// Rest length.
    pub rest: f32,
}

/// Packs of bends and lengths. Owners are half-edges.
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
    /// Number of bends and of lengths.
    pub fn counts(&self) -> [usize; 2] {
        [self.bend_slots.live(), self.length_slots.live()]
    }

    /// Number of packs of bends and of lengths.
    pub fn packs(&self) -> [usize; 2] {
        [self.bend_slots.packs(), self.length_slots.packs()]
    }

    /// Adds a bend; gives its lane.
    pub fn add_bend(&mut self, owner: u32, bend: &BendLane, blocked: &Blocked, points: &Points) -> u32 {
        let (lane, begun) = self.bend_slots.place(owner, blocked);
        if begun {
            self.bends.push(BendPack::NULL);
            self.targets.push(BendTargets::NULL);
            self.narrowing.push(true);
        }
        let (pack, place) = split(lane);
        for i in 0..2 {
            self.bends[pack].medians[i][place] = bend.medians[i];
            self.targets[pack].skews[i][place] = bend.skews[i];
        }
        self.targets[pack].starts[place] = bend.start;
        self.targets[pack].targets[place] = bend.target;
        // Its folds are found when the targets narrow next.
        self.narrowing[pack] = true;
        self.move_bend(lane, bend.vertices, points);
        lane
    }

    /// Adds a length; gives its lane.
    pub fn add_length(&mut self, owner: u32, length: &LengthLane, blocked: &Blocked, points: &Points) -> u32 {
        let (lane, begun) = self.length_slots.place(owner, blocked);
        if begun {
            self.lengths.push(LengthPack::NULL);
        }
        let (pack, place) = split(lane);
        self.lengths[pack].rest[place] = length.rest;
        self.move_length(lane, length.vertices, points);
        lane
    }

    /// Makes a bend refer to other vertices.
    pub fn move_bend(&mut self, lane: u32, vertices: [u32; 4], points: &Points) {
        let (pack, place) = split(lane);
        for (i, v) in vertices.into_iter().enumerate() {
            self.bends[pack].points[i][place] = points.place(v);
        }
    }

    /// Makes a length refer to other vertices.
    pub fn move_length(&mut self, lane: u32, vertices: [u32; 2], points: &Points) {
        let (pack, place) = split(lane);
        for (i, v) in vertices.into_iter().enumerate() {
            self.lengths[pack].points[i][place] = points.place(v);
        }
    }

    /// The bend in `lane`.
    pub fn bend(&self, lane: u32, points: &Points) -> BendLane {
        let (pack, place) = split(lane);
        let (bends, targets) = (&self.bends[pack], &self.targets[pack]);
        BendLane {
            vertices: [0, 1, 2, 3].map(|i| points.vertex(bends.points[i][place]) as u32),
            skews: [0, 1].map(|i| targets.skews[i][place]),
            medians: [0, 1].map(|i| bends.medians[i][place]),
            start: targets.starts[place],
            target: targets.targets[place],
        }
    }

    /// The length in `lane`.
    pub fn length(&self, lane: u32, points: &Points) -> LengthLane {
        let (pack, place) = split(lane);
        let lengths = &self.lengths[pack];
        LengthLane {
            vertices: [0, 1].map(|i| points.vertex(lengths.points[i][place]) as u32),
            rest: lengths.rest[place],
        }
    }

    /// Takes a bend out of its lane.
    pub fn remove_bend(&mut self, lane: u32, points: &Points) -> BendLane {
        let bend = self.bend(lane, points);
        let (pack, place) = split(lane);
        let (bends, targets) = (&mut self.bends[pack], &mut self.targets[pack]);
        for i in 0..4 {
            bends.points[i][place] = PointOffset::NULL;
        }
        for i in 0..2 {
            bends.medians[i][place] = 0.0;
            bends.folds[i][place] = 0.0;
            targets.skews[i][place] = 0.0;
        }
        targets.starts[place] = 0.0;
        targets.targets[place] = 0.0;
        self.bend_slots.release(lane);
        bend
    }

    /// Takes a length out of its lane.
    pub fn remove_length(&mut self, lane: u32, points: &Points) -> LengthLane {
        let length = self.length(lane, points);
        let (pack, place) = split(lane);
        for i in 0..2 {
            self.lengths[pack].points[i][place] = PointOffset::NULL;
        }
        self.lengths[pack].rest[place] = 0.0;
        self.length_slots.release(lane);
        length
    }

    /// Whether every vertex that `lane`'s bend refers to is still.
    pub fn bend_is_still(&self, lane: u32, points: &Points) -> bool {
        let (pack, place) = split(lane);
        self.bends[pack].points.iter().all(|p| points.motion_at(p[place]) != Motion::Awake)
    }

    /// Whether both vertices that `lane`'s length refers to are still.
    pub fn length_is_still(&self, lane: u32, points: &Points) -> bool {
        let (pack, place) = split(lane);
        self.lengths[pack].points.iter().all(|p| points.motion_at(p[place]) != Motion::Awake)
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

    /// Looks at all targets anew: settings have changed.
    pub fn restart_narrowing(&mut self) {
        self.narrowing.fill(true);
    }

    pub(super) fn sweep_bends(&self, points: &mut Points, kernels: &Kernels) {
        // SAFETY: kernels are those of this CPU, and only places of points went into packs; their number never
        // falls.
        unsafe { (kernels.sweep_bends)(points.now_mut().as_mut_ptr(), &self.bends) }
    }

    pub(super) fn sweep_lengths(&self, points: &mut Points, kernels: &Kernels) {
        // SAFETY: as above.
        unsafe { (kernels.sweep_lengths)(points.now_mut().as_mut_ptr(), &self.lengths) }
    }

    /// The pack of bends to be given up, if they fill too few lanes.
    pub fn sparse_bends(&self) -> Option<usize> {
        sparse(&self.bend_slots)
    }

    /// The pack of lengths to be given up, if they fill too few lanes.
    pub fn sparse_lengths(&self) -> Option<usize> {
        sparse(&self.length_slots)
    }

    /// Removes a pack of bends. `taken` gets what it held; the owners and lanes of those that moved go to `moved`.
    pub fn dissolve_bends(
        &mut self,
        pack: usize,
        points: &Points,
        taken: &mut Vec<(u32, BendLane)>,
        mut moved: impl FnMut(u32, u32),
    ) {
        let first = (pack * LANES) as u32;
        taken.clear();
        taken.extend(
            self.bend_slots.owners(pack).map(|(place, owner)| (owner, self.bend(first + place as u32, points))),
        );
        for place in 0..LANES as u32 {
            if self.bend_slots.is_used(first + place) {
                self.bend_slots.release(first + place);
            }
        }
        self.bend_slots.remove(pack);
        self.bends.swap_remove(pack);
        self.targets.swap_remove(pack);
        self.narrowing.swap_remove(pack);
        if pack < self.bends.len() {
            self.bend_slots.owners(pack).for_each(|(place, owner)| moved(owner, first + place as u32));
        }
    }

    /// Removes a pack of lengths, as above.
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
            self.length_slots.owners(pack).map(|(place, owner)| (owner, self.length(first + place as u32, points))),
        );
        for place in 0..LANES as u32 {
            if self.length_slots.is_used(first + place) {
                self.length_slots.release(first + place);
            }
        }
        self.length_slots.remove(pack);
        self.lengths.swap_remove(pack);
        if pack < self.lengths.len() {
            self.length_slots.owners(pack).for_each(|(place, owner)| moved(owner, first + place as u32));
        }
    }
}

/// Packs are given up one at a time while fewer than five of eight lanes are used.
fn sparse(slots: &Slots) -> Option<usize> {
    let packs = slots.packs();
    let dense = slots.live() * 8 >= packs * LANES * 5;
    let (pack, used) = slots.emptiest().filter(|_| !dense)?;
    // A few packs are needed whatever the number of constraints, as neighbours may not share one.
    (used == 0 || packs > 32).then_some(pack)
}

fn split(lane: u32) -> (usize, usize) {
    (lane as usize / LANES, lane as usize % LANES)
}
