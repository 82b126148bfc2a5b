//! Builds the slots of packs again from a snapshot.

use super::{LANES, Slots};
use crate::coding::Damage;

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
        let (pack, slot) = (lane as usize / LANES, lane % LANES as u32);
        let used = self.used.get_mut(pack).filter(|used| **used & (1 << slot) == 0).ok_or(Damage("a lane"))?;
        *used |= 1 << slot;
        let full = *used == u32::MAX;
        self.owners[pack][slot as usize] = owner;
        self.live += 1;
        if full {
            self.set_open(pack, false);
        }
        Ok(())
    }
}
