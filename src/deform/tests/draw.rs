//! Draws floats of every size from a seed: zeros, denormal numbers, and all exponents up to about 1e30.

use bevy_math::Vec3;

/// Exponent of 2 of the largest numbers: 2^99 is 6e29, so none is above 1.3e30.
const LARGEST: u32 = 99;

/// Seeded source of numbers (SplitMix64).
pub struct Draw(pub u64);

impl Draw {
    /// Returns 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Returns a whole number below `end`.
    pub fn below(&mut self, end: u32) -> u32 {
        (self.bits() >> 32) as u32 % end
    }

    /// Returns a number between 0 and 1.
    pub fn share(&mut self) -> f32 {
        (self.bits() >> 40) as f32 / (1u64 << 24) as f32
    }

    /// Returns a number of any size and either sign: one in eight is 0, one in eight denormal.
    pub fn any(&mut self) -> f32 {
        let (sign, mantissa) = (self.below(2) << 31, self.below(1 << 23));
        let bits = match self.below(8) {
            0 => 0,
            1 => mantissa >> self.below(23),
            _ => ((1 + self.below(127 + LARGEST)) << 23) | mantissa,
        };
        f32::from_bits(sign | bits)
    }

    /// Returns a number of any size, 0 or more.
    pub fn size(&mut self) -> f32 {
        self.any().abs()
    }

    /// Returns a vector of any size. Its components have sizes of their own, or one in common.
    pub fn vector(&mut self) -> Vec3 {
        if self.below(2) == 0 { self.along() * self.size() } else { Vec3::new(self.any(), self.any(), self.any()) }
    }

    /// Returns a vector with components from -1 to 1, some of which are 0.
    pub fn along(&mut self) -> Vec3 {
        let mut component = || if self.below(4) == 0 { 0.0 } else { 2.0 * self.share() - 1.0 };
        Vec3::new(component(), component(), component())
    }

    /// Returns the ends of an edge and the tips of its two wings: anywhere, near each other far from the origin, or
    /// needles and folded pairs of any size.
    pub fn pair(&mut self) -> [Vec3; 4] {
        let origin = if self.below(2) == 0 { Vec3::ZERO } else { self.vector() };
        match self.below(4) {
            0 => [(); 4].map(|()| self.vector()),
            1 => {
                let size = self.size();
                [(); 4].map(|()| origin + self.along() * size)
            }
            // Nearly on a line: tips off it by a share of any size.
            2 => {
                let (along, size) = (self.along(), self.size());
                let mut off = || self.along() * (size * self.size().min(1.0));
                let places = [off(), off(), off(), off()];
                [0.0, 1.0, 2.0 * self.share() - 0.5, 2.0 * self.share() - 0.5]
                    .iter()
                    .zip(places)
                    .map(|(&at, off)| origin + along * (size * at) + off)
                    .collect::<Vec<_>>()
                    .try_into()
                    .unwrap_or([origin; 4])
            }
            // Wings folded onto each other or flat, of sizes that have nothing to do with each other.
            _ => {
                let (along, tip) = (self.along(), self.along());
                let (edge, near, far, off) = (self.size(), self.size(), self.size(), self.size());
                let side = if self.below(2) == 0 { far } else { -far };
                [origin, origin + along * edge, origin + tip * near, origin + tip * side + self.along() * off]
            }
        }
        .map(|p| p.clamp(Vec3::splat(-2e30), Vec3::splat(2e30)))
    }
}
