//! Codes numbers, lists and whatever else a film consists of.

use bevy_math::Vec3;

use super::{
    bits::{Bits, Damage},
    difference::Differences,
    odds::Odds,
};

/// Codes numbers, lists and whatever else a film consists of.
pub(crate) trait Coder: Bits {
    /// Codes a difference of a list.
    #[inline]
    fn difference(&mut self, list: &mut Differences, difference: u32) -> u32 {
        list.code(self, difference)
    }

    /// Codes a number that is likely near `expected`.
    #[inline]
    fn word(&mut self, list: &mut Differences, word: &mut u32, expected: u32) {
        let difference = self.difference(list, folded(word.wrapping_sub(expected)));
        *word = expected.wrapping_add(unfolded(difference));
    }

    /// Codes a float that is likely near `expected`, to the bit.
    #[inline]
    fn float(&mut self, list: &mut Differences, x: &mut f32, expected: f32) {
        let expected = rank(expected.to_bits());
        let difference = self.difference(list, folded(rank(x.to_bits()).wrapping_sub(expected)));
        *x = f32::from_bits(unrank(expected.wrapping_add(unfolded(difference))));
    }

    /// Codes a truth value that is likely `expected`.
    #[inline]
    fn flag(&mut self, odds: &mut Odds, flag: &mut bool, expected: bool) {
        *flag = self.bit(odds, *flag != expected) != expected;
    }

    /// Codes a number of which nothing is known.
    fn plain_word(&mut self, word: &mut u32) {
        *word = self.plain(*word, 32);
    }

    /// Codes a number of 64 bits of which nothing is known.
    fn plain_long(&mut self, long: &mut u64) {
        let [low, high] = halves(*long).map(|half| self.plain(half, 32));
        *long = u64::from(low) | u64::from(high) << 32;
    }

    /// Codes a float of which nothing is known.
    fn plain_float(&mut self, x: &mut f32) {
        *x = f32::from_bits(self.plain(x.to_bits(), 32));
    }

    /// Codes a double of which nothing is known.
    fn plain_double(&mut self, x: &mut f64) {
        let mut bits = x.to_bits();
        self.plain_long(&mut bits);
        *x = f64::from_bits(bits);
    }

    /// Codes three floats of which nothing is known.
    fn plain_vector(&mut self, v: &mut Vec3) {
        [&mut v.x, &mut v.y, &mut v.z].into_iter().for_each(|x| self.plain_float(x));
    }

    /// Codes a number of 64 bits that is likely small.
    fn long(&mut self, list: &mut Differences, long: &mut u64) {
        let small = u32::try_from(*long).unwrap_or(u32::MAX);
        let small = self.difference(list, small);
        if small == u32::MAX {
            self.plain_long(long);
        } else {
            *long = u64::from(small);
        }
    }

    /// Codes a length, which may be at most `most`; `part` names what it is the length of.
    ///
    /// # Errors
    /// [`Damage`] if a length that is read is larger.
    fn length(&mut self, length: usize, most: usize, part: &'static str) -> Result<usize, Damage> {
        let length = u32::try_from(length).map_err(|_| Damage(part))?;
        let length = self.plain(length, 32) as usize;
        if Self::READS && length > most { Err(Damage(part)) } else { Ok(length) }
    }

    /// Codes floats, each with what is expected of it.
    fn floats(&mut self, floats: &mut [f32], mut expected: impl FnMut(usize) -> f32) {
        let mut list = Differences::default();
        for (i, x) in floats.iter_mut().enumerate() {
            self.float(&mut list, x, expected(i));
        }
    }

    /// Codes vectors, each with what is expected of it.
    fn vectors(&mut self, vectors: &mut [Vec3], mut expected: impl FnMut(usize) -> Vec3) {
        let mut lists: [Differences; 3] = Default::default();
        for (i, v) in vectors.iter_mut().enumerate() {
            let expected = expected(i);
            self.vector(&mut lists, v, expected);
        }
    }

