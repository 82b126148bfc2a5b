//! Codes the marks of sleep for snapshots.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use bevy_math::Vec3;

use super::SleepMarks;
use crate::coding::{Coder, Damage, Differences};

impl SleepMarks {
    /// Codes the marks. To read, begin with those of a fresh film. `positions` are those of the film,
    /// `came_from` those before the last sweep, and `is_attached` says which vertices the metal holds.
    ///
    /// # Errors
    /// [`Damage`] if a list that is read does not fit the film.
    pub fn code_state<C: Coder>(
        &mut self,
        positions: &[Vec3],
        came_from: impl Fn(usize) -> Vec3,
        is_attached: impl Fn(usize) -> bool,
        coder: &mut C,
    ) -> Result<(), Damage> {
        let count = positions.len();
        if C::READS {
            self.positions.resize(count, Vec3::ZERO);
            self.quiet.resize(count, 0);
            self.loose.resize(count, false);
        }
        // Marks of a vertex begin once it has separated.
        let place = |i: usize| positions.get(i).copied().unwrap_or_default();
        let begun = |i: usize| if is_attached(i) { Vec3::ZERO } else { place(i) };
        coder.vectors(&mut self.positions, begun);
        let (mut list, mut before) = (Differences::default(), 0);
        for (i, quiet) in self.quiet.iter_mut().enumerate() {
            let mut ticks = u32::from(*quiet);
            coder.word(&mut list, &mut ticks, if is_attached(i) { 0 } else { before });
            *quiet = u8::try_from(ticks).map_err(|_| Damage("the marks of its sleep"))?;
            before = if is_attached(i) { before } else { ticks };
        }
        let known = coder.length(self.announced.len(), count, "the marks of its sleep")?;
        if known != 0 && known != count {
            return Err(Damage("the marks of its sleep"));
        }
        if C::READS {
            self.announced.resize(known, Vec3::ZERO);
        }
        let mut lists = Default::default();
        for (i, announced) in self.announced.iter_mut().enumerate() {
            // It came from there.
            coder.vector_along(&mut lists, announced, begun(i), place(i) - came_from(i));
        }
        Ok(())
    }
}
