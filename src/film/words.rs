//! Collects the state of a film as 32-bit words, for digests.

use bevy_math::{Vec3, Vec4};

/// State of a film as 32-bit words, in a fixed order. Whatever has no fixed length is followed by its length.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Words(Vec<u32>);

impl Words {
    /// Appends a word.
    pub fn word(&mut self, word: u32) {
        self.0.push(word);
    }

    /// Appends a number of 64 bits as two words, the lower one first.
    pub fn long(&mut self, bits: u64) {
        self.0.extend([bits as u32, (bits >> 32) as u32]);
    }

    /// Appends a float by its bits.
    pub fn float(&mut self, x: f32) {
        self.word(x.to_bits());
    }

    /// Appends a double by its bits.
    pub fn double(&mut self, x: f64) {
        self.long(x.to_bits());
    }

    /// Appends three floats.
    pub fn vector(&mut self, v: Vec3) {
        self.0.extend(v.to_array().map(f32::to_bits));
    }

    /// Appends a list of words, then their number.
    pub fn list(&mut self, words: impl IntoIterator<Item = u32>) {
        let before = self.0.len();
        self.0.extend(words);
        self.word((self.0.len() - before) as u32);
    }

    /// Appends a list of 64-bit numbers, then the number of their words.
    pub fn longs(&mut self, bits: impl IntoIterator<Item = u64>) {
        self.list(bits.into_iter().flat_map(|bits| [bits as u32, (bits >> 32) as u32]));
    }

    /// Appends a list of truth values, one a word, then their number.
    pub fn flags<'a>(&mut self, flags: impl IntoIterator<Item = &'a bool>) {
        self.list(flags.into_iter().map(|&flag| u32::from(flag)));
    }

    /// Appends a list of floats, then their number.
    pub fn floats<'a>(&mut self, floats: impl IntoIterator<Item = &'a f32>) {
        self.list(floats.into_iter().map(|x| x.to_bits()));
    }

    /// Appends a list of vectors, then the number of their words.
    pub fn vectors<'a>(&mut self, vectors: impl IntoIterator<Item = &'a Vec3>) {
        self.list(vectors.into_iter().flat_map(|v| v.to_array().map(f32::to_bits)));
    }

    /// Appends a list of four floats each, then the number of their words.
    pub fn fours(&mut self, fours: impl IntoIterator<Item = Vec4>) {
        self.list(fours.into_iter().flat_map(|v| v.to_array().map(f32::to_bits)));
    }

    /// Returns the words as little-endian bytes.
    pub fn bytes(&self) -> Vec<u8> {
        self.0.iter().flat_map(|word| word.to_le_bytes()).collect()
    }
}

/// Asserts that each of `changes` to `state` gives words of its own.
#[cfg(test)]
pub(crate) fn assert_each_counts<T: Clone>(state: &T, write: impl Fn(&T, &mut Words), changes: &[fn(&mut T)]) {
    let words = |state: &T| {
        let mut words = Words::default();
        write(state, &mut words);
        words.0
    };
    let mut found = vec![words(state)];
    for (i, change) in changes.iter().enumerate() {
        let mut changed = state.clone();
        change(&mut changed);
        let changed = words(&changed);
        assert!(!found.contains(&changed), "change {i} does not count");
        found.push(changed);
    }
}
