//! Codes the packs of a region for snapshots.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use super::{BendLane, LengthLane, Region};
use crate::{
    coding::{Coder, Damage, Differences, Odds},
    deform::{
        pace::Narrowing,
        packed::{
            level::{Kernels, SimdLevel},
            pack::{BendPack, BendTargets, LANES, LengthPack},
            points::Points,
            slots::Slots,
        },
    },
};

/// Steps of narrowing that are counted at most.
const MOST_STEPS: u32 = 4096;

/// Odds of the targets of bends.
#[derive(Default)]
pub struct Targets {
    used: Lanes,
    unused: Lanes,
    narrowing: Odds,
    renewed: Odds,
    null: Odds,
    folds: Differences,
}

/// Odds of lanes that are used, or not.
#[derive(Default)]
struct Lanes {
    is_end: Odds,
    is_counted: Odds,
    counts: Differences,
    count: u32,
    targets: Differences,
}

impl Lanes {
    /// Codes a target that narrows from `start` by `step` down to `end`: it is at the end, a whole number of steps from
    /// the start, or anywhere.
    fn code<C: Coder>(
        &mut self,
        target: &mut f32,
        expected: Option<f32>,
        start: f32,
        step: f32,
        end: f32,
        coder: &mut C,
    ) {
        let same = |a: f32, b: f32| a.to_bits() == b.to_bits();
        if coder.bit(&mut self.is_end, same(*target, end)) {
            *target = end;
            return;
        }
        // As the kernel does: rounded after each step.
        let (mut at, mut count) = (start, 0);
        let wanted = *target;
        while !C::READS && !same(at, wanted) && at > wanted && at - step < at && count < MOST_STEPS {
            (at, count) = (at - step, count + 1);
        }
        if coder.bit(&mut self.is_counted, same(at, wanted)) {
            coder.word(&mut self.counts, &mut count, self.count);
            self.count = count;
            *target = (0..count.min(MOST_STEPS)).fold(start, |at, _| at - step);
        } else {
            coder.float(&mut self.targets, target, expected.unwrap_or(end));
        }
    }
}

impl Region {
    /// Returns the numbers of packs of lengths and of bends.
    pub fn packs(&self) -> [usize; 2] {
        [self.lengths.len(), self.bends.len()]
    }

    /// Makes a region of so many empty packs of lengths and of bends.
    pub fn of_packs([lengths, bends]: [usize; 2]) -> Self {
        Self {
            bends: vec![BendPack::NULL; bends],
            targets: vec![BendTargets::NULL; bends],
            narrowing: vec![true; bends],
            bend_slots: Slots::empty(bends),
            lengths: vec![LengthPack::NULL; lengths],
            length_slots: Slots::empty(lengths),
        }
    }

    /// Puts a bend into the lane that it had.
    ///
    /// # Errors
    /// [`Damage`] if there is no such lane or it is used.
    pub fn give_bend(&mut self, owner: u32, lane: u32, bend: &BendLane, points: &Points) -> Result<(), Damage> {
        self.bend_slots.give(owner, lane)?;
        self.put_bend(lane, bend, points);
        Ok(())
    }

    /// Puts a length into the lane that it had.
    ///
    /// # Errors
    /// [`Damage`] if there is no such lane or it is used.
    pub fn give_length(&mut self, owner: u32, lane: u32, length: &LengthLane, points: &Points) -> Result<(), Damage> {
        self.length_slots.give(owner, lane)?;
        self.put_length(lane, length, points);
        Ok(())
    }

    /// Codes the targets of all bends, pack by pack. `by` is how they narrow.
    pub fn code_targets<C: Coder>(&mut self, by: Narrowing, odds: &mut Targets, coder: &mut C) {
        let kernels = Kernels::of(SimdLevel::default());
        let packs = self.bends.iter_mut().zip(&mut self.targets).zip(&mut self.narrowing);
        for (((bends, targets), narrowing), first) in packs.zip((0..).step_by(LANES)) {
            // Lanes that nobody uses narrow, too: from 0, all of a pack alike.
            let mut unused = 0.0;
            let lanes = targets.targets.iter_mut().zip(&targets.starts).zip(&targets.shares);
            for (((target, &start), &share), lane) in lanes.zip(first..) {
                let is_used = self.bend_slots.is_used(lane);
                let odds = if is_used { &mut odds.used } else { &mut odds.unused };
                let expected = if is_used { None } else { Some(unused) };
                odds.code(target, expected, start, by.step * share, start - by.limit * share, coder);
                if !is_used {
                    unused = *target;
                }
            }
            coder.flag(&mut odds.narrowing, narrowing, true);
            // Folds follow from the targets where they have been renewed since the targets changed.
            let mut renewed = bends.clone();
            // SAFETY: kernels are those of this CPU; no indices are followed. A step of 0 changes no target.
            unsafe { (kernels.narrow)(&mut renewed, &mut targets.clone(), 0.0, 0.0) };
            let bits = |pack: &BendPack| pack.folds.map(|folds| folds.map(f32::to_bits));
            let is_renewed = !C::READS && bits(&renewed) == bits(bends);
            if coder.bit(&mut odds.renewed, is_renewed) {
                bends.folds = renewed.folds;
            } else {
                let expected = renewed.folds.into_iter().flatten();
                for (fold, expected) in bends.folds.as_flattened_mut().iter_mut().zip(expected) {
                    let mut is_null = fold.to_bits() == 0;
                    coder.flag(&mut odds.null, &mut is_null, false);
                    if is_null {
                        *fold = 0.0;
                    } else {
                        coder.float(&mut odds.folds, fold, expected);
                    }
                }
            }
        }
    }
}
