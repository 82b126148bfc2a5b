//! Builds the slots of packs again from a snapshot.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use super::{LANES, Slots};
use crate::coding::{Damage, number};

impl Slots {
    /// Makes the slots of `packs` packs, all empty.
    pub fn empty(packs: usize) -> Self {
        let mut slots = Self { owners: vec![[0; LANES]; packs], used: vec![0; packs], ..Self::default() };
        (0..packs).for_each(|pack| slots.set_open(pack, true));
        slots
    }

    /// Gives `owner` the lane that it had.
    ///
    /// # Errors
    /// [`Damage`] if there is no such lane or it has an owner.
    pub fn give(&mut self, owner: u32, lane: u32) -> Result<(), Damage> {
        let (pack, slot) = (lane as usize / LANES, lane % number(LANES));
        let used = self.used.get_mut(pack).filter(|used| **used & (1 << slot) == 0).ok_or(Damage("a lane"))?;
        let place = self.owners.get_mut(pack).and_then(|owners| owners.get_mut(slot as usize));
        *place.ok_or(Damage("a lane"))? = owner;
        *used |= 1 << slot;
        let full = *used == u32::MAX;
        self.live += 1;
        if full {
            self.set_open(pack, false);
        }
        Ok(())
    }
}
