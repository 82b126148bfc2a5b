//! Which lane of which pack holds which constraint.

mod saved;

use super::pack::{LANES, PerLane};
use crate::film::words::Words;

/// Number of packs that are tried for a constraint before a new one is begun. A constraint has some thirty neighbours,
/// each of which blocks one pack at most, so this rarely fails while there is room.
const TRIES: usize = 64;

/// Packs that hold a constraint which shares a point with the one to be placed.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Blocked {
    /// Number of the constraint that each pack was last blocked for.
    marks: Vec<u32>,
    number: u32,
}

impl Blocked {
    /// Begins with the next constraint: unblocks all packs.
    pub fn next(&mut self) {
        self.number = self.number.wrapping_add(1);
        if self.number == 0 {
            // Marks of four billion constraints ago would count again.
            self.marks.fill(0);
            self.number = 1;
        }
    }

    /// Blocks the pack of `lane`.
    #[inline]
    pub fn block(&mut self, lane: u32) {
        let pack = lane as usize / LANES;
        if pack >= self.marks.len() {
            self.marks.resize(pack + 1, 0);
        }
        self.marks[pack] = self.number;
    }

    #[inline]
    fn is_blocked(&self, pack: usize) -> bool {
        self.marks.get(pack) == Some(&self.number)
    }
}

/// Lanes and their owners. A lane's number is 32 times its pack's plus its slot, the place within the pack.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Slots {
    /// Owner of each lane, where it is used.
    owners: Vec<PerLane<u32>>,
    /// Whether each lane is used: one bit a lane, one word a pack.
    used: Vec<u32>,
    /// Whether each pack has room: one bit a pack.
    open: Vec<u64>,
    /// Number of used lanes.
    live: usize,
}

impl Slots {
    /// Returns the number of packs.
    pub fn packs(&self) -> usize {
        self.used.len()
    }

    /// Returns the number of used lanes.
    pub fn live(&self) -> usize {
        self.live
    }

    /// Gives `owner` a lane in the first pack with room that is not blocked. Returns the lane, and whether a pack was
    /// begun for it.
    pub fn claim(&mut self, owner: u32, blocked: &Blocked) -> (u32, bool) {
        let found = self.open_packs().take(TRIES).find(|&pack| !blocked.is_blocked(pack));
        let pack = found.unwrap_or_else(|| {
            self.owners.push([0; LANES]);
            self.used.push(0);
            let pack = self.used.len() - 1;
            self.set_open(pack, true);
            pack
        });
        let slot = self.used[pack].trailing_ones();
        self.used[pack] |= 1 << slot;
        self.owners[pack][slot as usize] = owner;
        self.live += 1;
        if self.used[pack] == u32::MAX {
            self.set_open(pack, false);
        }
        (pack as u32 * LANES as u32 + slot, found.is_none())
    }

    /// Frees a lane.
    pub fn release(&mut self, lane: u32) {
        let (pack, slot) = (lane as usize / LANES, lane % LANES as u32);
        self.used[pack] &= !(1 << slot);
        self.live -= 1;
        self.set_open(pack, true);
    }

    /// Returns the emptiest pack (the first of several) and its number of used lanes.
    pub fn emptiest(&self) -> Option<(usize, u32)> {
        self.used.iter().map(|used| used.count_ones()).enumerate().min_by_key(|&(pack, used)| (used, pack))
    }

    /// Returns slot and owner of each used lane of `pack`.
    pub fn owners(&self, pack: usize) -> impl Iterator<Item = (usize, u32)> + '_ {
        let used = self.used[pack];
        (0..LANES).filter(move |slot| used & (1 << slot) != 0).map(move |slot| (slot, self.owners[pack][slot]))
    }

    /// Removes an empty pack. The last one takes its number.
    pub fn remove(&mut self, pack: usize) {
        debug_assert_eq!(self.used[pack], 0);
        self.set_open(self.used.len() - 1, false);
        self.used.swap_remove(pack);
        self.owners.swap_remove(pack);
        if let Some(&used) = self.used.get(pack) {
            self.set_open(pack, used != u32::MAX);
        }
    }

    fn set_open(&mut self, pack: usize, open: bool) {
        let (word, bit) = (pack / 64, 1 << (pack % 64));
        if word >= self.open.len() {
            self.open.resize(word + 1, 0);
        }
        if open {
            self.open[word] |= bit;
        } else {
            self.open[word] &= !bit;
        }
    }

    fn open_packs(&self) -> impl Iterator<Item = usize> + '_ {
        self.open.iter().enumerate().flat_map(|(word, &bits)| {
            let mut left = bits;
            std::iter::from_fn(move || {
                let bit = left.trailing_zeros() as usize;
                left &= left.checked_sub(1)?;
                Some(word * 64 + bit)
            })
        })
    }

    /// Appends which lane has which owner.
    pub fn write_state(&self, to: &mut Words) {
        // The rest follows.
        let Self { owners: _, used, open: _, live: _ } = self;
        to.list(used.iter().copied());
        to.list((0..self.packs()).flat_map(|pack| self.owners(pack)).map(|(_, owner)| owner));
    }

    /// Returns whether `lane` is used.
    pub fn is_used(&self, lane: u32) -> bool {
        self.used[lane as usize / LANES] & (1 << (lane % LANES as u32)) != 0
    }
}
