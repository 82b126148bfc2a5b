//! Codes touches for the log: a stroke goes on with the same brush.

use super::touched::Touched;
use crate::{
    coding::{Coder, Damage, Differences},
    film::FaceId,
    touch::{Change, Effect, Site, Touch},
};

const DAMAGED_TOUCH: Damage = Damage("a touch");

/// What is expected of the next touch.
#[derive(Default)]
pub(super) struct TouchCoding {
    faces: Touched,
    shares: [Differences; 2],
    strokes: Differences,
    stroke: u32,
    /// Radius and hardness, kind and numbers of the effect.
    brush: [u32; 6],
    brushes: [Differences; 6],
}

impl TouchCoding {
    /// Codes the next touch, which is part of `stroke`.
    ///
    /// # Errors
    /// [`Damage`] if what is read is none.
    pub fn code<C: Coder>(&mut self, touch: &mut Touch, stroke: &mut u32, coder: &mut C) -> Result<(), Damage> {
        coder.word(&mut self.strokes, stroke, self.stroke);
        self.stroke = *stroke;
        self.faces.code(&mut touch.site.face.0, None, coder);
        for (share, list) in touch.site.shares.iter_mut().zip(&mut self.shares) {
            let mut word = u32::from(*share);
            coder.word(list, &mut word, 0);
            *share = u16::try_from(word).map_err(|_| DAMAGED_TOUCH)?;
        }
        let (kind, [a, b, c]) = touch.effect.numbers();
        let mut brush = [touch.radius.to_bits(), touch.hardness.to_bits(), kind, a, b, c];
        for ((word, list), expected) in brush.iter_mut().zip(&mut self.brushes).zip(self.brush) {
            coder.word(list, word, expected);
        }
        self.brush = brush;
        let [radius, hardness, kind, a, b, c] = brush;
        (touch.radius, touch.hardness) = (f32::from_bits(radius), f32::from_bits(hardness));
        touch.effect = Effect::of_numbers(kind, [a, b, c]).ok_or(DAMAGED_TOUCH)?;
        Ok(())
    }
}

impl Effect {
    /// Returns the number of this kind of effect, and its numbers as words.
    fn numbers(self) -> (u32, [u32; 3]) {
        let change = |kind: u32, by: Change| match by {
            Change::Set(value) => (kind, [value.to_bits(), 0, 0]),
            Change::Add(value) => (kind + 1, [value.to_bits(), 0, 0]),
            Change::Multiply(value) => (kind + 2, [value.to_bits(), 0, 0]),
        };
        let number = |kind: u32, value: f32| (kind, [value.to_bits(), 0, 0]);
        match self {
            Self::Adhesion(by) => change(0, by),
            Self::Binding(by) => change(3, by),
            Self::Contraction(by) => change(6, by),
            Self::Dust(by) => change(9, by),
            Self::Moisture(by) => change(12, by),
            Self::Rust(layers) => number(15, layers),
            Self::Strip => (16, [0; 3]),
            Self::Repaint => (17, [0; 3]),
            Self::Hit(force) => number(18, force),
            Self::Wash(share) => number(19, share),
            Self::Sand(share) => number(20, share),
            Self::Scratch(Site { face, shares: [a, b] }) => (21, [face.0, a.into(), b.into()]),
        }
    }

    /// Returns the effect of a kind with these numbers. `None` if there is none.
    fn of_numbers(kind: u32, [a, b, c]: [u32; 3]) -> Option<Self> {
        let number = f32::from_bits(a);
        let change = || match kind % 3 {
            0 => Change::Set(number),
            1 => Change::Add(number),
            _ => Change::Multiply(number),
        };
        Some(match kind {
            0..=2 => Self::Adhesion(change()),
            3..=5 => Self::Binding(change()),
            6..=8 => Self::Contraction(change()),
            9..=11 => Self::Dust(change()),
            12..=14 => Self::Moisture(change()),
            15 => Self::Rust(number),
            16 => Self::Strip,
            17 => Self::Repaint,
            18 => Self::Hit(number),
            19 => Self::Wash(number),
            20 => Self::Sand(number),
            21 => {
                let shares = [u16::try_from(b).ok()?, u16::try_from(c).ok()?];
                Self::Scratch(Site { face: FaceId(a), shares })
            }
            _ => return None,
        })
    }
}
