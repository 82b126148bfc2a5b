//! The range coder: codes each bit in as much space as its odds deserve (G. N. N. Martin: *Range encoding*, 1979, in
//! the form with a carry that LZMA uses). Bits that nobody can foretell go into a list of their own, as they are.

use super::{
    bits::{Bits, Damage},
    odds::{Odds, PRECISION},
};

/// Least range before another byte is due.
const LEAST: u32 = 1 << 24;

/// Writes bits.
#[derive(Clone, Debug)]
pub(crate) struct Writer {
    low: u64,
    range: u32,
    /// Last byte that is known but for a carry, and the number of bytes 255 after it.
    held: u8,
    full: u64,
    /// Whether `held` is a byte of the output.
    begun: bool,
    coded: Vec<u8>,
    plain: Vec<u8>,
    /// Plain bits that do not fill bytes yet, and their number.
    bits: u64,
    count: u32,
}

impl Writer {
    /// Begins.
    pub fn new() -> Self {
        Self {
            low: 0,
            range: u32::MAX,
            held: 0,
            full: 0,
            begun: false,
            coded: Vec::new(),
            plain: Vec::new(),
            bits: 0,
            count: 0,
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "bytes are taken from where they are in the word")]
    fn shift(&mut self) {
        let carry = (self.low >> 32) as u8;
        if carry != 0 || (self.low as u32) < 0xff00_0000 {
            if self.begun {
                self.coded.push(self.held.wrapping_add(carry));
            }
            for _ in 0..self.full {
                self.coded.push(255u8.wrapping_add(carry));
            }
            (self.held, self.full, self.begun) = ((self.low >> 24) as u8, 0, true);
        } else {
            self.full += 1;
        }
        self.low = (self.low & 0x00ff_ffff) << 8;
    }

    /// Ends. Returns the coded bits, preceded by their number of bytes (4 bytes), then the plain bits.
    pub fn finish(mut self) -> Vec<u8> {
        for _ in 0..5 {
            self.shift();
        }
        // Whoever reads past the end reads zeros.
        while self.coded.last() == Some(&0) {
            self.coded.pop();
        }
        if self.count > 0 {
            self.plain.extend(self.bits.to_le_bytes().iter().take(self.count.div_ceil(8) as usize));
        }
        // Of more than 4 GiB nothing is made of anyway: no header can say so.
        let mut bytes = u32::try_from(self.coded.len()).unwrap_or(u32::MAX).to_le_bytes().to_vec();
        bytes.append(&mut self.coded);
        bytes.append(&mut self.plain);
        bytes
    }
}

impl Bits for Writer {
    const READS: bool = false;

    fn distrusts(&self) -> bool {
        false
    }

    #[inline]
    fn bit(&mut self, odds: &mut Odds, bit: bool) -> bool {
        let bound = (self.range >> PRECISION) * odds.of_zero();
        if bit {
            self.low += u64::from(bound);
            self.range -= bound;
        } else {
            self.range = bound;
        }
        odds.learn(bit);
        while self.range < LEAST {
            self.range <<= 8;
            self.shift();
        }
        bit
    }

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "the lowest byte is taken")]
    fn plain(&mut self, bits: u32, count: u32) -> u32 {
        self.bits |= u64::from(bits) << self.count;
        self.count += count;
        while self.count >= 8 {
            self.plain.push(self.bits as u8);
            self.bits >>= 8;
            self.count -= 8;
        }
        bits
    }
}

/// Reads the bits that a [`Writer`] wrote.
#[derive(Clone, Debug)]
pub(crate) struct Reader<'a> {
    range: u32,
    code: u32,
    coded: &'a [u8],
    plain: &'a [u8],
    bits: u64,
    count: u32,
    /// Number of bytes that were read past the end of the plain bits.
    missing: u32,
    distrusts: bool,
}

impl<'a> Reader<'a> {
    /// Begins to read `bytes`, all that a [`Writer`] wrote. `distrusts` says whether they come from outside.
    ///
    /// # Errors
    /// [`Damage`] if they are too short.
    pub fn new(bytes: &'a [u8], distrusts: bool) -> Result<Self, Damage> {
        let (length, rest) = bytes.split_first_chunk().ok_or(Damage("the length of its data"))?;
        let length = u32::from_le_bytes(*length) as usize;
        let (coded, plain) = rest.split_at_checked(length).ok_or(Damage("the length of its data"))?;
        let mut reader = Self { range: u32::MAX, code: 0, coded, plain, bits: 0, count: 0, missing: 0, distrusts };
        for _ in 0..4 {
            reader.code = reader.code << 8 | u32::from(reader.next_coded());
        }
        Ok(reader)
    }

    fn next_coded(&mut self) -> u8 {
        let Some((&first, rest)) = self.coded.split_first() else { return 0 };
        self.coded = rest;
        first
    }

    /// Ends.
    ///
    /// # Errors
    /// If there were too few or too many bits.
    pub fn finish(self) -> Result<(), Damage> {
        let whole = self.coded.is_empty() && self.plain.is_empty() && self.missing == 0;
        if whole { Ok(()) } else { Err(Damage("the length of its data")) }
    }
}

impl Bits for Reader<'_> {
    const READS: bool = true;

    fn distrusts(&self) -> bool {
        self.distrusts
    }

    #[inline]
    fn bit(&mut self, odds: &mut Odds, _: bool) -> bool {
        let bound = (self.range >> PRECISION) * odds.of_zero();
        let bit = self.code >= bound;
        // Without a branch, which nobody could foretell.
        let mask = u32::from(bit).wrapping_neg();
        self.code -= bound & mask;
        self.range = ((self.range - bound) & mask) | (bound & !mask);
        odds.learn(bit);
        while self.range < LEAST {
            self.range <<= 8;
            self.code = self.code << 8 | u32::from(self.next_coded());
        }
        bit
    }

    #[inline]
    #[expect(clippy::cast_possible_truncation, reason = "the lowest `count` bits are taken, at most 32")]
    fn plain(&mut self, _: u32, count: u32) -> u32 {
        while self.count < count {
            match self.plain.split_first() {
                Some((&first, rest)) => {
                    self.bits |= u64::from(first) << self.count;
                    self.plain = rest;
                }
                None => self.missing = self.missing.saturating_add(1),
            }
            self.count += 8;
        }
        let bits = (self.bits & ((1 << count) - 1)) as u32;
        self.bits >>= count;
        self.count -= count;
        bits
    }
}