    /// Codes a vector of a list that is likely near `expected`.
    #[inline]
    fn vector(&mut self, lists: &mut [Differences; 3], v: &mut Vec3, expected: Vec3) {
        let [x, y, z] = lists;
        self.float(x, &mut v.x, expected.x);
        self.float(y, &mut v.y, expected.y);
        self.float(z, &mut v.z, expected.z);
    }

    /// Codes a vector of a list that likely lies from `from` along `way`, or against it.
    #[expect(clippy::indexing_slicing, reason = "an axis is 0, 1 or 2")]
    fn vector_along(&mut self, lists: &mut [Differences; 3], v: &mut Vec3, from: Vec3, way: Vec3) {
        let axis = way.abs().max_position();
        self.float(&mut lists[axis], &mut v[axis], from[axis]);
        let part = if way[axis] != 0.0 { (v[axis] - from[axis]) / way[axis] } else { 0.0 };
        for other in [(axis + 1) % 3, (axis + 2) % 3] {
            self.float(&mut lists[other], &mut v[other], from[other] + part * way[other]);
        }
    }

    /// Codes floats of which many are the same: a list of the different ones, and for each its place in that list.
    ///
    /// # Errors
    /// [`Damage`] in `part` if a place is read that is beyond the list.
    fn few_floats(&mut self, floats: &mut [f32], part: &'static str) -> Result<(), Damage> {
        self.few_floats_by(floats, |_, before| before, part)
    }

    /// Codes floats as [`few_floats`](Self::few_floats) does. `expected` is given the index of a float and the place of
    /// the one before, and returns the place that is expected.
    ///
    /// # Errors
    /// [`Damage`] in `part` if a place is read that is beyond the list.
    fn few_floats_by(
        &mut self,
        floats: &mut [f32],
        mut expected: impl FnMut(usize, Option<u32>) -> Option<u32>,
        part: &'static str,
    ) -> Result<(), Damage> {
        let mut different: Vec<u32> = Vec::new();
        if !Self::READS {
            different.extend(floats.iter().map(|x| rank(x.to_bits())));
            different.sort_unstable();
            different.dedup();
        }
        let count = self.length(different.len(), floats.len(), part)?;
        different.resize(count, 0);
        let (mut values, mut places) = (Differences::default(), Differences::default());
        let mut before = 0;
        for value in &mut different {
            self.word(&mut values, value, before);
            before = *value;
        }
        let mut before = None;
        for (i, x) in floats.iter_mut().enumerate() {
            let mut place = number(different.partition_point(|&value| value < rank(x.to_bits())));
            self.word(&mut places, &mut place, expected(i, before).unwrap_or_default());
            before = Some(place);
            *x = f32::from_bits(unrank(*different.get(place as usize).ok_or(Damage(part))?));
        }
        Ok(())
    }
}

impl<T: Bits> Coder for T {}

/// Returns a count, or a place in a list, as it is coded. Lists whose length is coded have no more than `u32::MAX`.
#[inline]
pub(crate) fn number(count: usize) -> u32 {
    u32::try_from(count).unwrap_or(u32::MAX)
}

/// Returns the rank of a float among all, given its bits: the larger the float, the larger the rank, but for NaN.
#[inline]
fn rank(bits: u32) -> u32 {
    if bits >> 31 == 0 { bits | 1 << 31 } else { !bits }
}

#[inline]
fn unrank(rank: u32) -> u32 {
    if rank >> 31 == 1 { rank & !(1 << 31) } else { !rank }
}

/// Makes small numbers of small differences, up or down.
#[inline]
fn folded(difference: u32) -> u32 {
    difference << 1 ^ (difference.cast_signed() >> 31).cast_unsigned()
}

#[inline]
fn unfolded(folded: u32) -> u32 {
    folded >> 1 ^ (folded & 1).wrapping_neg()
}

#[inline]
#[expect(clippy::cast_possible_truncation, reason = "each half is what is left of the other")]
fn halves(long: u64) -> [u32; 2] {
    [long as u32, (long >> 32) as u32]
}
