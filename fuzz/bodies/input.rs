//! Numbers from bytes, whatever they are; zeros after the last.

use bevy_math::Vec3;

pub struct Input<'a>(pub &'a [u8]);

impl Input<'_> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    pub fn word(&mut self) -> u16 {
        u16::from_le_bytes([self.byte(), self.byte()])
    }

    /// A float: most of the time one of a few small ones, so that places coincide and lie on lines.
    pub fn float(&mut self) -> f32 {
        match self.byte() {
            255 => f32::from_le_bytes([(); 4].map(|()| self.byte())),
            few => f32::from(few % 16) / 4.0,
        }
    }

    pub fn vector(&mut self) -> Vec3 {
        Vec3::new(self.float(), self.float(), self.float())
    }
}
