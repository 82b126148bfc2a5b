//! What is written is read again, to the bit.

use bevy_math::Vec3;
use proptest::prelude::*;

use super::{Coder, Damage, Differences, Odds, Reader, Writer};

/// Numbers of every kind, with what is expected of them.
#[derive(Clone, Debug, PartialEq)]
struct Numbers {
    words: Vec<(u32, u32)>,
    floats: Vec<(u32, u32)>,
    flags: Vec<(bool, bool)>,
    few: Vec<u32>,
    plain: Vec<(u32, u32)>,
    longs: Vec<u64>,
}

impl Numbers {
    fn code<C: Coder>(&mut self, coder: &mut C) -> Result<(), Damage> {
        let (mut words, mut floats, mut flags) = (Differences::default(), Differences::default(), Odds::default());
        for (word, expected) in &mut self.words {
            coder.word(&mut words, word, *expected);
        }
        for (bits, expected) in &mut self.floats {
            let mut x = f32::from_bits(*bits);
            coder.float(&mut floats, &mut x, f32::from_bits(*expected));
            *bits = x.to_bits();
        }
        for (flag, expected) in &mut self.flags {
            coder.flag(&mut flags, flag, *expected);
        }
        let mut few: Vec<f32> = self.few.iter().map(|bits| f32::from_bits((bits % 7) << 28)).collect();
        coder.few_floats(&mut few, "few")?;
        self.few = few.into_iter().map(|x| x.to_bits() >> 28).collect();
        for (bits, count) in &mut self.plain {
            *bits = coder.plain(*bits, *count);
        }
        self.longs.iter_mut().for_each(|long| coder.plain_long(long));
        Ok(())
    }

    /// The same lists, with nothing in them but what is expected.
    fn blank(&self) -> Self {
        let mut blank = self.clone();
        blank.words.iter_mut().for_each(|word| word.0 = 0);
        blank.floats.iter_mut().for_each(|x| x.0 = 0);
        blank.flags.iter_mut().for_each(|flag| flag.0 = false);
        blank.few.fill(0);
        blank.plain.iter_mut().for_each(|plain| plain.0 = 0);
        blank.longs.fill(0);
        blank
    }
}

fn numbers() -> impl Strategy<Value = Numbers> {
    let near = (any::<u32>(), -300i32..300).prop_map(|(at, off)| (at.wrapping_add_signed(off), at));
    let words = prop::collection::vec(prop_oneof![any::<(u32, u32)>(), near.clone(), Just((7, 7))], 0..300);
    let floats = prop::collection::vec(prop_oneof![any::<(u32, u32)>(), near, Just((0, 0))], 0..300);
    let flags = prop::collection::vec(any::<(bool, bool)>(), 0..300);
    let few = prop::collection::vec(0u32..7, 0..100);
    let plain = (any::<u32>(), 1u32..=32).prop_map(|(bits, count)| (bits & (u32::MAX >> (32 - count)), count));
    let longs = prop::collection::vec(any::<u64>(), 0..5);
    (words, floats, flags, few, prop::collection::vec(plain, 0..50), longs)
        .prop_map(|(words, floats, flags, few, plain, longs)| Numbers { words, floats, flags, few, plain, longs })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn whatever_is_written_is_read(mut numbers in numbers()) {
        let before = numbers.clone();
        let mut writer = Writer::new();
        numbers.code(&mut writer).expect("numbers");
        prop_assert_eq!(&numbers, &before, "a writer changes nothing");
        let bytes = writer.finish();
        let mut read = numbers.blank();
        let mut reader = Reader::new(&bytes, true).expect("bytes");
        read.code(&mut reader).expect("numbers");
        prop_assert_eq!(reader.finish(), Ok(()));
        prop_assert_eq!(read, numbers);
    }

    #[test]
    fn any_bytes_are_read_without_panic(bytes in prop::collection::vec(any::<u8>(), 0..300), mut numbers in numbers()) {
        if let Ok(mut reader) = Reader::new(&bytes, true) {
            let _ = numbers.code(&mut reader);
        }
    }
}

#[test]
fn what_is_expected_costs_next_to_nothing() {
    let mut writer = Writer::new();
    let mut same: Vec<Vec3> = (0..10_000).map(|i| Vec3::splat(i as f32)).collect();
    let expected = same.clone();
    writer.vectors(&mut same, |i| expected[i]);
    let bytes = writer.finish();
    assert!(bytes.len() < 30, "{} bytes", bytes.len());
    // And what nobody expects costs no more than it is large, but for a little.
    let mut writer = Writer::new();
    let mut list = Differences::default();
    let mut word = 1u32;
    for _ in 0..10_000 {
        word = word.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        writer.word(&mut list, &mut word, 0);
    }
    assert!(writer.finish().len() < 40_500);
}
