//! Rotations with the same bits on every machine.
//!
//! Those of the maths library lie in a register of four lanes on some machines and in four numbers on others. They add
//! the squares in another order there, and multiply by a reciprocal instead of dividing: last bits differ.

use bevy_math::Vec3;

/// Rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Rotation {
    /// Vector part of a unit quaternion.
    vector: Vec3,
    /// Scalar part.
    scalar: f32,
}

impl Rotation {
    /// No rotation.
    pub const IDENTITY: Self = Self { vector: Vec3::ZERO, scalar: 1.0 };

    /// Returns the rotation of a quaternion, x, y, z and w, which may have any length but zero.
    pub fn of(quaternion: [f32; 4]) -> Self {
        let length = Self::length_squared(quaternion).sqrt();
        let [x, y, z, w] = quaternion.map(|number| number / length);
        Self { vector: Vec3::new(x, y, z), scalar: w }
    }

    /// Returns the squared length of a quaternion.
    pub fn length_squared([x, y, z, w]: [f32; 4]) -> f32 {
        // In the order of x86-64, on which the first films were made.
        (x * x + z * z) + (y * y + w * w)
    }

    /// Rotates a vector.
    pub fn apply(self, v: Vec3) -> Vec3 {
        let Self { vector, scalar } = self;
        let along = v * (scalar * scalar - vector.length_squared()) + vector * (v.dot(vector) * 2.0);
        along + vector.cross(v) * (scalar * 2.0)
    }
}

#[cfg(test)]
mod tests {
    use bevy_math::Quat;

    use super::*;

    #[test]
    fn rotations_are_those_of_their_quaternions() {
        for quaternion in [[0.3, -0.2, 0.9, 0.4], [0.0, 0.0, -2.0, 0.1], [1e-3, 2e-3, 0.0, 1e-3]] {
            let (rotation, expected) = (Rotation::of(quaternion), Quat::from_array(quaternion).normalize());
            for v in [Vec3::X, Vec3::new(1.0, -2.0, 3.0), Vec3::ZERO] {
                let (found, expected) = (rotation.apply(v), expected * v);
                assert!(found.abs_diff_eq(expected, 1e-6 * v.length().max(1.0)), "{found}, not {expected}");
            }
        }
        assert_eq!(Rotation::IDENTITY.apply(Vec3::NEG_Y), Vec3::NEG_Y);
    }

    #[test]
    fn their_bits_are_known() {
        // Where registers have four lanes, and where they have none.
        let found = Rotation::of([0.3, -0.2, 0.9, 0.4]).apply(Vec3::new(0.1, 0.7, -0.3));
        assert_eq!(found.to_array().map(f32::to_bits), [0xbf31_5694, 0xbe68_ba2f, 0xbe77_9f2d]);
    }
}
