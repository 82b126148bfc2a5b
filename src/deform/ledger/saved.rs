//! Codes which half-edge carries which constraint, and the angles of bends, for snapshots.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use super::{Carriers, Ledger, NONE, PARKED};
use crate::{
    coding::{Coder, Damage, Differences, Odds, number},
    deform::packed::pack::LANES,
    film::HalfEdgeId,
};

/// Presence of a constraint at a half-edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// There is none.
    None,
    /// It is parked.
    Parked,
    /// It lies in a lane.
    Packed,
}

/// Foreknowledge about the constraints at a half-edge.
#[derive(Clone, Copy, Debug)]
pub struct Expected {
    /// Place of the length constraint.
    pub length: Place,
    /// Place of the bend constraint.
    pub bend: Place,
    /// Whether there may be a length constraint, and a bend constraint.
    pub may: [bool; 2],
    /// Angle at which a bend begins at rest, in radians.
    pub start: f32,
    /// Share by which its target narrows.
    pub share: f32,
    /// Region whose packs hold them.
    pub region: usize,
    /// Whether a bend may have been here that is gone.
    pub was: bool,
}

impl Ledger {
    /// Codes the ledger. To read, begin with one without constraints. `limit` is the angle by which targets narrow at
    /// most, and `packs` the number of packs of lengths and of bends in each region.
    ///
    /// # Errors
    /// [`Damage`] if there is a constraint where there may be none.
    pub fn code_state<C: Coder>(
        &mut self,
        limit: f32,
        packs: &[[usize; 2]],
        expected: impl Fn(HalfEdgeId) -> Expected,
        coder: &mut C,
    ) -> Result<(), Damage> {
        let half_edges = self.angles.len();
        let shares = coder.length(self.shares.len(), half_edges, "the shares of its bends")?;
        if C::READS {
            self.shares.resize(shares, 1.0);
        }
        let taken = packs.iter().map(|&[lengths, bends]| (vec![0; lengths], vec![0; bends]));
        let (lengths, bends): (Vec<_>, Vec<_>) = taken.unzip();
        let (mut lengths, mut bends) = (Kind::new(lengths), Kind::new(bends));
        let mut angles = Angles::default();
        let mut share_list = Differences::default();
        for i in 0..half_edges {
            let h = HalfEdgeId::new(i);
            let expected = expected(h);
            lengths.code(&mut self.lengths, h, expected.length, expected.may[0], expected.region, coder)?;
            bends.code(&mut self.bends, h, expected.bend, expected.may[1], expected.region, coder)?;
            if let Some(share) = self.shares.get_mut(i) {
                coder.float(&mut share_list, share, expected.share);
            }
            let end = limit * self.share(h);
            let likely = self.bends.has(h) || expected.was;
            if let Some(pair) = self.angles.get_mut(i) {
                angles.code(pair, likely, expected.start, end, coder);
            }
        }
        Ok(())
    }
}

/// Odds of constraints of one kind.
struct Kind {
    places: Differences,
    packs: Differences,
    taken: Taken,
}

/// Slots that are taken already: one word a pack, for each region.
struct Taken(Vec<Vec<u32>>);

impl Taken {
    /// Codes a slot of a pack: its rank among those that are not taken yet.
    fn code<C: Coder>(&mut self, region: usize, pack: u32, slot: u32, coder: &mut C) -> Result<u32, Damage> {
        let damage = Damage("a lane");
        let taken = self.0.get_mut(region).and_then(|packs| packs.get_mut(pack as usize)).ok_or(damage)?;
        let free = !*taken;
        let count = free.count_ones();
        let bits = u32::BITS - count.saturating_sub(1).leading_zeros();
        let rank = coder.plain((free & ((1 << slot) - 1)).count_ones(), bits);
        // The rank-th of the bits that are set.
        let mut left = free;
        for _ in 0..rank.min(number(LANES)) {
            left &= left.wrapping_sub(1);
        }
        let slot = left.trailing_zeros();
        if slot >= number(LANES) {
            return Err(damage);
        }
        *taken |= 1 << slot;
        Ok(slot)
    }
}

impl Kind {
    /// Makes the odds of constraints that take none of these slots yet.
    fn new(taken: Vec<Vec<u32>>) -> Self {
        Self { places: Differences::default(), packs: Differences::default(), taken: Taken(taken) }
    }

    fn code<C: Coder>(
        &mut self,
        carriers: &mut Carriers,
        h: HalfEdgeId,
        expected: Place,
        may: bool,
        region: usize,
        coder: &mut C,
    ) -> Result<(), Damage> {
        let lane = carriers.lanes.get_mut(h.index()).ok_or(Damage("a lane"))?;
        let mut place = match *lane {
            NONE => 0,
            PARKED => 1,
            _ => 2,
        };
        coder.word(&mut self.places, &mut place, expected as u32);
        let lanes = number(LANES);
        *lane = match place {
            0 => NONE,
            1 => PARKED,
            2 => {
                let pack = coder.difference(&mut self.packs, *lane / lanes);
                let first = pack.checked_mul(lanes).ok_or(Damage("a lane"))?;
                first | self.taken.code(region, pack, *lane % lanes, coder)?
            }
            _ => return Err(Damage("a constraint")),
        };
        if C::READS {
            carriers.count += usize::from(place > 0);
            if place > 0 && !may {
                return Err(Damage("a constraint"));
            }
        }
        Ok(())
    }
}

/// Odds of the angles of bends.
#[derive(Default)]
struct Angles {
    any: Odds,
    any_likely: Odds,
    starts: Differences,
    is_start: Odds,
    is_end: Odds,
    targets: Differences,
}

impl Angles {
    /// Codes the angle at which a bend began, and its target when it was parked.
    fn code<C: Coder>(&mut self, [start, target]: &mut [f32; 2], likely: bool, rest: f32, limit: f32, coder: &mut C) {
        let is_none = start.to_bits() == 0 && target.to_bits() == 0;
        if !coder.bit(if likely { &mut self.any_likely } else { &mut self.any }, !is_none) {
            (*start, *target) = (0.0, 0.0);
            return;
        }
        coder.float(&mut self.starts, start, rest);
        let same = |a: f32, b: f32| a.to_bits() == b.to_bits();
        let end = *start - limit;
        if coder.bit(&mut self.is_start, same(*target, *start)) {
            *target = *start;
        } else if coder.bit(&mut self.is_end, same(*target, end)) {
            *target = end;
        } else {
            coder.float(&mut self.targets, target, end);
        }
    }
}
